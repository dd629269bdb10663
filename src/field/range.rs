//! The least and the greatest density that may be printed.

use std::fmt;

/// Two densities, 0 ≤ low < high ≤ 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DensityRange {
    low: f64,
    high: f64,
}

/// A reason why two numbers are no range of densities.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RangeError {
    /// One of them is not from 0 to 1.
    #[error("{0} is no density; remedy: give a share from 0 to 1, or from 0% to 100%")]
    Outside(f64),
    /// The first is not below the second.
    #[error("{0} is not below {1}; remedy: give the lesser density first, such as {1}..{0}")]
    Order(f64, f64),
}

impl DensityRange {
    /// From air to solid print.
    pub const FULL: Self = Self {
        low: 0.0,
        high: 1.0,
    };

    /// Returns the range from `low` to `high`.
    ///
    /// # Errors
    /// A number is not from 0 to 1, or the first is not below the second.
    pub fn new(low: f64, high: f64) -> Result<Self, RangeError> {
        for density in [low, high] {
            if !(0.0..=1.0).contains(&density) {
                return Err(RangeError::Outside(density));
            }
        }
        if low < high {
            Ok(Self { low, high })
        } else {
            Err(RangeError::Order(low, high))
        }
    }

    /// Returns the least density.
    pub fn low(&self) -> f64 {
        self.low
    }

    /// Returns the greatest density.
    pub fn high(&self) -> f64 {
        self.high
    }

    /// Returns the difference of the two.
    pub fn span(&self) -> f64 {
        self.high - self.low
    }
}

impl fmt::Display for DensityRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.low, self.high)
    }
}
