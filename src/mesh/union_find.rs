//! Disjoint sets that merge (union–find).

/// Disjoint sets of the numbers 0 to n − 1, with path halving (Tarjan, "Efficiency of a good but
/// not linear set union algorithm", J. ACM 22, 1975).
///
/// The smallest member represents its set, so results do not depend on the order of the merges.
#[derive(Debug, Clone)]
pub(crate) struct UnionFind(Vec<u32>);

impl UnionFind {
    /// Makes `count` sets of one number each.
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// Returns the smallest member of the set that contains `item`.
    pub fn root(&mut self, mut item: u32) -> u32 {
        while self.0[item as usize] != item {
            let above = self.0[item as usize];
            self.0[item as usize] = self.0[above as usize];
            item = above;
        }
        item
    }

    /// Merges the sets of `a` and `b`; returns `false` if they were one set before.
    pub fn merge(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// Returns the rank of every number's set, and the number of sets. Sets are ranked from 0
    /// in the order of their smallest members.
    pub fn labels(mut self) -> (Vec<u32>, usize) {
        let mut labels = vec![0; self.0.len()];
        let mut sets = 0;
        for item in 0..self.0.len() as u32 {
            let root = self.root(item);
            if root == item {
                labels[item as usize] = sets;
                sets += 1;
            } else {
                labels[item as usize] = labels[root as usize];
            }
        }
        (labels, sets as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_count_the_sets_in_the_order_of_their_smallest_members() {
        let mut sets = UnionFind::new(6);
        assert!(sets.merge(5, 2));
        assert!(sets.merge(2, 4));
        assert!(!sets.merge(4, 5));
        assert_eq!(sets.labels(), (vec![0, 1, 2, 3, 2, 2], 4));
    }
}
