//! The tree: boxes and triangles in flat arrays.

use crate::geom::{Aabb, Point};

/// Triangles in a binary tree of boxes, for nearest-point, distance and ray queries.
///
/// The tree depends on the triangles alone, so every answer is the same whatever the thread count.
/// Answers are exact up to rounding.
#[derive(Debug, Clone)]
pub struct Bvh {
    pub(super) nodes: Vec<Node>,
    /// The corners of the triangles in leaf order.
    pub(super) corners: Vec<[Point; 3]>,
    /// The caller's index of each triangle in leaf order.
    pub(super) ids: Vec<u32>,
}

/// A box; its left child follows it in the array.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) aabb: Aabb,
    /// A leaf's first triangle, or an inner node's right child.
    pub(super) first: u32,
    /// Number of triangles of a leaf; 0 for an inner node.
    pub(super) count: u32,
}

impl Bvh {
    /// Returns the box of all triangles; empty if there are none.
    pub fn aabb(&self) -> Aabb {
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.aabb)
    }

    /// Returns the number of triangles.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns true if there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Returns the range of a leaf's triangles, in leaf order.
    #[inline]
    pub(super) fn leaf_range(node: &Node) -> std::ops::Range<usize> {
        let first = node.first as usize;
        first..first + node.count as usize
    }
}
