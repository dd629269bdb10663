//! Kits of one object: hollowed, cut, joined, weighed, judged.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

mod common;

mod advice;
mod ballast;
mod cleaning;
mod cut_soak;
mod cut_suite;
mod drains;
mod flow;
mod goals;
mod hardware;
mod inner_cells;
mod joinery;
mod layers;
mod mending;
mod plugs;
mod poses;
mod prepare;
mod printed;
mod proofs;
mod remedies;
mod repairs;
mod rotors;
mod rounds;
mod seams;
mod shipped_model;
mod thin;
mod tops;
mod upright;
