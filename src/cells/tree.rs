//! Boxes in a tree, for those that meet another box or hold a point.

use crate::geom::{Aabb, Point};

/// Boxes that lie near each other in their list, and the boxes around each two, and so on.
#[derive(Debug, Clone)]
pub(super) struct Tree {
    /// The boxes themselves, then those around each two of the level before, up to one.
    levels: Vec<Vec<Aabb>>,
}

impl Tree {
    /// Makes a tree of boxes.
    pub fn new(boxes: Vec<Aabb>) -> Self {
        let mut levels = vec![boxes];
        while let Some(last) = levels.last().filter(|last| last.len() > 1) {
            let around = last.chunks(2).map(|pair| match pair {
                [one, other] => one.union(other),
                _ => pair[0],
            });
            let around = around.collect();
            levels.push(around);
        }
        Self { levels }
    }

    /// Returns the boxes that pass a test, ascending. A box around others must pass it if one of
    /// them does.
    pub fn find(&self, passes: impl Fn(&Aabb) -> bool) -> Vec<usize> {
        let top = self.levels.len() - 1;
        let mut open: Vec<(usize, usize)> = (0..self.levels[top].len()).map(|k| (top, k)).collect();
        let mut found = Vec::new();
        while let Some((level, k)) = open.pop() {
            if !passes(&self.levels[level][k]) {
                continue;
            }
            match level.checked_sub(1) {
                None => found.push(k),
                Some(below) => {
                    let end = (2 * k + 2).min(self.levels[below].len());
                    open.extend((2 * k..end).rev().map(|child| (below, child)));
                }
            }
        }
        found
    }
}

/// Returns true if two boxes overlap.
pub(super) fn overlap(one: &Aabb, other: &Aabb) -> bool {
    (0..3).all(|axis| one.min[axis] < other.max[axis] && other.min[axis] < one.max[axis])
}

/// Returns true if a point lies in a box, or on its lower sides.
pub(super) fn holds(bounds: &Aabb, at: &Point) -> bool {
    (0..3).all(|axis| bounds.min[axis] <= at[axis] && at[axis] < bounds.max[axis])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::geom::Vector;

    #[test]
    fn a_tree_finds_the_boxes_that_all_of_them_would_be_asked_for() {
        let mut random = Random::new(9);
        for count in [0, 1, 2, 3, 7, 64, 100] {
            let boxes = (0..count).map(|_| {
                let min = Point::from([0; 3].map(|_| random.between(0.0, 1.0)));
                let size = Vector::from([0; 3].map(|_| random.between(0.0, 0.3)));
                Aabb {
                    min,
                    max: min + size,
                }
            });
            let boxes: Vec<Aabb> = boxes.collect();
            let tree = Tree::new(boxes.clone());
            for _ in 0..20 {
                let at = Point::from([0; 3].map(|_| random.between(0.0, 1.0)));
                let expected: Vec<usize> = (0..count).filter(|&k| holds(&boxes[k], &at)).collect();
                assert_eq!(tree.find(|one| holds(one, &at)), expected);
            }
        }
    }
}
