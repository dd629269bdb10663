//! Triangle meshes, and the solids that are proved closed, oriented and 2-manifold.
//!
//! * **Types, from weak to strong:** [`TriMesh`] (indices in range) and [`Solid`] (bounds a
//!   volume). [`Defects`] lists everything that keeps a mesh from being a solid.
//! * **Topology:** `edges`, `fans` around a vertex, connected `shells`, [`bodies()`], and
//!   `union_find` under them all.
//! * **Measurements:** [`MeshFacts`], the body along an axis (`NearAxis`), self-intersections
//!   ([`Crossings`], [`Broken`]), exact distances ([`MeshDistance`]), and points spread evenly over
//!   a surface ([`spread_points`]). [`WindingNumbers`] tell inside from outside of any triangles.
//! * **Operations:** booleans, plane cuts and simplification ([`Csg`]); `clip` cuts by a plane for
//!   trials, `rings` cuts one branch alone ([`SectionRing`]); `cut_planes` keeps cuts off vertices
//!   and faces; `ear_clip` fills polygons.
//! * **Shapes:** [`primitives`] for tests and tools.

mod axial;
mod bodies;
mod broken;
mod clip;
pub(crate) mod crossings;
mod csg;
mod cut_planes;
mod defects;
mod distance;
mod ear_clip;
pub(crate) mod edges;
mod facts;
pub(crate) mod fans;
mod foot;
pub mod primitives;
mod rings;
mod sampling;
pub(crate) mod shells;
mod solid;
mod tri_mesh;
pub(crate) mod union_find;
mod winding;

pub(crate) use axial::{AxialLine, NearAxis, walled_mm};
pub use bodies::{bodies, nearest_shell, shells, winding_number};
pub use broken::Broken;
pub(crate) use clip::fill_rings;
pub use crossings::Crossings;
pub use csg::{ClipError, Csg};
pub(crate) use cut_planes::{move_off_faces, move_off_vertices};
pub use defects::{Defect, DefectKind, Defects};
pub use distance::{MeshDistance, least_distance_mm};
pub(crate) use ear_clip::ear_clip;
pub use facts::MeshFacts;
pub use foot::{BRIM_MM, GOOD_FOOT_MM2, foot_area_mm2};
pub use rings::SectionRing;
pub use sampling::{SurfacePoint, area_mm2, spread_points, surface_mm2};
pub use solid::Solid;
pub(crate) use tri_mesh::smallest_first;
pub use tri_mesh::{MeshError, TriMesh, scaled};
pub use winding::WindingNumbers;
