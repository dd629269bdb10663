//! Seams: the lines that cuts leave on the outside, the price of what is seen of them, and the
//! places where none may run.
//!
//! `look` judges points spread over the outside, and `skin` prices a seam by them. `clear` holds
//! the balls that no seam enters, and `regions` what no cut enters. `rules` holds all that a plan
//! keeps to, and `notes` measures the seams of a plan.

pub(crate) mod clear;
pub(crate) mod look;
pub(crate) mod notes;
pub(crate) mod regions;
pub(crate) mod rules;
pub(crate) mod skin;
