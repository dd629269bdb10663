//! A void as pieces along each column, so that the results of different methods can be compared.

use super::columns::Columns;
use super::section::{Crossing, crossing_of_column};
use crate::geom::Quadric;
use crate::mass::Moments;

/// A stretch of a column, with the share of it that is emptied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Lower end, goal frame, mm.
    pub bottom_mm: f64,
    /// Upper end, goal frame, mm.
    pub top_mm: f64,
    /// Share of it that is emptied, 0 to 1; only 0 or 1 after rounding.
    pub share: f64,
}

/// A void: on every column disjoint pieces, ascending. Nothing is emptied between them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Emptied {
    /// Index of each column's first piece; one more entry than columns.
    starts: Vec<u32>,
    pieces: Vec<Piece>,
}

impl Emptied {
    /// Returns the part of the columns with q > 0, by the cell means of
    /// [`super::moments_where_positive`]; exact.
    pub fn where_positive(columns: &Columns, quadric: &Quadric) -> Self {
        let of_column = |column: usize| {
            let crossing = crossing_of_column(columns, quadric, column);
            let intervals = columns.intervals_of(column).iter();
            intervals
                .flat_map(move |&interval| positive_stretches(interval, crossing))
                .map(whole)
                .collect()
        };
        Self::of_columns((0..columns.len()).map(of_column))
    }

    /// Returns the void with these pieces on every column. A column's pieces must be disjoint;
    /// their order does not matter.
    pub(super) fn of_columns(columns: impl Iterator<Item = Vec<Piece>>) -> Self {
        let mut emptied = Self {
            starts: vec![0],
            pieces: Vec::new(),
        };
        for mut pieces in columns {
            pieces.retain(|piece| piece.share > 0.0 && piece.top_mm > piece.bottom_mm);
            pieces.sort_by(|a, b| a.bottom_mm.total_cmp(&b.bottom_mm));
            emptied.pieces.append(&mut pieces);
            emptied.starts.push(emptied.pieces.len() as u32);
        }
        emptied
    }

    /// Returns the pieces of column `index`.
    pub fn pieces_of(&self, index: usize) -> &[Piece] {
        &self.pieces[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    /// Returns the moments of the void on these columns, goal frame, mm.
    pub fn moments(&self, columns: &Columns) -> Moments {
        let of_column = |column: usize| {
            let add = |sum, piece: &Piece| {
                sum + columns.moments_between(column, [piece.bottom_mm, piece.top_mm]) * piece.share
            };
            self.pieces_of(column).iter().fold(Moments::default(), add)
        };
        let sum =
            (0..columns.len()).fold(Moments::default(), |sum, column| sum + of_column(column));
        sum * (columns.pitch_mm[0] * columns.pitch_mm[1])
    }

    /// Returns the volume ∫|β − β′| by which two voids on the same columns differ, mm³. With shares
    /// of 0 and 1 it is the volume of their symmetric difference.
    pub fn difference_mm3(&self, other: &Self, columns: &Columns) -> f64 {
        let lengths =
            (0..columns.len()).map(|i| difference_mm(self.pieces_of(i), other.pieces_of(i)));
        lengths.sum::<f64>() * columns.pitch_mm[0] * columns.pitch_mm[1]
    }
}

/// Returns the parts of an interval in which the quadric is positive.
fn positive_stretches(
    [bottom, top]: [f64; 2],
    crossing: Crossing,
) -> impl Iterator<Item = [f64; 2]> {
    let [lo, hi] = crossing.roots.map(|z| z.clamp(bottom, top));
    let parts = if crossing.is_positive_outside {
        [[bottom, lo], [hi, top]]
    } else {
        [[lo, hi], [hi, hi]]
    };
    parts.into_iter().filter(|[bottom, top]| top > bottom)
}

/// Returns a piece that is emptied completely.
pub(super) fn whole([bottom_mm, top_mm]: [f64; 2]) -> Piece {
    Piece {
        bottom_mm,
        top_mm,
        share: 1.0,
    }
}

/// Returns ∫|β − β′| along one column, mm. Both shares are constant between neighbouring ends of
/// pieces.
fn difference_mm(one: &[Piece], other: &[Piece]) -> f64 {
    let mut ends: Vec<f64> = one
        .iter()
        .chain(other)
        .flat_map(|piece| [piece.bottom_mm, piece.top_mm])
        .collect();
    ends.sort_by(f64::total_cmp);
    let between = |pair: &[f64]| {
        let middle = 0.5 * (pair[0] + pair[1]);
        (pair[1] - pair[0]) * (share_at(one, middle) - share_at(other, middle)).abs()
    };
    ends.windows(2).map(between).sum()
}

/// Returns the share emptied at a height.
fn share_at(pieces: &[Piece], z_mm: f64) -> f64 {
    let next = pieces.partition_point(|piece| piece.bottom_mm <= z_mm);
    let last = pieces[..next].last().filter(|piece| z_mm < piece.top_mm);
    last.map_or(0.0, |piece| piece.share)
}

#[cfg(test)]
mod tests {
    use super::super::choice::testing;
    use super::super::moments_where_positive;
    use super::*;

    #[test]
    fn the_pieces_of_a_quadric_have_the_moments_of_its_pass() {
        let columns = testing::uneven_columns();
        for sign in [1.0, -1.0] {
            let quadric = Quadric(testing::some_quadric().0.map(|q| sign * q));
            let drawn = Emptied::where_positive(&columns, &quadric).moments(&columns);
            let summed = moments_where_positive(&columns, &quadric);
            for (got, want) in drawn.0.iter().zip(summed.0) {
                assert!((got - want).abs() < 1e-10 * summed.0[0], "{got} {want}");
            }
        }
    }

    #[test]
    fn two_voids_differ_by_the_parts_that_only_one_of_them_has() {
        let columns = testing::uneven_columns();
        let all = Emptied::where_positive(
            &columns,
            &Quadric([1.0, 0., 0., 0., 0., 0., 0., 0., 0., 0.]),
        );
        let q = testing::some_quadric();
        let one = Emptied::where_positive(&columns, &q);
        let rest = Emptied::where_positive(&columns, &Quadric(q.0.map(|q| -q)));
        let volume = |emptied: &Emptied| emptied.moments(&columns).volume();
        assert_eq!(one.difference_mm3(&one, &columns), 0.0);
        assert!((one.difference_mm3(&rest, &columns) - volume(&all)).abs() < 1e-9);
        assert!((all.difference_mm3(&one, &columns) - volume(&rest)).abs() < 1e-9);
    }

    #[test]
    fn a_share_counts_in_proportion_in_a_difference() {
        let half = [Piece {
            bottom_mm: 0.0,
            top_mm: 2.0,
            share: 0.5,
        }];
        assert_eq!(difference_mm(&half, &[whole([1.0, 4.0])]), 0.5 + 0.5 + 2.0);
    }
}
