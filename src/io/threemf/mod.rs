//! 3MF: packages of named objects in real units (3D Manufacturing Format, core specification 1.3).
//!
//! * Reading: `archive` unpacks the parts, `xml` scans their tags, `read` builds one model, and
//!   `place` puts its objects where the build says.
//! * Writing: [`Package`] in `write`, with meshes in `triangles`, [`PrintSettings`] for slicers in
//!   `settings`, `orca` and `cura`, and regions of other infill in `sparse` and `nested`.
//! * Judging: `orders` reads those settings again, in the `words` of each family of slicers, and
//!   `plate` puts objects, orders and `blocked` triangles together.
//! * Both: [`Transform`], the `names` of the standard, and the faults in `error`.

mod archive;
mod blocked;
mod cura;
mod error;
mod names;
mod nested;
mod orca;
mod orders;
mod place;
mod plate;
mod read;
mod settings;
mod sparse;
#[cfg(test)]
mod tests;
mod transform;
mod triangles;
mod words;
mod write;
mod xml;

pub use cura::CURA_OVERLAP_LINES;
pub use error::{Limit, ThreeMfError};
pub use nested::REGION;
pub use orca::ORCA_WIDTHS;
pub use orders::{ObjectOrders, Orders, SlicerOrders, VolumeOrders, decode_orders};
pub use place::PlacedObject;
pub use plate::{PlateObject, decode_plate};
pub use settings::PrintSettings;
pub use sparse::SparseRegion;
pub use transform::Transform;
pub use words::Words;
pub use write::{Build, Object, Package, PackageError};

use crate::mesh::TriMesh;

/// Returns every mesh that the build of a package places, in mm, in the order of the build.
///
/// Applies the unit, the components of objects and all their transforms; reorients the triangles of
/// a mirrored mesh. Reads coordinates in single precision, as printing programs do with this
/// format. Leaves out support structures. Ignores colours, textures, other properties, and the
/// extensions that a reader may ignore. Refuses the extensions that a reader must know.
///
/// Every coordinate is finite, every index is in range, and there is at least one triangle. The
/// size of the file bounds memory and time ([`Limit`]).
pub fn decode_objects(bytes: &[u8]) -> Result<Vec<PlacedObject>, ThreeMfError> {
    let mut package = archive::Archive::open(bytes)?;
    let root = package.root_part()?;
    place::place_objects(&mut package, &root)
}

/// Joins all meshes of [`decode_objects`] into one.
pub(super) fn decode(bytes: &[u8]) -> Result<TriMesh, ThreeMfError> {
    let objects = decode_objects(bytes)?;
    Ok(objects.iter().fold(TriMesh::default(), |whole, object| {
        whole.joined(&object.mesh)
    }))
}
