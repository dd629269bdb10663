//! Sorts items into blocks of rows.

use std::ops::Range;

use super::ruler::Ruler;

/// For each block of `rows_per_block` rows, the items whose y-range reaches into it, in the items'
/// own order.
#[derive(Debug, Clone, PartialEq)]
pub struct Bins {
    starts: Vec<usize>,
    members: Vec<u32>,
}

impl Bins {
    /// Bins items by their y-ranges, mm. A range that meets no row is in no bin.
    pub fn of_ranges<I>(ranges: I, rows: &Ruler, rows_per_block: usize) -> Self
    where
        I: Iterator<Item = [f64; 2]> + Clone,
    {
        let blocks_of = |range| blocks_of(rows.range(range), rows_per_block);
        let mut starts = vec![0; rows.len().div_ceil(rows_per_block) + 1];
        ranges
            .clone()
            .flat_map(blocks_of)
            .for_each(|block| starts[block + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut ends = starts.clone();
        let mut members = vec![0; ends[ends.len() - 1]];
        for (item, range) in ranges.enumerate() {
            for block in blocks_of(range) {
                members[ends[block]] = item as u32;
                ends[block] += 1;
            }
        }
        Self { starts, members }
    }

    /// Returns the items that reach into block `block`, in ascending order.
    pub fn of(&self, block: usize) -> &[u32] {
        &self.members[self.starts[block]..self.starts[block + 1]]
    }
}

/// Returns the blocks that hold these rows.
fn blocks_of(rows: Range<usize>, rows_per_block: usize) -> Range<usize> {
    if rows.is_empty() {
        0..0
    } else {
        rows.start / rows_per_block..(rows.end - 1) / rows_per_block + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_item_is_in_every_block_it_reaches_into_and_in_no_other() {
        let rows = Ruler::covering([0.0, 10.0], 1.0, 0.5);
        let ranges = [
            [0.0, 10.0],
            [3.6, 4.4],
            [5.0, 6.0],
            [-3.0, 0.6],
            [20.0, 30.0],
        ];
        let bins = Bins::of_ranges(ranges.into_iter(), &rows, 4);
        assert_eq!(bins.of(0), [0, 3]);
        assert_eq!(bins.of(1), [0, 2]);
        assert_eq!(bins.of(2), [0]);
    }
}
