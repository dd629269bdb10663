//! Triangle meshes, and the solids that are proved closed, oriented and 2-manifold.

mod bodies;
mod clip;
mod crossings;
mod defects;
mod distance;
mod edges;
mod facts;
mod fans;
mod hollowed;
mod one_body;
mod orient;
pub mod primitives;
mod repair;
mod sew;
mod shells;
mod solid;
mod tri_mesh;
mod unfold;
pub(crate) mod union_find;
mod unstitch;
mod weld;

pub use bodies::{bodies, shells, winding_number};
pub use clip::{ClipError, Csg};
pub(crate) use clip::{off_faces, off_vertices};
pub use crossings::Crossings;
pub use defects::{Defect, DefectKind, Defects};
pub use distance::MeshDistance;
pub use facts::MeshFacts;
pub use hollowed::Hollowed;
pub use one_body::{NotOneBody, ShellFact, ShellRole, one_body};
pub use repair::{Repairs, repair};
pub(crate) use sew::sewn;
pub use solid::Solid;
pub use tri_mesh::{MeshError, TriMesh, scaled};
pub use unfold::unfolded;
pub use weld::weld;
