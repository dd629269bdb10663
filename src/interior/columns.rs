//! The region that may be emptied as z-columns in the goal frame: a pitch in x and y, exact intervals in z.

/// Columns of the goal frame's z direction through the region that may be emptied.
///
/// Column `i` stands over the rectangle of `pitch_mm` centred at `centers[i]`, and may be emptied in the
/// intervals `intervals[starts[i] .. starts[i + 1]]`, ascending, disjoint, each of positive length. Columns
/// are ordered by y, then x, so that sums in this order do not depend on how they were made.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    /// The sides of a column's cross-section in x and y, mm.
    pub pitch_mm: [f64; 2],
    /// The centre (x, y) of each column, goal frame, mm.
    pub centers: Vec<[f64; 2]>,
    /// Where each column's intervals start; one more entry than columns.
    pub starts: Vec<u32>,
    /// The lower and upper ends of the intervals that may be emptied, goal frame, mm.
    pub intervals: Vec<[f64; 2]>,
}

impl Columns {
    /// How many columns there are.
    pub fn len(&self) -> usize {
        self.centers.len()
    }

    /// Whether nothing may be emptied.
    pub fn is_empty(&self) -> bool {
        self.centers.is_empty()
    }

    /// The intervals of column `index`.
    pub fn intervals_of(&self, index: usize) -> &[[f64; 2]] {
        &self.intervals[self.starts[index] as usize..self.starts[index + 1] as usize]
    }
}
