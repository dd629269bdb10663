//! G-code: reads what a print lays down, and what its slicer says about it.
//!
//! * [`read_gcode`] opens a file in any packing; `plates` unpacks sliced 3MF, `bgcode` Prusa's
//!   binary.
//! * [`read_text`] follows a program and returns a [`Toolpath`].
//! * `lines` bounds memory, `words` reads commands, `machine` and `arc` follow the nozzle.
//! * `feature`, `label`, `height` and `notes` read the comments of slicers into [`Feature`],
//!   [`Label`] and [`Facts`].
//! * [`rewrite_text`] writes a program again with other amounts in some of its beads: `pieces` cuts
//!   them, `edit` changes single words.
//! * `sums` adds the beads before the diameter of the filament is known, as PrusaSlicer writes it
//!   last; `totals` applies it.

mod arc;
mod bgcode;
mod edit;
mod error;
mod facts;
mod feature;
mod follow;
mod height;
mod label;
mod lines;
mod machine;
mod notes;
mod open;
mod parse;
mod pieces;
mod plates;
mod rewrite;
mod sums;
mod supports;
#[cfg(test)]
mod tests;
mod toolpath;
mod totals;
mod words;

pub use error::{GcodeError, Limit, ReadGcodeError};
pub use facts::{Facts, Generator, LineWidths, Slicer};
pub use feature::Feature;
pub use label::Label;
pub use open::{read_gcode, read_plates};
pub use parse::{Options, read_text};
pub use rewrite::{Portions, RewriteError, Rewriting, Rewritten, rewrite_text};
pub use sums::Place;
pub use supports::SupportCell;
pub use toolpath::{Deposits, DiameterSource, Feed, Plate, PrintedObject, Tally, Toolpath};
