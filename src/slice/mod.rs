//! From the plates of a kit to toolpaths, by a slicer with the settings of the kit's own printer.
//!
//! * `plates` slices each plate and weighs its toolpaths.
//! * `row` is the list of what was sliced, and its figures.

mod error;
mod plates;
mod row;

pub use error::SliceError;
pub use plates::{SliceOrder, Sliced, slice_kit};
pub use row::{PlateSlice, Slices};
