//! Mass properties: the ten moments of a region, which add, and the rigid body that they describe.

// The moments, and the body with these moments.
mod body;
mod moments;

// The moments of a body whose density varies.
mod cones;
mod rays;
mod rule;
mod split;
mod tetrahedron;

// The moments of a mesh, of the part of it under water, and of simple bodies in closed form.
mod bar;
mod bead;
mod film;
mod lump;
mod of_mesh;
mod of_tetrahedra;
mod submerged;

#[cfg(test)]
mod tests;

pub use bar::RoundBar;
pub use bead::{Bead, BeadMoments, Turn};
pub use body::{Body, ImpossibleBody, Principal};
pub use cones::{Accuracy, Cones, Estimate};
pub use film::FlatFace;
pub(crate) use lump::rims;
pub use lump::{Lump, LumpShape};
pub use moments::Moments;
pub use of_mesh::moments_of_mesh;
pub use of_tetrahedra::moments_of_tetrahedra;
pub use rule::{ConeRule, Node, gauss_jacobi};
pub use split::Split;
pub use submerged::{Section, Submerged, clip_below};
pub use tetrahedron::Tetrahedron;
