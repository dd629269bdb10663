//! A tree of bounding boxes that finds which boxes overlap a given one.

use crate::geom::{Aabb, Point};

/// Boxes in a leaf. With 1 the tree has more nodes than boxes; above 8 most of the time goes into comparing
/// boxes that are far apart.
const LEAF_SIZE: usize = 4;

/// A balanced binary tree over boxes, split at the median along the longest side.
pub(super) struct BoxTree {
    nodes: Vec<Node>,
    items: Vec<(Aabb, u32)>,
}

struct Node {
    aabb: Aabb,
    /// The items below this node.
    start: u32,
    end: u32,
    /// The second child (the first one follows its parent), or 0 for a leaf.
    second: u32,
}

impl BoxTree {
    /// The tree over `boxes`, all finite. Costs n log n.
    pub fn new(boxes: impl Iterator<Item = Aabb>) -> Self {
        let items = boxes.zip(0..).collect();
        let mut tree = Self { nodes: Vec::new(), items };
        if !tree.items.is_empty() {
            tree.build(0, tree.items.len());
        }
        tree
    }

    fn build(&mut self, start: usize, end: usize) {
        let items = &mut self.items[start..end];
        let aabb = items.iter().fold(Aabb::EMPTY, |sum, (aabb, _)| sum.union(aabb));
        let index = self.nodes.len();
        self.nodes.push(Node { aabb, start: start as u32, end: end as u32, second: 0 });
        if items.len() > LEAF_SIZE {
            let axis = aabb.size().imax();
            let middle = |item: &(Aabb, u32)| item.0.min[axis] + item.0.max[axis];
            let half = items.len() / 2;
            items.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.1.cmp(&b.1)));
            self.build(start, start + half);
            self.nodes[index].second = self.nodes.len() as u32;
            self.build(start + half, end);
        }
    }

    /// Calls `visit` with the number of every box that overlaps or touches `aabb`.
    pub fn visit_overlapping(&self, aabb: &Aabb, mut visit: impl FnMut(u32)) {
        let mut stack = vec![0u32];
        while let Some(index) = stack.pop() {
            let Some(node) = self.nodes.get(index as usize).filter(|node| overlap(&node.aabb, aabb)) else {
                continue;
            };
            if node.second == 0 {
                let leaf = &self.items[node.start as usize..node.end as usize];
                leaf.iter().filter(|item| overlap(&item.0, aabb)).for_each(|item| visit(item.1));
            } else {
                stack.extend([node.second, index + 1]);
            }
        }
    }
}

/// Whether two boxes share a point.
fn overlap(a: &Aabb, b: &Aabb) -> bool {
    let below = |p: &Point, q: &Point| p.x <= q.x && p.y <= q.y && p.z <= q.z;
    below(&a.min, &b.max) && below(&b.min, &a.max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;

    /// Boxes scattered by a fixed rule.
    fn boxes(count: u32) -> Vec<Aabb> {
        let part = |i: u32, factor: u32| f64::from(i.wrapping_mul(factor) % 1000) / 1000.0;
        let make = |i| {
            let min = Point::new(part(i, 7919), part(i, 104_729), part(i, 1_299_709));
            Aabb { min, max: min + Vector::repeat(0.1 * part(i, 31)) }
        };
        (1..=count).map(make).collect()
    }

    #[test]
    fn the_tree_finds_what_comparing_all_boxes_finds() {
        let boxes = boxes(300);
        let tree = BoxTree::new(boxes.iter().copied());
        for query in &boxes {
            let mut found = Vec::new();
            tree.visit_overlapping(query, |i| found.push(i as usize));
            found.sort_unstable();
            let all: Vec<usize> = (0..boxes.len()).filter(|&i| overlap(&boxes[i], query)).collect();
            assert_eq!(found, all);
        }
    }

    #[test]
    fn a_tree_of_nothing_finds_nothing() {
        BoxTree::new(std::iter::empty()).visit_overlapping(&boxes(1)[0], |_| panic!("found a box"));
    }
}
