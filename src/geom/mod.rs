//! Points, frames, planes and boxes: the geometry that knows nothing of meshes.

mod aabb;
mod bvh;
mod frame;
mod parting;
mod plane;
mod quadric;
pub mod rings;
pub mod triangle;

pub use aabb::Aabb;
pub use bvh::{Bvh, NO_HINT, Nearest};
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
