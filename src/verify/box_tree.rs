//! A tree of boxes that finds every box overlapping another.

use crate::geom::Aabb;

/// Boxes in a leaf, at most. Fewer make the tree deeper than the tests it saves; more make a leaf a long scan.
const LEAF_SIZE: usize = 8;

/// A balanced binary tree over boxes, split at the median along the longest side of each node.
#[derive(Debug)]
pub struct BoxTree<'a> {
    boxes: &'a [Aabb],
    order: Vec<u32>,
    bounds: Vec<Aabb>,
}

/// A node and the range of `order` under it.
#[derive(Clone, Copy)]
struct Node {
    index: usize,
    from: usize,
    to: usize,
}

impl Node {
    fn children(self) -> [Self; 2] {
        let middle = usize::midpoint(self.from, self.to);
        [
            Self { index: 2 * self.index, from: self.from, to: middle },
            Self { index: 2 * self.index + 1, from: middle, to: self.to },
        ]
    }
}

impl<'a> BoxTree<'a> {
    /// The tree over fewer than 2³² boxes, in O(n log n).
    pub fn new(boxes: &'a [Aabb]) -> Self {
        let leaves = boxes.len().div_ceil(LEAF_SIZE).next_power_of_two();
        let order = (0..boxes.len() as u32).collect();
        let mut tree = Self { boxes, order, bounds: vec![Aabb::EMPTY; 2 * leaves] };
        tree.split(tree.root());
        tree
    }

    /// The indices of the boxes that overlap `query` (touching counts), ascending.
    pub fn overlapping(&self, query: &Aabb) -> Vec<u32> {
        let mut found = Vec::new();
        self.collect(self.root(), query, &mut found);
        found.sort_unstable();
        found
    }

    fn root(&self) -> Node {
        Node { index: 1, from: 0, to: self.boxes.len() }
    }

    fn is_leaf(&self, node: Node) -> bool {
        2 * node.index >= self.bounds.len()
    }

    /// Bounds `node` and everything below it, ordering its range so that each child has half of it.
    fn split(&mut self, node: Node) {
        let (boxes, is_leaf) = (self.boxes, self.is_leaf(node));
        let range = &mut self.order[node.from..node.to];
        let all = range.iter().fold(Aabb::EMPTY, |all, &i| all.union(&boxes[i as usize]));
        self.bounds[node.index] = all;
        if is_leaf || range.is_empty() {
            return;
        }
        let axis = all.size().imax();
        let middle = |i: u32| boxes[i as usize].min[axis] + boxes[i as usize].max[axis];
        range.select_nth_unstable_by(node.children()[0].to - node.from, |&i, &j| {
            middle(i).total_cmp(&middle(j)).then(i.cmp(&j))
        });
        node.children().into_iter().for_each(|child| self.split(child));
    }

    fn collect(&self, node: Node, query: &Aabb, found: &mut Vec<u32>) {
        if !overlap(&self.bounds[node.index], query) {
            return;
        }
        if self.is_leaf(node) {
            let leaf = self.order[node.from..node.to].iter();
            found.extend(leaf.filter(|&&i| overlap(&self.boxes[i as usize], query)));
        } else {
            node.children().into_iter().for_each(|child| self.collect(child, query, found));
        }
    }
}

/// Whether two boxes share a point.
fn overlap(a: &Aabb, b: &Aabb) -> bool {
    (0..3).all(|axis| a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use proptest::prelude::*;

    prop_compose! {
        fn a_box()(x in -9..9i32, y in -9..9i32, z in -9..9i32, a in 0..4i32, b in 0..4i32, c in 0..4i32) -> Aabb {
            let min = Point::new(f64::from(x), f64::from(y), f64::from(z));
            Aabb { min, max: min + Vector::new(f64::from(a), f64::from(b), f64::from(c)) }
        }
    }

    proptest! {
        #[test]
        fn the_tree_finds_exactly_what_brute_force_finds(
            boxes in prop::collection::vec(a_box(), 0..200), query in a_box()
        ) {
            let brute: Vec<u32> =
                (0..boxes.len() as u32).filter(|&i| overlap(&boxes[i as usize], &query)).collect();
            prop_assert_eq!(BoxTree::new(&boxes).overlapping(&query), brute);
        }
    }
}
