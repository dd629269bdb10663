//! From the plates of a kit to what its machine reads. That is toolpaths by a slicer, with the
//! settings of the kit's own printer, or layer images at its own pixels.
//!
//! * `plates` slices each plate and weighs its toolpaths.
//! * `row` is the list of what was sliced, and its figures.
//! * `images` draws each plate layer by layer.
//! * `dither` prints a model in two materials, whose density follows a field.
//! * `scaled` scales the extrusion of toolpaths, so that densities follow a field.
//! * `tilt` trims them, so that their centre lies where the kit has it.

mod dither;
mod error;
mod format;
mod images;
mod plates;
mod row;
mod scaled;
mod tilt;

pub use dither::{
    BodyRow, DITHER_FILE, DitherError, DitherOrder, DitherRow, MaterialRow, Off, dither_model,
    weigh_stacks,
};
pub use error::SliceError;
pub use format::SliceFormat;
pub use images::{ImageOrder, Imaged, image_kit};
pub use plates::{SliceOrder, Sliced, slice_kit};
pub use row::{PlateSlice, Slices};
pub use scaled::{MOST_FLOW_MM3_S, ScaleError, ScaleOrder, Scaled, scale_toolpaths};
pub use tilt::{Tilt, off_mm, trim};
