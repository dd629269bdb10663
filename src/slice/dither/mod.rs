//! A model in two materials: its density is a field, and its pixels are dithered.
//!
//! * `order` holds what is asked, and why it may not be done.
//! * `voxels` has the shares of the heavy material in the pixels of each layer.
//! * `correct` finds the few changes that make mass, centre and inertia right.
//! * `run` passes through the layers: to weigh, and at last to write.
//! * `row` is the list of the materials, with what is promised and what was reached.

mod correct;
mod order;
mod row;
mod run;
mod voxels;

pub use order::{DitherError, DitherOrder};
pub use row::{BodyRow, DITHER_FILE, DitherRow, MaterialRow, Off};
pub use run::{dither_model, weigh_stacks};
