//! The command line and the readers: bad input, questions, signals, profiles.

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
