//! Triangle meshes, and the solids that are proved closed, oriented and 2-manifold.

mod clip;
mod defects;
mod hollowed;
mod shells;
mod solid;
mod tri_mesh;
pub(crate) mod union_find;

pub use clip::{ClipError, Csg};
pub use defects::Defects;
pub use hollowed::Hollowed;
pub use shells::{bodies, shells, signed_volume, winding_number};
pub use solid::Solid;
pub use tri_mesh::{MeshError, TriMesh};
