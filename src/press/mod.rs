//! The press: the pictures and the pages of a kit, drawn from its files as they are read back.
//!
//! `prepare` prints the papers of a kit with it. [`verify`] judges a kit, prints its papers again,
//! and compares.

mod again;
mod drawings;
mod faces;
mod job;
mod layout;
mod other_version;
mod pins;

pub use again::verify;
pub use drawings::{Drawings, PressError};
pub use layout::Layout;
