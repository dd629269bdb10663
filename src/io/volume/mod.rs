//! Reads volume meshes: Gmsh `.msh`, legacy `.vtk`, and TetGen's `.node` with its `.ele`.
//!
//! * `read` reads a file of any of them, `decode_volume` and `decode_tetgen` their bytes.
//! * `msh`, `vtk` and `tetgen` hold one format each; `raw` is what they have in common.
//! * `choice` decides which of a file's data is the density.
//! * `source` reads numbers, and says where one is wrong.

mod check;
mod choice;
mod element_kinds;
mod error;
mod msh;
mod msh_data;
mod msh_elements;
mod msh_file;
mod msh_nodes;
mod raw;
mod read;
mod source;
#[cfg(test)]
mod tests;
mod tetgen;
mod vtk;
mod vtk_cells;
mod vtk_data;
mod vtk_file;
mod write;

pub use check::Volume;
pub use choice::{DataChoice, DensitySource};
pub use error::{Place, VolumeError};
pub use raw::{Ignored, On};
pub use read::{ReadVolumeError, decode_tetgen, decode_volume, is_volume_name, read_volume};
pub use write::{encode_msh, encode_vtk};
