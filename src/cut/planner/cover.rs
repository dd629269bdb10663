//! Exact set cover by branch and bound: the fewest planes that open every void.

use crate::base::watch::{Cancelled, Watch};

/// A set of voids, one bit each.
pub(crate) type VoidSet = u128;

/// The most voids a [`VoidSet`] can name.
pub(crate) const MAX_VOIDS: usize = VoidSet::BITS as usize;

/// The result of a search over a family of sets.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cover {
    /// Indices of sets that together hold every element. Their number is minimal if it equals
    /// `at_least`.
    pub(crate) chosen: Vec<usize>,
    /// Lower bound on the number of sets: no choice of fewer holds every element.
    pub(crate) at_least: usize,
    /// Number of partial choices examined: the size of the proof.
    pub(crate) nodes: u64,
}

/// Number of partial choices after which a search returns the greedy cover, a second or two. Ten
/// voids need some hundred, twenty some thousand.
const MAX_NODES: u64 = 50_000;

/// Returns a smallest choice of `sets` whose union is `all`, proved by exhausting every smaller
/// size. Returns the greedy choice if the proof would take more than [`MAX_NODES`], and `None` if
/// even all sets together miss an element.
///
/// Branches on the element in the fewest sets. Prunes a branch if the remaining sets, at the size
/// of the largest, cannot hold the missing elements.
pub(crate) fn smallest_cover(
    sets: &[VoidSet],
    all: VoidSet,
    watch: &Watch,
) -> Result<Option<Cover>, Cancelled> {
    let Some(greedy) = greedy_cover(sets, all) else {
        return Ok(None);
    };
    let useful = drop_dominated(sets, all);
    let mut nodes = 0;
    for size in 0..greedy.len() {
        let mut search = Search {
            sets: &useful,
            size,
            limit: 1,
            nodes,
            found: Vec::new(),
            watch,
        };
        search.extend(all, &mut Vec::new())?;
        nodes = search.nodes;
        if let Some(chosen) = search.found.pop() {
            return Ok(Some(Cover {
                chosen,
                at_least: size,
                nodes,
            }));
        }
        if nodes >= MAX_NODES {
            return Ok(Some(Cover {
                chosen: greedy,
                at_least: size,
                nodes,
            }));
        }
    }
    Ok(Some(Cover {
        at_least: greedy.len(),
        chosen: greedy,
        nodes,
    }))
}

/// Returns a choice of sets whose union is `all`, or `None` if there is none. Each step takes the
/// first of the sets that hold the most missing elements. The choice is at most ln n + 1 times the
/// smallest (Johnson, "Approximation algorithms for combinatorial problems", J. Comput. Syst. Sci.
/// 9, 1974).
pub(crate) fn greedy_cover(sets: &[VoidSet], all: VoidSet) -> Option<Vec<usize>> {
    let (mut missing, mut chosen) = (all, Vec::new());
    while missing != 0 {
        let gain = |index: usize| (sets[index] & missing).count_ones();
        let best = (0..sets.len())
            .rev()
            .max_by_key(|&index| gain(index))
            .filter(|&index| gain(index) > 0)?;
        missing &= !sets[best];
        chosen.push(best);
    }
    Some(chosen)
}

/// Returns choices of `size` sets whose union is `all`, each as ascending indices. There are at
/// most `limit` of them, and fewer if [`MAX_NODES`] ends the search. They are in lexicographic
/// order.
pub(crate) fn covers_of_size(
    sets: &[VoidSet],
    all: VoidSet,
    [size, limit]: [usize; 2],
    watch: &Watch,
) -> Result<Vec<Vec<usize>>, Cancelled> {
    let numbered: Vec<(usize, VoidSet)> = sets.iter().map(|set| set & all).enumerate().collect();
    let mut search = Search {
        sets: &numbered,
        size,
        limit,
        nodes: 0,
        found: Vec::new(),
        watch,
    };
    search.extend(all, &mut Vec::new())?;
    for cover in &mut search.found {
        cover.sort_unstable();
    }
    search.found.sort();
    search.found.dedup();
    Ok(search.found)
}

/// Returns the sets that are not a proper part of another; of equal sets, the first.
fn drop_dominated(sets: &[VoidSet], all: VoidSet) -> Vec<(usize, VoidSet)> {
    let mut distinct: Vec<(usize, VoidSet)> =
        sets.iter().map(|set| set & all).enumerate().collect();
    distinct.sort_by_key(|&(index, set)| (set, index));
    distinct.dedup_by_key(|&mut (_, set)| set);
    let is_part = |a: VoidSet, b: VoidSet| a != b && a & b == a;
    let mut maximal: Vec<_> = distinct
        .iter()
        .copied()
        .filter(|&(_, a)| !distinct.iter().any(|&(_, b)| is_part(a, b)))
        .collect();
    maximal.sort_unstable();
    maximal
}

struct Search<'a> {
    sets: &'a [(usize, VoidSet)],
    size: usize,
    limit: usize,
    nodes: u64,
    found: Vec<Vec<usize>>,
    watch: &'a Watch,
}

