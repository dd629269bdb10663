//! Triangle meshes, and the solids that are proved closed, oriented and 2-manifold.

mod defects;
mod hollowed;
mod solid;
mod tri_mesh;

pub use defects::Defects;
pub use hollowed::Hollowed;
pub use solid::Solid;
pub use tri_mesh::{MeshError, TriMesh};
