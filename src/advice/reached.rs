//! The value that a goal reaches, as a number and in words.

use std::fmt;

use serde::Serialize;

use crate::base::units::{show_mm, show_mm3};
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
            Figure::SpinIt => write!(f, "spins, with Spin-It's functional at {value:.3}"),
            Figure::DominanceRatio => write!(f, "spins, with I_b/I_c at {value:.3}"),
            Figure::TopplingAngleRad => {
                write!(f, "stands and topples at {:.1}°", value.to_degrees())
            }
            Figure::CenterHeightMm => {
                write!(f, "stands, its centre of mass {} high", show_mm(value))
            }
            Figure::MetacentricHeightMm => {
                write!(
                    f,
                    "floats, its metacentre {} above its centre of mass",
                    show_mm(value)
                )
            }
            Figure::VolumeMm3 => write!(f, "runs true with {} of material", show_mm3(value)),
            Figure::BalanceGradeMmS => write!(f, "runs at grade G {value:.2}"),
        }
    }
}
