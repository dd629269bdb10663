//! Geometry that knows nothing of meshes. Lengths are in mm.
//!
//! * **Shapes:** [`Plane`], [`Parting`] (a plane that acts within half-spaces), [`Aabb`],
//!   [`Quadric`].
//! * **In a plane:** [`rings`], the outlines and holes of a section; [`hull`], convex hulls;
//!   [`play`], how far a body moves between stops.
//! * **Placement:** [`Frame`], a right-handed orthonormal frame in the model's frame.
//! * **Distances:** [`triangle`] in closed form, [`Bvh`] over many triangles.

mod aabb;
mod bvh;
mod corner_orders;
mod frame;
pub mod hull;
mod parting;
mod plane;
pub mod play;
mod quadric;
pub mod rings;
pub mod triangle;

pub use aabb::Aabb;
pub use bvh::{Bundle, Bvh, Member, NO_HINT, Nearest};
pub use corner_orders::{CORNER_FIRST, PAIR_FIRST};
pub use frame::Frame;
pub use parting::Parting;
pub use plane::{Plane, orthonormal_basis};
pub use quadric::Quadric;

/// A position, mm.
pub type Point = nalgebra::Point3<f64>;
/// A displacement (mm) or a direction (unit length).
pub type Vector = nalgebra::Vector3<f64>;
/// A 3×3 matrix: an inertia tensor (g·mm²) or a rotation.
pub type Matrix = nalgebra::Matrix3<f64>;
