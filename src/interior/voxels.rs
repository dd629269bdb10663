//! Voxels: every column cut into slices, each emptied by a share.

use super::cells::Cells;
use super::choice::Choice;
use super::columns::Columns;
use super::emptied::{Emptied, Piece};
use crate::geom::Quadric;
use crate::mass::Moments;

/// Cells of one column's cross-section and a given height: the voxels with which Wu, Kramer and
/// Westermann compare their rays (their Table 2). The last voxels of an interval are cut at its
/// ends, so that all voxels together are exactly the columns.
#[derive(Debug, Clone)]
pub struct Voxels<'a> {
    columns: &'a Columns,
    slices: Vec<Slice>,
    cells: Cells,
}

/// A part of a column.
#[derive(Debug, Clone, Copy)]
struct Slice {
    column: u32,
    bottom: f64,
    top: f64,
}

impl<'a> Voxels<'a> {
    /// Returns the columns cut at all multiples of `height_mm`, which must be positive.
    pub fn of(columns: &'a Columns, height_mm: f64) -> Self {
        let of_column = |column: usize| {
            let intervals = columns.intervals_of(column).iter();
            intervals.flat_map(move |interval| slices(column, *interval, height_mm))
        };
        let slices: Vec<Slice> = (0..columns.len()).flat_map(of_column).collect();
        let area_mm2 = columns.pitch_mm[0] * columns.pitch_mm[1];
        let moments = |slice: &Slice| {
            columns.moments_between(slice.column as usize, [slice.bottom, slice.top]) * area_mm2
        };
        let cells = Cells::new(slices.iter().map(moments).collect());
        Self {
            columns,
            slices,
            cells,
        }
    }
}

/// Returns an interval of a column cut at the multiples of a height.
fn slices(column: usize, [bottom, top]: [f64; 2], height: f64) -> impl Iterator<Item = Slice> {
    let (first, last) = ((bottom / height).floor(), (top / height).ceil());
    (0..(last - first) as usize).filter_map(move |i| {
        let low = (first + i as f64) * height;
        let (bottom, top) = (low.max(bottom), (low + height).min(top));
        (top > bottom).then_some(Slice {
            column: column as u32,
            bottom,
            top,
        })
    })
}

impl Choice for Voxels<'_> {
    fn weights(&self) -> &[f64] {
        self.cells.weights()
    }

    fn nothing(&self) -> Vec<f64> {
        vec![0.0; self.slices.len()]
    }

    fn moments(&self, x: &[f64]) -> Moments {
        self.cells.moments(x)
    }

    fn derivative(&self, _: &[f64], quadric: &Quadric, out: &mut [f64]) {
        self.cells.derivative(quadric, out);
    }

    fn emptied(&self, x: &[f64]) -> Emptied {
        let mut pieces = vec![Vec::new(); self.columns.len()];
        for (slice, &share) in self.slices.iter().zip(x) {
            let piece = Piece {
                bottom_mm: slice.bottom,
                top_mm: slice.top,
                share,
            };
            pieces[slice.column as usize].push(piece);
        }
        Emptied::of_columns(pieces.into_iter())
    }
}

#[cfg(test)]
mod tests {
    use super::super::choice::testing;
    use super::*;

    #[test]
    fn voxels_have_the_moments_of_their_pieces_and_the_slopes_of_differences() {
        let columns = testing::uneven_columns();
        testing::check_choice(&Voxels::of(&columns, 0.7), &columns);
    }

    #[test]
    fn all_voxels_together_are_the_columns() {
        let columns = testing::uneven_columns();
        let voxels = Voxels::of(&columns, 0.7);
        let all = voxels.moments(&vec![1.0; voxels.count()]);
        for (got, want) in all.0.iter().zip(columns.moments().0) {
            assert!((got - want).abs() < 1e-10 * all.0[0]);
        }
    }
}
