//! How exact a scout is, and how much of what it sees is claimed of all columns.

/// How exact ascents on thinned columns are: those err by more.
pub(crate) const ROUGH_TOLERANCE: f64 = 1e-3;
/// How exact ascents on mended columns are: what is left is for the last Newton steps on all
/// columns.
pub(crate) const MENDED_TOLERANCE: f64 = 1e-6;

/// How much less than what a scout sees is claimed of all columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Prudence {
    /// The share of a margin that is claimed where the columns are mended. More, and claims fail;
    /// less, and more posts are needed.
    near_ratio: f64,
}

impl Default for Prudence {
    fn default() -> Self {
        Self { near_ratio: 0.92 }
    }
}

impl Prudence {
    /// The prudence after claims have failed.
    pub fn doubled(self) -> Self {
        Self {
            near_ratio: 2.0 * self.near_ratio - 1.0,
        }
    }

    /// What to claim of a margin. It grows with the square of the distance from where the columns
    /// are mended, and what they err by grows with the distance.
    pub fn claim(self, margin: f64) -> f64 {
        self.near_ratio * margin / (1.0 + margin.max(0.0).sqrt())
    }
}
