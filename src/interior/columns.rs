//! The region that may be emptied, as z-columns in the goal frame: a pitch in x and y, exact
//! intervals in z.

/// Columns along the goal frame's z direction through the region that may be emptied.
///
/// Column `i` stands over the rectangle of `pitch_mm` centred at `centers[i]`. It may be emptied in
/// the intervals `intervals[starts[i] .. starts[i + 1]]`: ascending, disjoint, each of positive
/// length. Columns are ordered by y, then x, so that sums in this order do not depend on how the
/// columns were made.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    /// Sides of a column's cross-section in x and y, mm.
    pub pitch_mm: [f64; 2],
    /// Centre (x, y) of each column, goal frame, mm.
    pub centers: Vec<[f64; 2]>,
    /// Index of each column's first interval; one more entry than columns.
    pub starts: Vec<u32>,
    /// Lower and upper ends of the intervals that may be emptied, goal frame, mm.
    pub intervals: Vec<[f64; 2]>,
}

impl Columns {
    /// Returns the number of columns.
    pub fn len(&self) -> usize {
        self.centers.len()
    }

    /// Returns whether nothing may be emptied.
    pub fn is_empty(&self) -> bool {
        self.centers.is_empty()
    }

    /// Returns every `step`-th column of every `step`-th row, each over a cell as large as those it
    /// represents.
    ///
    /// Sums over them are those of a midpoint rule `step` times as coarse, at about 1/step² of the
    /// cost. They are near enough to guide a search, but support no claim about these columns.
    pub fn thinned(&self, step: usize) -> Self {
        let Some(&[x0, y0]) = self.centers.first() else {
            return self.clone();
        };
        let is_taken = |offset_mm: f64, pitch_mm: f64| {
            ((offset_mm / pitch_mm).round() as i64).rem_euclid(step as i64) == step as i64 / 2
        };
        let (mut row, mut is_row_taken) = (f64::NAN, false);
        let mut thin = Self {
            pitch_mm: self.pitch_mm.map(|pitch| pitch * step as f64),
            ..Self::default()
        };
        thin.starts.push(0);
        for (index, &[x, y]) in self.centers.iter().enumerate() {
            if y != row {
                (row, is_row_taken) = (y, is_taken(y - y0, self.pitch_mm[1]));
            }
            if is_row_taken && is_taken(x - x0, self.pitch_mm[0]) {
                thin.centers.push([x, y]);
                thin.intervals.extend_from_slice(self.intervals_of(index));
                thin.starts.push(thin.intervals.len() as u32);
            }
        }
        thin
    }

    /// Returns the intervals of column `index`.
    pub fn intervals_of(&self, index: usize) -> &[[f64; 2]] {
        &self.intervals[self.starts[index] as usize..self.starts[index + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_third_column_of_a_box_of_whole_cells_gives_its_moments() {
        let mut columns = Columns {
            pitch_mm: [0.5, 0.25],
            starts: vec![0],
            ..Columns::default()
        };
        for (j, i) in (0..6).flat_map(|j| (0..9).map(move |i| (j, i))) {
            columns
                .centers
                .push([0.5 * f64::from(i) - 7.0, 0.25 * f64::from(j) + 3.0]);
            columns.intervals.extend([[-1.0, 1.0], [2.0, 5.0]]);
            columns.starts.push(columns.intervals.len() as u32);
        }
        let thin = columns.thinned(3);
        assert_eq!(
            (thin.len(), thin.intervals.len(), thin.pitch_mm),
            (6, 12, [1.5, 0.75])
        );
        // The middle column of each block of nine has the block's mean in x and y, and its larger
        // cell has their variance.
        let [all, few] = [columns.moments().0, thin.moments().0];
        for (all, few) in all.iter().zip(few) {
            assert!((few / all - 1.0).abs() < 1e-12, "{few} instead of {all}");
        }
    }

    #[test]
    fn no_columns_thin_to_no_columns() {
        let none = Columns {
            starts: vec![0],
            ..Columns::default()
        };
        assert_eq!(none.thinned(4), none);
    }
}
