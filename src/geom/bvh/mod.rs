//! A bounding-volume hierarchy over triangles, f64, in flat arrays.
//!
//! `tree` holds the types, `build` makes the tree, and `query` searches it with the `probe` of a
//! triangle and the intersections in `ray`. Boxes still to see wait in a `stack`.

mod build;
mod probe;
mod query;
mod ray;
mod stack;
mod tree;

pub use query::{NO_HINT, Nearest};
pub use tree::Bvh;
