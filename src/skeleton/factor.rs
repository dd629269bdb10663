//! The factors LDLᵀ of a sparse symmetric matrix of complex numbers.
//!
//! Davis, "Algorithm 849: a concise sparse Cholesky factorization package", ACM TOMS 31, 2005, row
//! by row along the elimination tree. It needs no pivots where the real and the imaginary
//! part are positive definite (Higham, Mathematics of Computation 67, 1998).

use nalgebra::Complex;

/// Three right-hand sides or solutions at once.
pub(super) type Triple = [Complex<f64>; 3];

/// The mark of a column without a parent in the elimination tree.
const NONE: u32 = u32::MAX;

/// The entries of a symmetric matrix up to its diagonal, row by row.
#[derive(Debug, Default)]
pub(super) struct Lower {
    /// The entries left of the diagonal of each row: column and value.
    pub rows: Vec<Vec<(u32, f64)>>,
    /// The diagonal.
    pub diagonal: Vec<Complex<f64>>,
}

/// The factors: L has ones on its diagonal, which are left out, and lies in columns.
pub(super) struct Factor {
    starts: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<Complex<f64>>,
    diagonal: Vec<Complex<f64>>,
}

impl Factor {
    /// Factorises a matrix.
    pub fn of(matrix: &Lower) -> Self {
        let (parents, counts) = eliminate(matrix);
        let starts = starts(&counts);
        let entries = starts[counts.len()];
        let mut work = Work {
            parents,
            ends: starts.clone(),
            column: vec![Complex::default(); counts.len()],
            seen: vec![NONE; counts.len()],
            factor: Self {
                starts,
                rows: vec![0; entries],
                values: vec![Complex::default(); entries],
                diagonal: matrix.diagonal.clone(),
            },
        };
        for row in 0..counts.len() {
            work.add_row(matrix, row);
        }
        work.factor
    }

    /// Puts the solution in the place of the right-hand sides.
    pub fn solve(&self, sides: &mut [Triple]) {
        for column in 0..sides.len() {
            let known = sides[column];
            for (row, value) in self.column(column) {
                (0..3).for_each(|axis| sides[row][axis] -= value * known[axis]);
            }
        }
        for (side, pivot) in sides.iter_mut().zip(&self.diagonal) {
            side.iter_mut().for_each(|value| *value /= pivot);
        }
        for column in (0..sides.len()).rev() {
            let mut sum = sides[column];
            for (row, value) in self.column(column) {
                (0..3).for_each(|axis| sum[axis] -= value * sides[row][axis]);
            }
            sides[column] = sum;
        }
    }

    fn column(&self, column: usize) -> impl Iterator<Item = (usize, Complex<f64>)> {
        let range = self.starts[column]..self.starts[column + 1];
        let rows = self.rows[range.clone()].iter().map(|row| *row as usize);
        rows.zip(self.values[range].iter().copied())
    }
}

/// The state of a factorisation.
struct Work {
    parents: Vec<u32>,
    /// The end of what is known of each column.
    ends: Vec<usize>,
    /// The row at hand, spread out.
    column: Vec<Complex<f64>>,
    /// The last row that met each column.
    seen: Vec<u32>,
    factor: Factor,
}

impl Work {
    /// Solves for a row of L and its pivot.
    fn add_row(&mut self, matrix: &Lower, row: usize) {
        for &(column, value) in &matrix.rows[row] {
            self.column[column as usize] += value;
        }
        for column in self.reach(matrix, row) {
            let value = std::mem::take(&mut self.column[column]);
            for at in self.factor.starts[column]..self.ends[column] {
                let below = self.factor.rows[at] as usize;
                self.column[below] -= self.factor.values[at] * value;
            }
            let entry = value / self.factor.diagonal[column];
            self.factor.diagonal[row] -= entry * value;
            let at = self.ends[column];
            (self.factor.rows[at], self.factor.values[at]) = (row as u32, entry);
            self.ends[column] += 1;
        }
    }

    /// Returns the columns with an entry in a row of L, each after those it needs.
    fn reach(&mut self, matrix: &Lower, row: usize) -> Vec<usize> {
        self.seen[row] = row as u32;
        let mut reach = Vec::new();
        for &(start, _) in &matrix.rows[row] {
            let mut path = Vec::new();
            let mut column = start as usize;
            while self.seen[column] != row as u32 {
                path.push(column);
                self.seen[column] = row as u32;
                column = self.parents[column] as usize;
            }
            reach.extend(path.into_iter().rev());
        }
        // Every path was turned so that its end, the latest, comes first.
        reach.reverse();
        reach
    }
}

/// Returns the elimination tree and the number of entries in every column of L.
fn eliminate(matrix: &Lower) -> (Vec<u32>, Vec<usize>) {
    let count = matrix.rows.len();
    let (mut parents, mut counts) = (vec![NONE; count], vec![0; count]);
    let mut seen = vec![NONE; count];
    for row in 0..count {
        seen[row] = row as u32;
        for &(column, _) in &matrix.rows[row] {
            let mut column = column as usize;
            while seen[column] != row as u32 {
                if parents[column] == NONE {
                    parents[column] = row as u32;
                }
                counts[column] += 1;
                seen[column] = row as u32;
                column = parents[column] as usize;
            }
        }
    }
    (parents, counts)
}

/// Returns where each column begins, and the end of the last.
fn starts(counts: &[usize]) -> Vec<usize> {
    let mut sum = 0;
    let ends = counts.iter().map(|count| {
        sum += count;
        sum
    });
    [0].into_iter().chain(ends.collect::<Vec<_>>()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(
        clippy::needless_range_loop,
        reason = "row and column are both indexes of the matrix"
    )]
    fn the_solution_fits_the_matrix() {
        // A ring of seven with a chord, diagonally dominant, with an imaginary part of 0.3.
        let count = 7;
        let mut dense = vec![vec![Complex::new(0.0, 0.0); count]; count];
        let mut lower = Lower::default();
        for row in 0..count {
            let mut entries: Vec<(u32, f64)> = Vec::new();
            if row > 0 {
                entries.push((row as u32 - 1, -1.0 - 0.1 * row as f64));
            }
            if row == count - 1 {
                entries.push((0, -0.7));
            }
            if row == 4 {
                entries.push((1, -0.4));
            }
            for (column, value) in &entries {
                dense[row][*column as usize] += value;
                dense[*column as usize][row] += value;
            }
            let pivot = Complex::new(5.0, 0.3);
            dense[row][row] = pivot;
            lower.rows.push(entries);
            lower.diagonal.push(pivot);
        }
        let known =
            |row: usize| [0, 1, 2].map(|axis| Complex::new(row as f64 - 2.0, (axis * row) as f64));
        let times = |row: &Vec<Complex<f64>>| {
            let mut sum = [Complex::default(); 3];
            for (column, value) in row.iter().enumerate() {
                (0..3).for_each(|axis| sum[axis] += value * known(column)[axis]);
            }
            sum
        };
        let mut sides: Vec<Triple> = dense.iter().map(times).collect();
        Factor::of(&lower).solve(&mut sides);
        for (row, side) in sides.iter().enumerate() {
            let error = (0..3).map(|axis| (side[axis] - known(row)[axis]).norm());
            assert!(error.fold(0.0, f64::max) < 1e-12, "{row}");
        }
    }
}
