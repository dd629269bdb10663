//! File formats: reads models as STL, OBJ, PLY or 3MF, and writes parts as binary STL or 3MF.
//!
//! * `read` reads a file in any of the formats; `sniff` recognises the format from the content.
//! * [`stl`], `obj`, `ply` and [`threemf`] hold one format each.
//! * `points` reads curves, a point a line; `lines` reads them as OBJ lines or PLY edges, too.
//! * `sites` reads the sites of cells and their axes.
//! * [`glb`] writes bodies that move as glTF, and reads them back.
//! * [`gcode`] reads what a print lays down; it writes nothing.
//! * [`layers`] writes and weighs layer images.
//! * `volume` reads tetrahedra with densities: `.msh`, legacy `.vtk`, `.node` with `.ele`.
//! * `drawing` holds drawings for cutters, which `dxf` and `cut_svg` write; `read_drawing` reads
//!   them back.

mod cut_svg;
mod drawing;
mod dxf;
pub mod gcode;
pub mod glb;
pub mod layers;
mod lines;
mod obj;
mod ply;
mod ply_edges;
mod points;
mod read;
mod read_drawing;
mod sites;
mod sniff;
pub mod stl;
#[cfg(test)]
mod tests;
pub mod threemf;
mod values;
mod volume;

pub use cut_svg::encode_cut_svg;
pub use drawing::{CutDrawing, CutLayer, DrawnLine, DrawnShape, Rgb};
pub use dxf::encode_dxf;
pub use lines::{Lines, LinesError, decode_curve, decode_lines};
pub use obj::ObjError;
pub use ply::PlyError;
pub use points::{OnLine, PointsError, decode_points};
pub use read::{ContentError, ReadError, decode_model, file_near, read_bytes, read_model};
pub use read_drawing::{DrawingError, decode_cut_svg, decode_dxf};
pub use sites::{SitesFileError, decode_axes, decode_sites};
pub use stl::{StlError, WriteError};
pub use volume::{
    DataChoice, DensitySource, Ignored, On, Place, ReadVolumeError, Volume, VolumeError,
    decode_tetgen, decode_volume, encode_msh, encode_vtk, is_volume_name, read_volume,
};
