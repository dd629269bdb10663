//! Kits of other kinds than hollowed models: what the line of every kind gives and writes.
//!
//! A kind of kit has a line of its own, such as that of telescopes or of objects on a base. It ends
//! with an [`Outcome`]: a kit with its checklist, or the reason why there is none. The command
//! line, the judge's folder and the papers treat all kinds alike.

mod outcome;
mod papers;
mod texts;

pub use outcome::{Impossible, NoMore, Outcome, Prepared, Remedy};
pub use papers::Papers;
pub use texts::{Unwritable, json, read_back};
