//! Skeletons: the curves inside a solid, each point with the largest ball about it.
//!
//! A skeleton says where the limbs of a model run and how thick they are; a telescope grows along
//! it. [`Skeleton::of`] finds it in five steps, one file each:
//!
//! 1. `remesh` makes the triangles of the surface small, round and of one size.
//! 2. `poles` finds the largest ball that touches the surface at each vertex.
//! 3. `flow` contracts the surface by its mean curvature towards these poles; `system` solves each
//!    step with the sparse `factor` of a matrix in the `order` of nested dissection.
//! 4. `curve` collapses what is left until no triangle remains.
//! 5. `tidy` merges junctures and prunes bumps; `centre` spreads the nodes and centres them.
//!
//! [`Skeleton::mark_solid`] marks the branches that carry no two shells. [`Skeleton::rings`] names
//! the rings that no telescope can have. `file` writes a skeleton for editing and reads it back.
//! [`Limbs`] is the tree that telescopes grow along.

mod centre;
mod curve;
mod error;
mod factor;
mod file;
mod flow;
mod graph;
mod limbs;
mod lines;
mod order;
mod poles;
mod remesh;
mod rings;
mod solid;
mod surface;
mod system;
mod tidy;
mod tree;

pub use error::SkeletonError;
pub use limbs::{Chain, Juncture, Limbs, NotATree};
pub use rings::Ring;
pub use solid::ShellSizes;
pub use tree::{Branch, Node, Skeleton, StaysSolid};
