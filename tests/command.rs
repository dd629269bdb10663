//! The command line and the readers: bad input, questions, signals, profiles.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

mod common;

mod bad_input;
#[path = "policy/main.rs"]
mod policy;
#[path = "printers/main.rs"]
mod printers;
mod progress;
mod questions;
#[path = "readers/main.rs"]
mod readers;
mod signals;
mod supply;
