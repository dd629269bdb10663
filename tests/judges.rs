//! Judges that share no code with the program, and kits that were altered.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

mod common;

#[path = "altered/main.rs"]
mod altered;
mod browser;
mod clip_cross_check;
mod cura;
mod independent_judge;
mod slicer;
mod verify;
