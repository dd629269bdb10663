//! Comparing the triangles of a tree with each other, a few neighbours at a time.

use std::ops::{ControlFlow, Range};

use super::query::gap_squared;
use super::stack::Stack;
use super::tree::Bvh;
use crate::geom::{Aabb, Point};

/// A few neighbouring triangles of a tree: those of one leaf.
#[derive(Debug, Clone, PartialEq)]
pub struct Bundle {
    slots: Range<usize>,
    aabb: Aabb,
}

impl Bundle {
    /// Returns the number of triangles.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Returns true if there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }
}

/// A triangle of a tree.
#[derive(Debug, Clone, Copy)]
pub struct Member<'a> {
    /// Its place in its bundle, from 0.
    pub place: usize,
    /// Its index as the caller numbered it.
    pub id: u32,
    /// Its corners.
    pub corners: &'a [Point; 3],
}

impl Bvh {
    /// Returns all triangles, a few neighbours in each bundle.
    pub fn bundles(&self) -> Vec<Bundle> {
        let leaves = self.nodes.iter().filter(|node| node.count > 0);
        let bundle = leaves.map(|leaf| Bundle {
            slots: Self::leaf_range(leaf),
            aabb: leaf.aabb,
        });
        bundle.collect()
    }

    /// Returns the callers' indices of a bundle's triangles, in the order of their places.
    pub fn ids_of(&self, bundle: &Bundle) -> &[u32] {
        &self.ids[bundle.slots.clone()]
    }

    /// Calls `see` with each triangle of a bundle and each triangle of the tree whose boxes overlap
    /// (touching counts), itself included, until it breaks.
    ///
    /// One walk serves the whole bundle, so all pairs of a tree are seen several times sooner than
    /// by a walk for each triangle. The order depends on the tree alone.
    pub fn visit_near<'a>(
        &'a self,
        bundle: &Bundle,
        mut see: impl FnMut([Member<'a>; 2]) -> ControlFlow<()>,
    ) {
        let own: Vec<(Member, Aabb)> = self.members(&bundle.slots).collect();
        let mut stack: Stack<u32> = Stack::default();
        stack.push(0);
        while let Some(index) = stack.pop() {
            let Some(node) = self.nodes.get(index as usize) else {
                continue;
            };
            if gap_squared(&bundle.aabb, &node.aabb) > 0.0 {
                continue;
            }
            if node.count == 0 {
                stack.push(node.first);
                stack.push(index + 1);
                continue;
            }
            for (other, aabb) in self.members(&Self::leaf_range(node)) {
                if gap_squared(&bundle.aabb, &aabb) > 0.0 {
                    continue;
                }
                let near = own.iter().filter(|(_, own)| gap_squared(own, &aabb) <= 0.0);
                for (own, _) in near {
                    if see([*own, other]).is_break() {
                        return;
                    }
                }
            }
        }
    }

    /// Returns the triangles in some slots, each with its box.
    fn members(&self, slots: &Range<usize>) -> impl Iterator<Item = (Member<'_>, Aabb)> {
        let slots = slots.clone().enumerate();
        slots.map(|(place, slot)| {
            let corners = &self.corners[slot];
            let id = self.ids[slot];
            (Member { place, id, corners }, Aabb::of_points(corners))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wavy sheet of triangles, 24 by 24 pairs.
    fn sheet() -> Vec<[Point; 3]> {
        let at = |i: usize, j: usize| {
            let (x, y) = (i as f64, j as f64);
            Point::new(x, y, (0.9 * x).sin() * (0.7 * y).cos())
        };
        let pair = |k: usize| {
            let (i, j) = (k % 24, k / 24);
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        };
        (0..24 * 24).flat_map(pair).collect()
    }

    #[test]
    fn every_pair_of_triangles_with_overlapping_boxes_is_seen_from_both_sides() {
        let triangles = sheet();
        let bvh = Bvh::new(triangles.clone());
        let mut seen = Vec::new();
        for bundle in bvh.bundles() {
            bvh.visit_near(&bundle, |[own, other]| {
                assert_eq!(bvh.ids_of(&bundle)[own.place], own.id);
                assert_eq!(*other.corners, triangles[other.id as usize]);
                seen.push([own.id, other.id]);
                ControlFlow::Continue(())
            });
        }
        seen.sort_unstable();
        let boxes: Vec<Aabb> = triangles.iter().map(Aabb::of_points).collect();
        let count = boxes.len() as u32;
        let all = (0..count).flat_map(|a| (0..count).map(move |b| [a, b]));
        let overlap =
            |&[a, b]: &[u32; 2]| gap_squared(&boxes[a as usize], &boxes[b as usize]) <= 0.0;
        assert_eq!(seen, all.filter(overlap).collect::<Vec<_>>());
    }

    #[test]
    fn a_walk_ends_where_it_is_broken_off() {
        let bvh = Bvh::new(sheet());
        let mut visits = 0;
        bvh.visit_near(&bvh.bundles()[0], |_| {
            visits += 1;
            if visits < 3 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        assert_eq!(visits, 3);
    }
}
