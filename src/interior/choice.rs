//! The interface of a void that is described by finitely many numbers, as in the papers' methods.

use super::emptied::Emptied;
use crate::geom::Quadric;
use crate::mass::Moments;

/// A description of a void by numbers x between 0 and 1: voxels, the leaves of an octree, the ends
/// of rays.
///
/// Every number has a weight: the share of the region that it controls. Derivatives are per weight,
/// so that the numbers of large and small cells have the same scale. The derivative of ∫q by a
/// cell's share is then the mean of q over the cell, times the region's volume, at any resolution.
pub trait Choice: Sync {
    /// Returns the number of numbers.
    fn count(&self) -> usize {
        self.weights().len()
    }

    /// Returns the share of the region that each number controls; positive.
    fn weights(&self) -> &[f64];

    /// Returns the numbers with which nothing is emptied.
    fn nothing(&self) -> Vec<f64>;

    /// Returns the moments of the void, goal frame, mm. They are exact for the columns on which the
    /// choice was built, with the same bits for any number of threads.
    fn moments(&self, x: &[f64]) -> Moments;

    /// Writes the derivative of q's integral over the void with respect to each number, over its
    /// weight; mm³ if q has no unit.
    fn derivative(&self, x: &[f64], quadric: &Quadric, out: &mut [f64]);

    /// Returns the void, on the columns on which the choice was built.
    fn emptied(&self, x: &[f64]) -> Emptied;

    /// Returns the pairs of numbers that a smoothing term may couple; empty if neighbours have no
    /// meaning.
    fn neighbours(&self) -> &[[u32; 2]] {
        &[]
    }
}

/// Checks shared by the tests of every choice.
#[cfg(test)]
pub(super) mod testing {
    use super::*;
    use crate::interior::Columns;

    /// Returns columns of 1 mm with one or two intervals of uneven ends.
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

    /// Returns a quadric without symmetry that cuts the columns.
    pub fn some_quadric() -> Quadric {
        Quadric([-1.0, 0.3, -0.2, 0.5, 0.1, -0.15, 0.07, 0.12, 0.2, 0.31])
    }

    /// Returns numbers between 0.1 and 0.9 in no order.
    pub fn some_numbers(count: usize) -> Vec<f64> {
        (0..count)
            .map(|i| 0.5 + 0.4 * ((7 * i + 3) as f64).sin())
            .collect()
    }

    /// Checks a choice's moments against those of its pieces, and its derivative against
    /// differences.
    pub fn check_choice(choice: &dyn Choice, columns: &Columns) {
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
            // Moments are at most cubic in a number, so the difference is exact up to step² and up
            // to rounding over step.
            let difference = (moved(step) - moved(-step)) / (2.0 * step);
            assert!(
                (slope[i] * choice.weights()[i] - difference).abs() < 1e-6,
                "{i}: {} {difference}",
                slope[i]
            );
        }
    }
}
