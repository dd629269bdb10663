//! A choice of what to empty that is described by finitely many numbers, as the papers' methods
//! have it.

use super::Emptied;
use crate::geom::Quadric;
use crate::mass::Moments;

/// A way to describe what is emptied by numbers x between 0 and 1: voxels, the leaves of an octree,
/// the ends of rays.
///
/// Every number has a weight, the share of the region it decides about. Derivatives are per weight,
/// so that a number of a large cell and one of a small cell are measured alike: the derivative of
/// ∫q by the share of a cell is then the mean of q over it, times the region's volume, whatever the
/// resolution.
pub trait Choice: Sync {
    /// How many numbers there are.
    fn count(&self) -> usize {
        self.weights().len()
    }

    /// The share of the region each number decides about; positive.
    fn weights(&self) -> &[f64];

    /// The numbers with which nothing is emptied.
    fn nothing(&self) -> Vec<f64>;

    /// The moments of what is emptied, goal frame, mm; exact for the columns the choice was made
    /// of, and the same bits for any number of threads.
    fn moments(&self, x: &[f64]) -> Moments;

    /// The derivative of q's integral over what is emptied by each number, over its weight, mm³
    /// where q has no unit.
    fn derivative(&self, x: &[f64], quadric: &Quadric, out: &mut [f64]);

    /// What is emptied, on the columns the choice was made of.
    fn emptied(&self, x: &[f64]) -> Emptied;

    /// The pairs of numbers that a smoothing may tie together; none where neighbours mean nothing.
    fn neighbours(&self) -> &[[u32; 2]] {
        &[]
    }
}

/// Checks shared by the tests of every choice.
#[cfg(test)]
pub(super) mod testing {
    use super::*;
    use crate::interior::Columns;

    /// Columns of 1 mm with one or two intervals of uneven ends.
    pub fn uneven_columns() -> Columns {
        let mut columns = Columns {
            pitch_mm: [1.0, 1.0],
            starts: vec![0],
            ..Columns::default()
        };
        for cell in 0..35 {
            let (x, y) = (f64::from(cell % 7) - 3.0, f64::from(cell / 7) - 2.0);
            columns.centers.push([x, y]);
            columns.intervals.push([-3.0 + 0.11 * x * x, 0.3 * y]);
            if cell % 3 == 0 {
                columns.intervals.push([1.2 + 0.1 * y, 4.0 - 0.21 * x]);
            }
            columns.starts.push(columns.intervals.len() as u32);
        }
        columns
    }

    /// A quadric without symmetry that cuts the columns.
    pub fn some_quadric() -> Quadric {
        Quadric([-1.0, 0.3, -0.2, 0.5, 0.1, -0.15, 0.07, 0.12, 0.2, 0.31])
    }

    /// Numbers between 0.1 and 0.9 without order.
    pub fn some_numbers(count: usize) -> Vec<f64> {
        (0..count)
            .map(|i| 0.5 + 0.4 * ((7 * i + 3) as f64).sin())
            .collect()
    }

    /// Holds a choice against its own description as pieces, and its derivative against
    /// differences.
    pub fn holds_together(choice: &dyn Choice, columns: &Columns) {
        let x = some_numbers(choice.count());
        let (moments, drawn) = (choice.moments(&x), choice.emptied(&x).moments(columns));
        for (got, want) in moments.0.iter().zip(drawn.0) {
            assert!((got - want).abs() < 1e-11 * drawn.0.iter().map(|s| s.abs()).sum::<f64>());
        }
        assert!(
            choice
                .moments(&choice.nothing())
                .0
                .iter()
                .all(|s| s.abs() < 1e-9)
        );
        let total = |x: &[f64]| {
            some_quadric()
                .0
                .iter()
                .zip(choice.moments(x).0)
                .map(|(q, s)| q * s)
                .sum::<f64>()
        };
        let mut slope = vec![0.0; x.len()];
        choice.derivative(&x, &some_quadric(), &mut slope);
        let step = 1e-5;
        for i in (0..x.len()).step_by(5) {
            let moved = |by: f64| {
                let mut moved = x.clone();
                moved[i] += by;
                total(&moved)
            };
            // Moments are at most cubic in a number: the difference is exact to step² and to
            // rounding over step.
            let difference = (moved(step) - moved(-step)) / (2.0 * step);
            assert!(
                (slope[i] * choice.weights()[i] - difference).abs() < 1e-6,
                "{i}: {} {difference}",
                slope[i]
            );
        }
    }
}