impl Search<'_> {
    /// Adds sets to `chosen` until no element is missing.
    fn extend(&mut self, missing: VoidSet, chosen: &mut Vec<usize>) -> Result<(), Cancelled> {
        self.watch.check()?;
        self.nodes += 1;
        if missing == 0 {
            self.found.push(chosen.clone());
            return Ok(());
        }
        if self.nodes >= MAX_NODES || !self.can_suffice(missing, self.size - chosen.len()) {
            return Ok(());
        }
        let pivot = self.rarest(missing);
        for (index, set) in self.sets {
            if set & pivot != 0 && self.found.len() < self.limit {
                chosen.push(*index);
                self.extend(missing & !set, chosen)?;
                chosen.pop();
            }
        }
        Ok(())
    }

    /// Returns true if `left` sets, each as large as the largest, could hold the missing elements.
    fn can_suffice(&self, missing: VoidSet, left: usize) -> bool {
        let most = self
            .sets
            .iter()
            .map(|(_, set)| (set & missing).count_ones())
            .max()
            .unwrap_or(0);
        left > 0 && most as usize * left >= missing.count_ones() as usize
    }

    /// Returns the missing element that the fewest sets hold, as a set.
    fn rarest(&self, missing: VoidSet) -> VoidSet {
        let bits = (0..VoidSet::BITS)
            .map(|i| 1 << i)
            .filter(|bit| missing & bit != 0);
        bits.min_by_key(|bit| self.sets.iter().filter(|(_, set)| set & bit != 0).count())
            .unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn smallest_cover(sets: &[VoidSet], all: VoidSet) -> Option<Cover> {
        super::smallest_cover(sets, all, &Watch::silent()).unwrap()
    }

    #[test]
    fn three_pairs_of_a_triangle_need_two() {
        let cover = smallest_cover(&[0b011, 0b110, 0b101], 0b111).unwrap();
        assert_eq!(cover.chosen.len(), 2);
    }

    #[test]
    fn greedy_would_take_three_but_two_suffice() {
        // The largest set holds 4 of 6 elements, but the answer is the two halves of three.
        assert_eq!(
            greedy_cover(
                &[0b001111, 0b010101, 0b101010, 0b010000, 0b100000],
                0b111111
            )
            .map(|c| c.len()),
            Some(3)
        );
        let cover = smallest_cover(
            &[0b001111, 0b010101, 0b101010, 0b010000, 0b100000],
            0b111111,
        );
        assert_eq!(cover.unwrap().chosen, vec![1, 2]);
    }

    #[test]
    fn an_element_in_no_set_has_no_cover() {
        assert_eq!(smallest_cover(&[0b01], 0b11), None);
        assert_eq!(smallest_cover(&[], 0).map(|c| c.chosen), Some(vec![]));
    }

    #[test]
    fn small_families_have_the_same_answer_as_exhaustive_search() {
        // Each family is written as a 16-bit number. Every 97th is tried, 676 in all.
        for code in (0u32..=0xffff).step_by(97) {
            let sets: Vec<VoidSet> = (0..4)
                .map(|i| VoidSet::from(code >> (4 * i) & 0xf))
                .collect();
            let union = |pick: u32| {
                (0..4)
                    .filter(|i| pick >> i & 1 == 1)
                    .fold(0, |u, i| u | sets[i])
            };
            let exhausted = (0u32..16)
                .filter(|&pick| union(pick) == 0xf)
                .map(u32::count_ones)
                .min();
            let found = smallest_cover(&sets, 0xf).map(|cover| cover.chosen.len() as u32);
            assert!(
                smallest_cover(&sets, 0xf).is_none_or(|cover| cover.at_least == cover.chosen.len())
            );
            assert_eq!(found, exhausted, "family {code:#06x}");
        }
    }

    #[test]
    fn a_search_that_ends_early_still_covers_and_does_not_claim_to_be_smallest() {
        // Ninety triples over fifty elements, spread by a multiplicative sequence modulo a prime.
        let sets: Vec<VoidSet> = (1u32..91)
            .map(|i| {
                [7u32, 11, 13]
                    .iter()
                    .fold(0, |set, k| set | 1 << (i * i * k % 53 % 50))
            })
            .collect();
        let all = sets.iter().fold(0, |union, set| union | set);
        let cover = smallest_cover(&sets, all).unwrap();
        assert_eq!(
            cover.chosen.iter().fold(0, |union, &i| union | sets[i]),
            all
        );
        assert!(cover.nodes < MAX_NODES || cover.at_least < cover.chosen.len());
        assert!(cover.at_least <= cover.chosen.len());
    }

    #[test]
    fn every_cover_of_a_size_is_listed_once() {
        let sets = [0b011, 0b110, 0b101];
        let covers = covers_of_size(&sets, 0b111, [2, 100], &Watch::silent()).unwrap();
        assert_eq!(covers, vec![vec![0, 1], vec![0, 2], vec![1, 2]]);
    }
}
