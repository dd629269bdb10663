//! Carves one row of columns: subtracts every piece that must stay from the inside of the solid.

use std::ops::Range;

use crate::shell::{OnRow, Piece, RowCrossings, RowForm, Ruler, Shell, inside_stretches};

/// Length, as a share of the wall, below which an interval is dropped as rounding between a slab
/// and the surface. With more, thin parts of the region would be lost; with less, slivers of 1e-14
/// mm would remain.
const SLIVER_RATIO: f64 = 1e-6;

/// The intervals of a row's columns while they are carved. Reused from row to row.
#[derive(Debug, Default)]
pub(super) struct Row {
    crossings: RowCrossings,
    intervals: Vec<Vec<[f64; 2]>>,
}

/// The triangles and pieces that may reach a row.
#[derive(Clone, Copy)]
pub(super) struct Reaching<'a> {
    pub triangles: &'a [u32],
    pub pieces: &'a [u32],
}

impl Row {
    /// Sets the intervals to those of the columns over `xs` at `y_mm` that may be emptied.
    pub fn carve(&mut self, shell: &Shell, reaching: Reaching, y_mm: f64, xs: &Ruler) {
        self.fill(shell, reaching.triangles, y_mm, xs);
        for &piece in reaching.pieces {
            self.subtract_piece(&shell.pieces()[piece as usize], y_mm, xs);
        }
        let sliver_mm = SLIVER_RATIO * shell.wall_mm();
        for intervals in &mut self.intervals {
            intervals.retain(|[bottom, top]| top - bottom > sliver_mm);
        }
    }

    /// Returns the columns with something left, by index, and their intervals.
    pub fn occupied(&self) -> impl Iterator<Item = (usize, &[[f64; 2]])> {
        let columns = self.intervals.iter().map(Vec::as_slice).enumerate();
        columns.filter(|(_, intervals)| !intervals.is_empty())
    }

    /// Sets the intervals to the stretches inside the solid.
    fn fill(&mut self, shell: &Shell, triangles: &[u32], y_mm: f64, xs: &Ruler) {
        self.crossings.find(shell.surface(), triangles, y_mm, xs);
        self.intervals.resize_with(xs.len(), Vec::new);
        for (column, intervals) in self.intervals.iter_mut().enumerate() {
            intervals.clear();
            inside_stretches(self.crossings.of(column), |stretch| intervals.push(stretch));
        }
    }

    /// Subtracts one piece from every column that it meets.
    fn subtract_piece(&mut self, piece: &Piece, y_mm: f64, xs: &Ruler) {
        let Some((x_range_mm, form)) = piece.on_row(y_mm) else {
            return;
        };
        let range = xs.range(x_range_mm);
        match form {
            RowForm::Slab(slab) => self.subtract_form(range, xs, &slab),
            RowForm::Cylinder(cylinder) => self.subtract_form(range, xs, &cylinder),
            RowForm::Ball(ball) => self.subtract_form(range, xs, &ball),
        }
    }

    /// Subtracts one cut piece from the columns of a range.
    fn subtract_form(&mut self, range: Range<usize>, xs: &Ruler, form: &impl OnRow) {
        for column in range {
            let intervals = &mut self.intervals[column];
            if !intervals.is_empty() {
                subtract(intervals, form.stretch(xs.at(column)));
            }
        }
    }
}

/// Subtracts the open stretch (bottom, top) from ascending disjoint intervals. Does nothing unless
/// bottom < top.
#[inline]
pub(super) fn subtract(intervals: &mut Vec<[f64; 2]>, [bottom, top]: [f64; 2]) {
    let mut index = 0;
    while index < intervals.len() && intervals[index][1] <= bottom {
        index += 1;
    }
    while bottom < top && index < intervals.len() && intervals[index][0] < top {
        let [low, high] = intervals[index];
        match (low < bottom, top < high) {
            (true, true) => {
                intervals[index][1] = bottom;
                intervals.insert(index + 1, [top, high]);
                return;
            }
            (true, false) => intervals[index][1] = bottom,
            (false, true) => intervals[index][0] = top,
            (false, false) => {
                intervals.remove(index);
                continue;
            }
        }
        index += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::fixtures::Random;

    fn rest_of(mut intervals: Vec<[f64; 2]>, stretch: [f64; 2]) -> Vec<[f64; 2]> {
        subtract(&mut intervals, stretch);
        intervals
    }

    #[test]
    fn subtracting_trims_splits_and_removes() {
        let two = || vec![[0.0, 2.0], [4.0, 6.0]];
        assert_eq!(rest_of(two(), [1.0, 5.0]), [[0.0, 1.0], [5.0, 6.0]]);
        assert_eq!(
            rest_of(two(), [0.5, 1.0]),
            [[0.0, 0.5], [1.0, 2.0], [4.0, 6.0]]
        );
        assert_eq!(rest_of(two(), [-1.0, 4.5]), [[4.5, 6.0]]);
        assert_eq!(rest_of(two(), [-1.0, 9.0]), [[0.0; 2]; 0]);
        assert_eq!(rest_of(two(), [2.0, 4.0]), two());
        assert_eq!(rest_of(two(), [f64::NAN, f64::NAN]), two());
        assert_eq!(rest_of(two(), [5.0, 1.0]), two());
    }

    #[test]
    fn the_rest_after_many_stretches_is_covered_by_none_of_them() {
        let mut random = Random::new(3);
        for _ in 0..200 {
            let stretches: Vec<[f64; 2]> = (0..20)
                .map(|_| [random.unit(), 0.1 * random.unit()])
                .map(|[bottom, length]| [bottom, bottom + length])
                .collect();
            let mut left = vec![[0.1, 0.4], [0.5, 0.9]];
            stretches
                .iter()
                .for_each(|&stretch| subtract(&mut left, stretch));
            assert!(left.windows(2).all(|pair| pair[0][1] < pair[1][0]));
            assert!(left.iter().all(|interval| interval[0] < interval[1]));
            for _ in 0..50 {
                let z = random.unit();
                let within =
                    |set: &[[f64; 2]]| set.iter().any(|[low, high]| (*low..*high).contains(&z));
                let expected = within(&[[0.1, 0.4], [0.5, 0.9]]) && !within(&stretches);
                assert_eq!(within(&left), expected, "at {z}");
            }
        }
    }
}
