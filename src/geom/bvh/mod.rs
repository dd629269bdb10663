//! A bounding-volume hierarchy over triangles, f64, in flat arrays.
//!
//! `tree` holds the types, `build` makes the tree, and `query` searches it with the `probe` of a
//! triangle and the intersections in `ray`. `near` compares the tree with itself. Boxes still to
//! see wait in a `stack`.

mod build;
mod near;
mod probe;
mod query;
mod ray;
mod stack;
mod tree;

pub use near::{Bundle, Member};
pub use query::{NO_HINT, Nearest};
pub use tree::Bvh;
