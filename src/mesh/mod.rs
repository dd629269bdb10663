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
mod sampling;
mod sew;
mod shells;
mod solid;
mod tri_mesh;
pub(crate) mod union_find;
mod unstitch;
mod weld;

pub use bodies::{bodies, shells, winding_number};
pub(crate) use clip::off_vertices;
pub use clip::{ClipError, Csg};
pub use crossings::Crossings;
pub use defects::{Defect, DefectKind, Defects};
pub use distance::MeshDistance;
pub use facts::MeshFacts;
pub use hollowed::Hollowed;
pub use one_body::{NotOneBody, ShellFact, ShellRole, one_body};
pub use repair::{Repairs, repair};
pub use sampling::{SurfacePoint, area_mm2, spread_points};
pub(crate) use sew::sewn;
pub use solid::Solid;
pub use tri_mesh::{MeshError, TriMesh, scaled};
pub use weld::weld;
