//! The sparse least-squares system of one step of the flow, and its solution.
//!
//! The sum of |L x|² + c |x − t|² is least where (N² + c) x = N f + c t. There N is minus the
//! Laplacian L of the vertices that move, and f the pull of those that do not. With s² = c the
//! matrix is (N + i s)(N − i s), so x = −Im((N + i s)⁻¹ b) / s. One factor of a matrix with the
//! entries of L replaces many more entries of L².

use nalgebra::Complex;

use super::factor::{Factor, Lower, Triple};
use super::order::Graph;

/// A Laplacian by rows of weights, and the target of every vertex.
#[derive(Debug, Default)]
pub(super) struct System {
    /// The first entry of every row; one more than there are rows.
    pub starts: Vec<u32>,
    /// The column of every entry off the diagonal.
    pub columns: Vec<u32>,
    /// The weight of every entry, the same in both directions.
    pub weights: Vec<f64>,
    /// The target of every vertex.
    pub targets: Vec<[f64; 3]>,
    /// True for every vertex that does not move.
    pub is_fixed: Vec<bool>,
}

impl System {
    /// Moves the places to the solution, with the square root of c as the pull to the targets.
    pub fn solve(&self, places: &mut [[f64; 3]], pull: f64) {
        let graph = Graph {
            places,
            starts: &self.starts,
            columns: &self.columns,
        };
        let mut order = graph.order();
        order.retain(|v| !self.is_fixed[*v as usize]);
        let mut row_of = vec![None; places.len()];
        for (row, v) in order.iter().enumerate() {
            row_of[*v as usize] = Some(row as u32);
        }
        let factor = Factor::of(&self.matrix(&order, &row_of, pull));
        let mut sides = self.sides(&order, places, pull);
        factor.solve(&mut sides);
        for (v, solution) in order.iter().zip(sides) {
            places[*v as usize] = solution.map(|value| -value.im / pull);
        }
    }

    /// Returns the entries of a row: columns and weights.
    fn row(&self, row: u32) -> impl Iterator<Item = (usize, f64)> {
        let row = row as usize;
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        let columns = self.columns[range.clone()].iter().map(|c| *c as usize);
        columns.zip(self.weights[range].iter().copied())
    }

    /// Returns N + i s for the vertices that move, in the order of their elimination.
    fn matrix(&self, order: &[u32], row_of: &[Option<u32>], pull: f64) -> Lower {
        let mut matrix = Lower::default();
        for (row, v) in (0..).zip(order) {
            let earlier = self.row(*v).filter_map(|(column, weight)| {
                let column = row_of[column].filter(|column| *column < row)?;
                Some((column, -weight))
            });
            matrix.rows.push(earlier.collect());
            let own = self.row(*v).map(|(_, weight)| weight).sum();
            matrix.diagonal.push(Complex::new(own, pull));
        }
        matrix
    }

    /// Returns N f + c t for the vertices that move.
    fn sides(&self, order: &[u32], places: &[[f64; 3]], pull: f64) -> Vec<Triple> {
        let fixed = self.fixed_pulls(places);
        let side = |v: &u32| {
            let (here, target) = (fixed[*v as usize], self.targets[*v as usize]);
            let mut sum = target.map(|t| pull * pull * t);
            for (column, weight) in self.row(*v) {
                for axis in 0..3 {
                    sum[axis] += weight * (here[axis] - fixed[column][axis]);
                }
            }
            sum.map(Complex::from)
        };
        order.iter().map(side).collect()
    }

    /// Returns f: the weighted places of the neighbours that do not move, zero for those
    /// themselves.
    fn fixed_pulls(&self, places: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let pull = |v: usize| {
            let mut sum = [0.0; 3];
            let fixed = self
                .row(v as u32)
                .filter(|(column, _)| self.is_fixed[*column]);
            for (column, weight) in fixed.filter(|_| !self.is_fixed[v]) {
                (0..3).for_each(|axis| sum[axis] += weight * places[column][axis]);
            }
            sum
        };
        (0..places.len()).map(pull).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three vertices in a row with weights 1, the last one fixed.
    fn chain() -> System {
        System {
            starts: vec![0, 1, 3, 4],
            columns: vec![1, 0, 2, 1],
            weights: vec![1.0; 4],
            targets: vec![[1.0, 0.0, 2.0], [0.0; 3], [0.0; 3]],
            is_fixed: vec![false, false, true],
        }
    }

    #[test]
    fn the_solution_has_the_closed_form() {
        // N = (1 −1; −1 2), and N² + 1 = (3 −3; −3 6). The fixed vertex is at 0.
        // So x = (2/3, 1/3) for t = (1, 0).
        let mut places = vec![[0.3, 0.0, -7.0], [5.0, 0.0, 1.0], [0.0; 3]];
        chain().solve(&mut places, 1.0);
        for (place, expected) in places.iter().zip([2.0 / 3.0, 1.0 / 3.0, 0.0]) {
            assert!((place[0] - expected).abs() < 1e-12, "{places:?}");
            assert!((place[2] - 2.0 * expected).abs() < 1e-12);
            assert!(place[1].abs() < 1e-12);
        }
    }

    #[test]
    fn a_fixed_vertex_draws_the_others() {
        // All targets and the fixed vertex at one place: so is the solution.
        let at = [3.0, -2.0, 1.0];
        let system = System {
            targets: vec![at; 3],
            ..chain()
        };
        let mut places = vec![[0.0; 3], [1.0; 3], at];
        system.solve(&mut places, 0.1);
        let off = |place: &[f64; 3]| {
            (0..3)
                .map(|axis| (place[axis] - at[axis]).abs())
                .sum::<f64>()
        };
        assert!(places.iter().all(|place| off(place) < 1e-10), "{places:?}");
    }

    #[test]
    fn a_strong_pull_holds_the_targets() {
        let mut places = vec![[0.0; 3]; 3];
        chain().solve(&mut places, 1e3);
        assert!((places[0][0] - 1.0).abs() < 1e-5 && places[1][0].abs() < 1e-5);
    }
}
