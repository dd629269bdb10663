//! The moments of all columns.

use rayon::prelude::*;

use super::columns::Columns;
use crate::mass::Moments;

/// Terms summed one after the other before blocks are added up. With blocks the result does not
/// depend on the number of threads. Their size keeps both sums short enough to lose no more than
/// about 1e-13.
pub(super) const BLOCK: usize = 4096;

/// Returns the sum of `count` terms, in blocks whose order does not depend on the number of
/// threads.
pub(super) fn block_sums(count: usize, term: impl Fn(usize) -> Moments + Sync) -> Moments {
    let sum = |first: usize| {
        let block = first..(first + BLOCK).min(count);
        block.fold(Moments::default(), |mut sum, i| {
            sum += term(i);
            sum
        })
    };
    let sums: Vec<Moments> = (0..count).into_par_iter().step_by(BLOCK).map(sum).collect();
    sums.into_iter()
        .fold(Moments::default(), |sum, block| sum + block)
}

impl Columns {
    /// Returns the moments of the region with every interval emptied, goal frame.
    ///
    /// Exact in z. In x and y each column stands for the box of its pitch, whose second moments are
    /// those of its centre plus pitch²/12. So the moments are exact for boxes along the axes. They
    /// have the same bits for any number of threads.
    pub fn moments(&self) -> Moments {
        let of_column = |column: usize| self.moments_of(column, self.intervals_of(column));
        block_sums(self.len(), of_column) * (self.pitch_mm[0] * self.pitch_mm[1])
    }

    /// Returns the moments of a stretch of a column, per unit of its cross-section.
    pub(super) fn moments_between(&self, column: usize, ends_mm: [f64; 2]) -> Moments {
        self.moments_of(column, &[ends_mm])
    }

    /// Returns the moments of stretches of a column, per unit of its cross-section.
    fn moments_of(&self, column: usize, stretches: &[[f64; 2]]) -> Moments {
        let [x, y] = self.centers[column];
        let [length, z, zz] = stretches.iter().map(powers_of_z).fold([0.0; 3], add);
        let xx = x * x + self.pitch_mm[0] * self.pitch_mm[0] / 12.0;
        let yy = y * y + self.pitch_mm[1] * self.pitch_mm[1] / 12.0;
        let x_y = [x * y * length, y * z, x * z];
        Moments([
            length,
            x * length,
            y * length,
            z,
            x_y[0],
            x_y[1],
            x_y[2],
            xx * length,
            yy * length,
            zz,
        ])
    }
}

/// Returns the integrals of 1, z and z² over an interval, computed about its middle so that nothing
/// cancels.
fn powers_of_z(&[bottom, top]: &[f64; 2]) -> [f64; 3] {
    let (length, middle) = (top - bottom, 0.5 * (bottom + top));
    [
        length,
        middle * length,
        length * (middle * middle + length * length / 12.0),
    ]
}

/// Returns the sum of two triples.
fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_that_tile_boxes_have_the_moments_of_the_boxes() {
        let (pitch, side) = (0.5, 6);
        let mut columns = Columns {
            pitch_mm: [pitch, pitch],
            starts: vec![0],
            ..Columns::default()
        };
        for cell in 0..side * side {
            let center = [
                1.0 + (f64::from(cell % side) + 0.5) * pitch,
                (f64::from(cell / side) + 0.5) * pitch,
            ];
            columns.centers.push(center);
            columns.intervals.extend([[-1.0, 1.0], [2.0, 5.0]]);
            columns.starts.push(columns.intervals.len() as u32);
        }
        // The boxes [1, 4] × [0, 3] × ([-1, 1] ∪ [2, 5]); each moment is a product of
        // one-dimensional integrals.
        let (x, y, z) = (
            [3.0, 7.5, 21.0],
            [3.0, 4.5, 9.0],
            [5.0, 10.5, 2.0 / 3.0 + 39.0],
        );
        let exact = [
            x[0] * y[0] * z[0],
            x[1] * y[0] * z[0],
            x[0] * y[1] * z[0],
            x[0] * y[0] * z[1],
            x[1] * y[1] * z[0],
            x[0] * y[1] * z[1],
            x[1] * y[0] * z[1],
            x[2] * y[0] * z[0],
            x[0] * y[2] * z[0],
            x[0] * y[0] * z[2],
        ];
        for (moment, exact) in columns.moments().0.into_iter().zip(exact) {
            assert!(
                (moment - exact).abs() < 1e-12 * exact,
                "{moment} instead of {exact}"
            );
        }
    }
}
