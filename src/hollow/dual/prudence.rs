//! The accuracy of a scout, and the part of its margins that is claimed of all columns.

/// Tolerance of ascents on thinned columns, whose own error is larger.
pub(crate) const ROUGH_TOLERANCE: f64 = 1e-3;
/// Tolerance of ascents on mended columns; the last Newton steps on all columns do the rest.
pub(crate) const MENDED_TOLERANCE: f64 = 1e-6;

/// The discount on a scout's margins before they are claimed of all columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Prudence {
    /// Share of a margin that is claimed where the columns are mended. With more, claims fail; with
    /// less, more posts are needed.
    near_ratio: f64,
}

impl Default for Prudence {
    fn default() -> Self {
        Self { near_ratio: 0.92 }
    }
}

impl Prudence {
    /// Returns the prudence after claims have failed.
    pub fn doubled(self) -> Self {
        Self {
            near_ratio: 2.0 * self.near_ratio - 1.0,
        }
    }

    /// Returns the part of a margin to claim. The margin grows with the square of the distance from
    /// where the columns are mended, the error with the distance.
    pub fn claim(self, margin: f64) -> f64 {
        self.near_ratio * margin / (1.0 + margin.max(0.0).sqrt())
    }
}
