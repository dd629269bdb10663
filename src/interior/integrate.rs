//! Integrates over the columns in one pass: the moments of the part that a quadric empties, and
//! their derivative.

use std::ops::Range;

use nalgebra::SMatrix;
use rayon::prelude::*;

use super::columns::Columns;
use super::pack::{Pack, RowSums};
use super::section::{Section, cell_variance};
use crate::geom::Quadric;
use crate::mass::Moments;

/// A symmetric 10 × 10 matrix over the monomials of [`Moments`].
pub type Matrix10 = SMatrix<f64, 10, 10>;

/// Columns summed as one unit of work. Below about 200 the threads' overhead shows; above about
/// 1000 the last units of a coarse interior leave cores idle. The units, and so the bits of the
/// sums, are the same for any number of threads.
const BLOCK_COLUMNS: usize = 640;

/// Exponents (i, j, k) of x, y, z in each of the ten monomials.
const EXPONENTS: [[usize; 3]; 10] = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 1, 0],
    [0, 1, 1],
    [1, 0, 1],
    [2, 0, 0],
    [0, 2, 0],
    [0, 0, 2],
];

/// Returns the moments of { q > 0 } over the columns.
///
/// Exact in z. In x and y a column stands for its cell: x² and y² enter by their cell means, in the
/// moments and in q alike. So the sums are exact for boxes made of whole cells. No other void on
/// the columns has a larger integral of q (see [`crate::guide::theory`], "The reachable set").
///
/// Bitwise the same for any number of threads. Costs about 5 to 10 ns a column.
pub fn moments_where_positive(columns: &Columns, quadric: &Quadric) -> Moments {
    pass::<false>(columns, quadric, false).moments(columns.pitch_mm)
}

/// Returns the moments of { q > 0 } over the columns, and their derivative with respect to q's ten
/// coefficients.
///
/// The derivative is W = Σ m mᵀ / |∂q/∂z| · cell area over the roots inside the intervals:
/// symmetric and positive semidefinite (see [`crate::guide::theory`], "Goals"). A column that q
/// only touches has no derivative and adds none. If the surface is so upright that whole columns
/// are emptied or kept at once, the sum over columns has no derivative. There W holds the
/// derivative for the body made of their cells.
pub fn moments_and_derivative(columns: &Columns, quadric: &Quadric) -> (Moments, Matrix10) {
    with_derivative(columns, quadric, false)
}

/// Returns the moments of { q > 0 } over the columns, and the derivative of these very sums.
///
/// As [`moments_and_derivative`], but where a surface is upright the derivative is that of the
/// columns, however steep. A search that must meet equations to the last digit needs it.
pub fn moments_and_own_derivative(columns: &Columns, quadric: &Quadric) -> (Moments, Matrix10) {
    with_derivative(columns, quadric, true)
}

fn with_derivative(columns: &Columns, quadric: &Quadric, keeps_roots: bool) -> (Moments, Matrix10) {
    let sums = pass::<true>(columns, quadric, keeps_roots);
    (
        sums.moments(columns.pitch_mm),
        sums.derivative(columns.pitch_mm),
    )
}

/// Sums every block separately, then adds the blocks in order.
fn pass<const DERIVATIVE: bool>(columns: &Columns, quadric: &Quadric, keeps_roots: bool) -> Sums {
    let blocks = columns.len().div_ceil(BLOCK_COLUMNS);
    let sum = |block: usize| {
        let first = block * BLOCK_COLUMNS;
        sum_block::<DERIVATIVE>(
            columns,
            quadric,
            first..columns.len().min(first + BLOCK_COLUMNS),
            Pack::new(keeps_roots),
        )
    };
    if blocks == 1 {
        return sum(0);
    }
    let parts: Vec<Sums> = (0..blocks).into_par_iter().map(sum).collect();
    let mut total = Sums::default();
    parts.iter().for_each(|part| total.add(part));
    total
}

/// Sums one block, row by row. Columns of equal y share the powers of y and half of q's
/// coefficients.
fn sum_block<const DERIVATIVE: bool>(
    columns: &Columns,
    quadric: &Quadric,
    block: Range<usize>,
    mut pack: Pack,
) -> Sums {
    let mut sums = Sums::default();
    let rows = columns.centers[block.clone()].chunk_by(|one, next| one[1] == next[1]);
    let mut first = block.start;
    for row in rows {
        let Some(&[_, y]) = row.first() else { continue };
        let section = Section::new(quadric, columns.pitch_mm, y);
        let mut of_row = RowSums::default();
        let ends = columns.starts[first..=first + row.len()].windows(2);
        for (&[x, _], ends) in row.iter().zip(ends) {
            for &stretch in &columns.intervals[ends[0] as usize..ends[1] as usize] {
                pack.push(x, stretch);
                if pack.is_full() {
                    pack.empty_into::<DERIVATIVE>(&section, &mut of_row);
                }
            }
        }
        pack.empty_into::<DERIVATIVE>(&section, &mut of_row);
        sums.add_row::<DERIVATIVE>(&of_row, y);
        first += row.len();
    }
    sums
}

