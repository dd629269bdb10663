//! The value that a goal reaches, as a number and in words.

use std::fmt;

use serde::Serialize;

use crate::base::units::{show_mm3, show_wobble};
use crate::hollow::{Certificate, Figure};

/// The best value of a figure, on the columns of one trial.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Reached {
    /// The figure.
    pub figure: Figure,
    /// Its value; an angle in rad.
    pub value: f64,
}

impl Reached {
    /// Returns the value that a certificate proves.
    pub(super) fn of(certificate: &Certificate) -> Self {
        Self {
            figure: certificate.figure,
            value: certificate.value,
        }
    }

    /// Returns the value, signed so that less is better.
    pub(super) fn score(&self) -> f64 {
        self.figure.cost(self.value)
    }
}

/// Writes the end of a sentence that begins with "it".
impl fmt::Display for Reached {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.value;
        match self.figure {
            Figure::CriticalSpeedRpm => write!(f, "spins upright from {value:.0} rpm"),
            Figure::SpinIt => {
                write!(
                    f,
                    "spins steadily (Spin-It ratio {value:.2}; less is steadier)"
                )
            }
            Figure::DominanceRatio => write!(f, "spins steadily: {}", show_wobble(value)),
            Figure::TopplingAngleRad => {
                write!(f, "stands until tilted by {:.1}°", value.to_degrees())
            }
            Figure::CenterHeightMm => {
                write!(f, "stands, its centre of mass {value:.1} mm high")
            }
            Figure::MetacentricHeightMm => {
                write!(f, "floats upright (metacentric height {value:.1} mm)")
            }
            Figure::VolumeMm3 => write!(f, "runs true with {} of material", show_mm3(value)),
            Figure::BalanceGradeMmS => write!(f, "runs at grade G {value:.2}"),
            Figure::InfillChange => write!(f, "differs from the wished infill by {value:.3}"),
        }
    }
}
