//! Exact set cover by branch and bound: the fewest planes that open every void.

/// A set of voids, one bit each.
pub(crate) type VoidSet = u128;

/// The most voids a [`VoidSet`] can name.
pub(crate) const MAX_VOIDS: usize = VoidSet::BITS as usize;

/// What a search over a family of sets found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cover {
    /// Indices of a smallest choice of sets that together hold every element.
    pub(crate) chosen: Vec<usize>,
    /// How many partial choices were looked at: the size of the proof that fewer do not suffice.
    pub(crate) nodes: u64,
}

/// A smallest choice of `sets` whose union is `all`, proved smallest by exhausting every smaller size;
/// `None` when even all of them leave something out.
///
/// Branches on the element in the fewest sets; prunes where the sets left, at the size of the largest, cannot
/// hold what is missing.
pub(crate) fn smallest_cover(sets: &[VoidSet], all: VoidSet) -> Option<Cover> {
    if sets.iter().fold(0, |union, set| union | set) & all != all {
        return None;
    }
    let useful = undominated(sets, all);
    let mut nodes = 0;
    for size in 0..=all.count_ones() as usize {
        let mut search = Search { sets: &useful, size, limit: 1, nodes: 0, found: Vec::new() };
        search.extend(all, &mut Vec::new());
        nodes += search.nodes;
        if let Some(chosen) = search.found.pop() {
            return Some(Cover { chosen, nodes });
        }
    }
    None
}

/// Choices of `size` sets whose union is `all`, each as ascending indices, at most `limit` of them, in the order in
/// which sets early in the list come first.
pub(crate) fn covers_of_size(sets: &[VoidSet], all: VoidSet, [size, limit]: [usize; 2]) -> Vec<Vec<usize>> {
    let numbered: Vec<(usize, VoidSet)> = sets.iter().map(|set| set & all).enumerate().collect();
    let mut search = Search { sets: &numbered, size, limit, nodes: 0, found: Vec::new() };
    search.extend(all, &mut Vec::new());
    for cover in &mut search.found {
        cover.sort_unstable();
    }
    search.found.sort();
    search.found.dedup();
    search.found
}

/// The sets that are not part of another (of equal ones the first).
fn undominated(sets: &[VoidSet], all: VoidSet) -> Vec<(usize, VoidSet)> {
    let mut distinct: Vec<(usize, VoidSet)> = sets.iter().map(|set| set & all).enumerate().collect();
    distinct.sort_by_key(|&(index, set)| (set, index));
    distinct.dedup_by_key(|&mut (_, set)| set);
    let is_part = |a: VoidSet, b: VoidSet| a != b && a & b == a;
    let mut kept: Vec<_> =
        distinct.iter().copied().filter(|&(_, a)| !distinct.iter().any(|&(_, b)| is_part(a, b))).collect();
    kept.sort_unstable();
    kept
}

struct Search<'a> {
    sets: &'a [(usize, VoidSet)],
    size: usize,
    limit: usize,
    nodes: u64,
    found: Vec<Vec<usize>>,
}

impl Search<'_> {
    /// Adds sets to `chosen` until nothing is missing.
    fn extend(&mut self, missing: VoidSet, chosen: &mut Vec<usize>) {
        self.nodes += 1;
        if missing == 0 {
            self.found.push(chosen.clone());
            return;
        }
        if !self.can_suffice(missing, self.size - chosen.len()) {
            return;
        }
        let pivot = self.rarest(missing);
        for (index, set) in self.sets {
            if set & pivot != 0 && self.found.len() < self.limit {
                chosen.push(*index);
                self.extend(missing & !set, chosen);
                chosen.pop();
            }
        }
    }

    /// Whether `left` more sets, each as useful as the most useful, could hold what is missing.
    fn can_suffice(&self, missing: VoidSet, left: usize) -> bool {
        let most = self.sets.iter().map(|(_, set)| (set & missing).count_ones()).max().unwrap_or(0);
        left > 0 && most as usize * left >= missing.count_ones() as usize
    }

    /// The missing element that the fewest sets hold, as a set.
    fn rarest(&self, missing: VoidSet) -> VoidSet {
        let bits = (0..VoidSet::BITS).map(|i| 1 << i).filter(|bit| missing & bit != 0);
        bits.min_by_key(|bit| self.sets.iter().filter(|(_, set)| set & bit != 0).count()).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_pairs_of_a_triangle_need_two() {
        let cover = smallest_cover(&[0b011, 0b110, 0b101], 0b111).unwrap();
        assert_eq!(cover.chosen.len(), 2);
    }

    #[test]
    fn greedy_would_take_three_but_two_suffice() {
        // The largest set (4 of 6) tempts; the two halves of three are the answer.
        let cover = smallest_cover(&[0b001111, 0b010101, 0b101010, 0b110000 & 0b010000, 0b100000], 0b111111);
        assert_eq!(cover.unwrap().chosen, vec![1, 2]);
    }

    #[test]
    fn an_element_in_no_set_has_no_cover() {
        assert_eq!(smallest_cover(&[0b01], 0b11), None);
        assert_eq!(smallest_cover(&[], 0).map(|c| c.chosen), Some(vec![]));
    }

    #[test]
    fn on_every_family_of_four_sets_over_four_elements_the_answer_is_that_of_exhaustion() {
        // Each family is written as a 16-bit number; every 97th is tried, 675 in all.
        for code in (0u32..=0xffff).step_by(97) {
            let sets: Vec<VoidSet> = (0..4).map(|i| VoidSet::from(code >> (4 * i) & 0xf)).collect();
            let union = |pick: u32| (0..4).filter(|i| pick >> i & 1 == 1).fold(0, |u, i| u | sets[i]);
            let exhausted = (0u32..16).filter(|&pick| union(pick) == 0xf).map(u32::count_ones).min();
            let found = smallest_cover(&sets, 0xf).map(|cover| cover.chosen.len() as u32);
            assert_eq!(found, exhausted, "family {code:#06x}");
        }
    }

    #[test]
    fn every_cover_of_a_size_is_listed_once() {
        let covers = covers_of_size(&[0b011, 0b110, 0b101], 0b111, [2, 100]);
        assert_eq!(covers, vec![vec![0, 1], vec![0, 2], vec![1, 2]]);
    }
}
