//! 3MF: packages of named objects in real units (3D Manufacturing Format, core specification 1.3).

mod archive;
mod error;
mod place;
mod read;
#[cfg(test)]
mod tests;
mod transform;
mod write;
mod xml;

pub use error::{Limit, ThreeMfError};
pub use transform::Transform;
pub use write::{Build, Object, Package, PackageError};

use crate::mesh::TriMesh;

/// The namespace of the core specification's elements.
const CORE_NAMESPACE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
/// The namespace of the list of content types (Open Packaging Conventions, ECMA-376 part 2).
const CONTENT_TYPES: &str = "http://schemas.openxmlformats.org/package/2006/content-types";
/// The namespace of relationships (Open Packaging Conventions).
const RELATIONSHIPS: &str = "http://schemas.openxmlformats.org/package/2006/relationships";
/// The type of the relationship that leads to the model.
const MODEL_TYPE: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
/// Where the model usually is.
const MODEL_PART: &str = "3D/3dmodel.model";

/// One object where the package's build puts it.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedObject {
    /// The name its package gives it; empty without one.
    pub name: String,
    /// Its triangles, mm, where the build puts them.
    pub mesh: TriMesh,
}

/// Every mesh that the build of a package puts somewhere, in mm, in the order of the build.
///
/// The unit, the components of objects and all their transforms are applied; a mesh in a mirrored
/// place is turned outward again. Coordinates are read in single precision, as the programs that
/// print from this format read them. Support structures are left out. Colours, textures and other
/// properties are ignored, and so are extensions that a reader may ignore; those that it must know
/// are refused. Every coordinate is finite, every index in range, and there is at least one
/// triangle. Memory and time are bounded by the size of the file ([`Limit`]).
pub fn decode_objects(bytes: &[u8]) -> Result<Vec<PlacedObject>, ThreeMfError> {
    let mut package = archive::Archive::open(bytes)?;
    let root = package.root_part()?;
    place::placed(&mut package, &root)
}

/// All meshes of [`decode_objects`] in one.
pub(super) fn decode(bytes: &[u8]) -> Result<TriMesh, ThreeMfError> {
    let objects = decode_objects(bytes)?;
    Ok(objects.iter().fold(TriMesh::default(), |whole, object| {
        whole.joined(&object.mesh)
    }))
}
