//! Volume meshes: solids as tetrahedra, with a density at each corner or in each cell.
//!
//! * `parts` holds what a file says; [`Tets`] is what is left of it once it is checked.
//! * `faces` pairs the faces, `boundary` draws what is left over, `overlap` looks for space that is
//!   filled twice.
//! * `stuffing` fills a solid with tetrahedra, which `clip` cuts at its surface.
//! * `nested` is a density in steps, as infill is printed.
//! * `quality` measures shapes, `sampling` what the corners miss of a field.

mod boundary;
mod clip;
mod error;
mod faces;
mod nested;
mod overlap;
mod parts;
mod quality;
mod sampling;
mod stuffing;
#[cfg(test)]
mod tests;
mod volume;

pub use boundary::Boundary;
pub use error::TetsError;
pub use nested::NestedDensity;
pub use parts::{Densities, TetsParts};
pub use quality::{Quality, SLIVER_DEG};
pub use sampling::{Difference, Jump, Sampling};
pub use stuffing::{StuffingError, stuff};
pub use volume::Tets;
