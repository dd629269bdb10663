//! Triangle meshes, and the solids that are proved closed, oriented and 2-manifold.

mod bodies;
mod clip;
pub(crate) mod crossings;
mod defects;
mod distance;
pub(crate) mod edges;
mod facts;
pub(crate) mod fans;
pub mod primitives;
mod sampling;
pub(crate) mod shells;
mod solid;
mod tri_mesh;
pub(crate) mod union_find;

pub use bodies::{bodies, shells, winding_number};
pub use clip::{ClipError, Csg};
pub(crate) use clip::{off_faces, off_vertices};
pub use crossings::Crossings;
pub use defects::{Defect, DefectKind, Defects};
pub use distance::MeshDistance;
pub use facts::MeshFacts;
pub use sampling::{SurfacePoint, area_mm2, spread_points};
pub use solid::Solid;
pub use tri_mesh::{MeshError, TriMesh, scaled};
