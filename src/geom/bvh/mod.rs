//! A bounding-volume hierarchy over triangles, f64, in flat arrays.

mod build;
mod query;

pub use query::{NO_HINT, Nearest};

use super::{Aabb, Point};

/// Triangles in a binary tree of boxes, for nearest-point, distance and ray queries.
///
/// The tree depends on the triangles alone, so every answer is the same whatever the thread count.
/// Answers are exact up to rounding.
#[derive(Debug, Clone)]
pub struct Bvh {
    nodes: Vec<Node>,
    /// The corners of the triangles in leaf order.
    corners: Vec<[Point; 3]>,
    /// The caller's index of each triangle in leaf order.
    ids: Vec<u32>,
}

/// A box; its left child follows it in the array.
#[derive(Debug, Clone, Copy)]
struct Node {
    aabb: Aabb,
    /// A leaf's first triangle, or an inner node's right child.
    first: u32,
    /// How many triangles a leaf has; 0 for an inner node.
    count: u32,
}

impl Bvh {
    /// The tree over these triangles, built by the surface-area heuristic in O(n log n).
    pub fn new(triangles: impl IntoIterator<Item = [Point; 3]>) -> Self {
        build::build(triangles.into_iter().collect())
    }

    /// The box of all triangles; empty if there are none.
    pub fn aabb(&self) -> Aabb {
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.aabb)
    }

    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// The range of triangles, in leaf order, that a leaf holds.
    fn leaf_range(node: &Node) -> std::ops::Range<usize> {
        let first = node.first as usize;
        first..first + node.count as usize
    }
}