/// Sums of xⁱ yʲ zᵏ, at `[i][j][k]` for i + j + k ≤ 4.
pub(super) type RootSums = [[[f64; 5]; 5]; 5];

/// Sums over columns, per unit of cell area.
pub(super) struct Sums {
    /// xⁱ yʲ ∫zᵏ over the void, at `[i][j][k]` for i + j + k ≤ 2.
    emptied: [[[f64; 3]; 3]; 3],
    /// xⁱ yʲ Σ zᵏ/|∂q/∂z| over the roots, at `[i][j][k]` for i + j + k ≤ 4. Every entry of m mᵀ is
    /// one of these 35.
    roots: RootSums,
}

impl Default for Sums {
    fn default() -> Self {
        Self {
            emptied: [[[0.0; 3]; 3]; 3],
            roots: [[[0.0; 5]; 5]; 5],
        }
    }
}

impl Sums {
    /// Returns sums of xⁱ yʲ ∫zᵏ as moments, and as the integrals of m mᵀ in place of the
    /// derivative.
    pub(super) fn of_powers(powers: RootSums) -> Self {
        let mut sums = Self {
            roots: powers,
            ..Self::default()
        };
        for [i, j, k] in EXPONENTS {
            sums.emptied[i][j][k] = powers[i][j][k];
        }
        sums
    }

    fn add(&mut self, other: &Self) {
        let own = self.emptied.as_flattened_mut().as_flattened_mut();
        own.iter_mut()
            .zip(other.emptied.as_flattened().as_flattened())
            .for_each(|(sum, term)| *sum += term);
        let own = self.roots.as_flattened_mut().as_flattened_mut();
        own.iter_mut()
            .zip(other.roots.as_flattened().as_flattened())
            .for_each(|(sum, term)| *sum += term);
    }

    fn add_row<const DERIVATIVE: bool>(&mut self, row: &RowSums, y: f64) {
        const X_AND_Z: [[usize; 2]; 6] = [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [0, 2]];
        for ([i, k], sum) in X_AND_Z.into_iter().zip(row.emptied) {
            let mut term = sum;
            for j in 0..=2 - i - k {
                self.emptied[i][j][k] += term;
                term *= y;
            }
        }
        if DERIVATIVE {
            self.add_row_roots(row, y);
        }
    }

    fn add_row_roots(&mut self, row: &RowSums, y: f64) {
        for k in 0..5 {
            for i in 0..5 - k {
                let mut term = row.roots[k][i];
                for j in 0..5 - k - i {
                    self.roots[i][j][k] += term;
                    term *= y;
                }
            }
        }
    }

    pub(super) fn moments(&self, pitch_mm: [f64; 2]) -> Moments {
        let area = pitch_mm[0] * pitch_mm[1];
        let mut moments = EXPONENTS.map(|[i, j, k]| self.emptied[i][j][k] * area);
        moments[7] += moments[0] * cell_variance(pitch_mm[0]);
        moments[8] += moments[0] * cell_variance(pitch_mm[1]);
        Moments(moments)
    }

