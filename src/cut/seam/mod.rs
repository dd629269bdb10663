//! Seams: the lines that cuts leave on the outside, the price of what is seen of them, and the
//! places where none may run.
//!
//! `look` judges points spread over the outside, and `skin` prices a seam by them. `clear` holds
//! the balls that no seam enters, and `rules` all that a plan keeps to. `notes` measures the seams
//! of a plan.

pub(crate) mod clear;
pub(crate) mod look;
pub(crate) mod notes;
pub(crate) mod rules;
pub(crate) mod skin;
