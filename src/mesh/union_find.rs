//! Disjoint sets of indices (Tarjan, "Efficiency of a good but not linear set union algorithm", J. ACM 22, 1975).

/// Indices 0 to n − 1 in disjoint sets; each set is named by its least member.
pub(crate) struct UnionFind(Vec<u32>);

impl UnionFind {
    /// Every index in a set of its own.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The least member of the set that holds `index`.
    pub(crate) fn root(&mut self, index: u32) -> u32 {
        let mut at = index;
        while self.0[at as usize] != at {
            let grandparent = self.0[self.0[at as usize] as usize];
            self.0[at as usize] = grandparent;
            at = grandparent;
        }
        at
    }

    /// Makes one set of the two sets that hold `a` and `b`.
    pub(crate) fn unite(&mut self, a: u32, b: u32) {
        let (i, j) = (self.root(a), self.root(b));
        self.0[i.max(j) as usize] = i.min(j);
    }
}