    pub(super) fn derivative(&self, pitch_mm: [f64; 2]) -> Matrix10 {
        let at_centers = Matrix10::from_fn(|row, column| {
            let [i, j, k]: [usize; 3] =
                std::array::from_fn(|axis| EXPONENTS[row][axis] + EXPONENTS[column][axis]);
            self.roots[i][j][k]
        });
        let mut to_means = Matrix10::identity();
        to_means[(7, 0)] = cell_variance(pitch_mm[0]);
        to_means[(8, 0)] = cell_variance(pitch_mm[1]);
        to_means * at_centers * to_means.transpose() * (pitch_mm[0] * pitch_mm[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    /// Returns a box of whole cells with one interval for each column.
    fn box_columns(pitch: [f64; 2], cells: [usize; 2], z: [f64; 2]) -> Columns {
        let mut columns = Columns {
            pitch_mm: pitch,
            starts: vec![0],
            ..Columns::default()
        };
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                columns.centers.push([
                    (i as f64 + 0.5) * pitch[0] - 3.0,
                    (j as f64 + 0.5) * pitch[1] + 1.0,
                ]);
                columns.intervals.push(z);
                columns.starts.push(columns.intervals.len() as u32);
            }
        }
        columns
    }

    /// A quadric that crosses the box of `box_columns` with one root on some columns, and two or
    /// none on others.
    const CROSSING: Quadric = Quadric([3.0, 0.2, -0.4, 0.5, 0.1, -0.2, 0.15, -0.12, 0.03, -0.3]);

    fn assert_close(a: f64, b: f64, tolerance: f64) {
        assert!(
            (a - b).abs() <= tolerance * b.abs().max(1.0),
            "{a} is not {b} within {tolerance}"
        );
    }

    #[test]
    fn a_box_of_whole_cells_has_its_closed_form_moments() {
        let columns = box_columns([0.5, 0.25], [12, 16], [2.0, 7.0]);
        let everything = moments_where_positive(
            &columns,
            &Quadric([1.0, 0., 0., 0., 0., 0., 0., 0., 0., 0.]),
        );
        let mean = |a: f64, b: f64| (a + b) / 2.0;
        let square = |a: f64, b: f64| (b * b * b - a * a * a) / (3.0 * (b - a));
        let (x, y, z) = (mean(-3., 3.), mean(1., 5.), mean(2., 7.));
        let volume = 6.0 * 4.0 * 5.0;
        let expected = [
            1.0,
            x,
            y,
            z,
            x * y,
            y * z,
            x * z,
            square(-3., 3.),
            square(1., 5.),
            square(2., 7.),
        ]
        .map(|m| m * volume);
        for (got, want) in everything.0.iter().zip(expected) {
            assert_close(*got, want, 1e-13);
        }
    }

    #[test]
    fn the_voids_of_a_quadric_and_its_opposite_make_the_whole() {
        let columns = box_columns([0.3, 0.3], [20, 14], [-2.0, 3.0]);
        let opposite = Quadric(CROSSING.0.map(|c| -c));
        let both = moments_where_positive(&columns, &CROSSING)
            + moments_where_positive(&columns, &opposite);
        let whole = moments_where_positive(
            &columns,
            &Quadric([1.0, 0., 0., 0., 0., 0., 0., 0., 0., 0.]),
        );
        for (got, want) in both.0.iter().zip(whole.0) {
            assert_close(*got, want, 1e-12);
        }
    }

    #[test]
    fn the_moments_agree_with_a_sum_over_small_cells() {
        // Of 400 slices of 0.0125 mm, a column's error is at most two half slices of 0.25 mm². This
        // is 1e-3 of the volume if every error had the same sign, and a fiftieth of that with
        // random signs over 280 columns.
        let columns = box_columns([0.3, 0.3], [20, 14], [-2.0, 3.0]);
        let exact = moments_where_positive(&columns, &CROSSING);
        let (slices, mut volume, mut first) = (400, 0.0, 0.0);
        for &[x, y] in &columns.centers {
            for slice in 0..slices {
                let z = -2.0 + 5.0 * (slice as f64 + 0.5) / slices as f64;
                let mean = CROSSING.value(&Point::new(x, y, z))
                    + (CROSSING.0[7] + CROSSING.0[8]) * 0.3 * 0.3 / 12.0;
                if mean > 0.0 {
                    volume += 0.09 * 5.0 / slices as f64;
                    first += z * 0.09 * 5.0 / slices as f64;
                }
            }
        }
        assert_close(exact.0[0], volume, 5e-4);
        assert_close(exact.0[3], first, 2e-3);
    }

    #[test]
    fn the_derivative_agrees_with_finite_differences() {
        let columns = box_columns([0.3, 0.3], [20, 14], [-2.0, 3.0]);
        let (_, derivative) = moments_and_derivative(&columns, &CROSSING);
        for coefficient in 0..10 {
            // A step of 1e-6 moves roots by about 1e-6 mm, so no column changes its number of
            // roots. Central differences leave a relative error of 1e-12, below the rounding of
            // 1e-9.
            let step = 1e-6;
            let (mut more, mut less) = (CROSSING, CROSSING);
            more.0[coefficient] += step;
            less.0[coefficient] -= step;
            let change =
                moments_where_positive(&columns, &more) - moments_where_positive(&columns, &less);
            for row in 0..10 {
                assert_close(
                    derivative[(row, coefficient)],
                    change.0[row] / (2.0 * step),
                    2e-6,
                );
            }
        }
    }

    #[test]
    fn the_moments_without_the_derivative_are_the_same_bits() {
        let columns = box_columns([0.1, 0.1], [60, 60], [-2.0, 3.0]);
        assert_eq!(
            moments_where_positive(&columns, &CROSSING),
            moments_and_derivative(&columns, &CROSSING).0
        );
    }

    #[test]
    fn one_thread_and_three_give_the_same_bits() {
        let columns = box_columns([0.05, 0.05], [120, 80], [-2.0, 3.0]);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| moments_and_derivative(&columns, &CROSSING))
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn a_plane_through_the_columns_empties_one_side() {
        let columns = box_columns([0.5, 0.5], [4, 4], [0.0, 2.0]);
        for (slope, offset, emptied) in [
            (1.0, -0.5, 1.5),
            (-1.0, 0.5, 0.5),
            (0.0, 1.0, 2.0),
            (0.0, -1.0, 0.0),
        ] {
            for zero in [0.0, -0.0] {
                let plane = Quadric([offset, 0., 0., slope, 0., 0., 0., 0., 0., zero]);
                assert_close(
                    moments_where_positive(&columns, &plane).volume(),
                    4.0 * emptied,
                    1e-14,
                );
            }
        }
    }

    #[test]
    fn no_columns_have_no_moments() {
        assert_eq!(
            moments_where_positive(&Columns::default(), &CROSSING),
            Moments::default()
        );
    }
}
