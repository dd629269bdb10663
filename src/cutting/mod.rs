//! Sheets for a laser cutter: panels on them, the paths of the beam, and how much is cut.
//!
//! * [`SheetOrder`] names the cutter, the sheet and what stock there is.
//! * [`cut_sheets`] lays the panels of a base on sheets, as [`CutSheet`]s.
//! * [`CutSheet::drawing`] is what `io` writes as DXF and SVG; [`CutSheet::figures`] says how much
//!   is cut.

mod sheets;

pub use sheets::{CutSheet, SheetError, SheetFigures, SheetOrder, cut_sheets, whole_sheets};
