//! The order in which the vertices of a surface are eliminated: nested dissection by place.
//!
//! George, "Nested dissection of a regular finite element mesh", SIAM J. Numer. Anal. 10, 1973. The
//! vertices are halved across their longest extent; those of one half with a neighbour in the other
//! come last. So few entries arise that a factor of 5000 vertices takes some 20 ms.

/// The largest set that is not halved. Smaller ones cost time, larger ones entries.
const LEAF: usize = 24;

/// A graph in space.
pub(super) struct Graph<'a> {
    /// The place of every vertex.
    pub places: &'a [[f64; 3]],
    /// The first neighbour of every vertex; one more than there are vertices.
    pub starts: &'a [u32],
    /// The neighbours.
    pub columns: &'a [u32],
}

impl Graph<'_> {
    /// Returns the vertices in the order of their elimination.
    pub fn order(&self) -> Vec<u32> {
        let mut side = vec![0; self.places.len()];
        let mut order = Vec::with_capacity(self.places.len());
        let all = (0..self.places.len() as u32).collect();
        self.dissect(all, &mut side, &mut order);
        order
    }

    /// Appends a set of vertices to the order.
    ///
    /// `side` is scratch: 1 for one half of the set at hand.
    fn dissect(&self, mut set: Vec<u32>, side: &mut [u8], order: &mut Vec<u32>) {
        if set.len() <= LEAF {
            order.extend(set);
            return;
        }
        let axis = self.longest_axis(&set);
        let along = |v: &u32| self.places[*v as usize][axis];
        let middle = set.len() / 2;
        set.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
        let mut far = set.split_off(middle);
        // The halves are sets; only their order must not depend on how they were found.
        set.sort_unstable();
        far.sort_unstable();
        set.iter().for_each(|v| side[*v as usize] = 1);
        let touches = |v: &u32| self.neighbours(*v).any(|w| side[w as usize] == 1);
        let (between, far): (Vec<u32>, Vec<u32>) = far.into_iter().partition(touches);
        set.iter().for_each(|v| side[*v as usize] = 0);
        self.dissect(set, side, order);
        self.dissect(far, side, order);
        order.extend(between);
    }

    fn neighbours(&self, v: u32) -> impl Iterator<Item = u32> {
        let range = self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize;
        self.columns[range].iter().copied()
    }

    fn longest_axis(&self, set: &[u32]) -> usize {
        let extent = |axis: usize| {
            let along = set.iter().map(|v| self.places[*v as usize][axis]);
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
            high - low
        };
        let longest = [0, 1, 2]
            .into_iter()
            .max_by(|a, b| extent(*a).total_cmp(&extent(*b)));
        longest.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_vertex_comes_once_and_what_separates_comes_last() {
        // A row of 100 vertices: the one in the middle separates both halves.
        let places: Vec<[f64; 3]> = (0..100).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        let neighbours = |i: u32| {
            [i.checked_sub(1), (i < 99).then_some(i + 1)]
                .into_iter()
                .flatten()
        };
        let columns: Vec<u32> = (0..100).flat_map(neighbours).collect();
        let mut starts = vec![0];
        for i in 0..100 {
            starts.push(starts[starts.len() - 1] + neighbours(i).count() as u32);
        }
        let graph = Graph {
            places: &places,
            starts: &starts,
            columns: &columns,
        };
        let mut order = graph.order();
        assert_eq!(order[99], 50);
        order.sort_unstable();
        assert_eq!(order, (0..100).collect::<Vec<_>>());
    }
}
