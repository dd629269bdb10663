//! The result of a run: the quadric, its certificate, and the record of the search.

use serde::{Deserialize, Serialize};

use super::dual::programme::DualPoint;
use super::goals::kept::Kept;
use super::log::{LogRow, Pass};
use super::status::Status;
use crate::geom::Quadric;
use crate::goal::Objective;
use crate::mass::Moments;

/// The quantity a certificate measures.
///
/// Smaller is better, except for the toppling angle, the metacentric height and the volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Figure {
    /// Least stable speed of a top, rpm.
    CriticalSpeedRpm,
    /// Spin-It's functional, no unit.
    SpinIt,
    /// I_b/I_c, no unit.
    DominanceRatio,
    /// Tilt at which the object topples, rad.
    TopplingAngleRad,
    /// Height of the centre of mass, mm.
    CenterHeightMm,
    /// Height of the metacentre above the centre of mass, mm; more is better.
    MetacentricHeightMm,
    /// Volume of the material that stays, mm³; more is better.
    VolumeMm3,
    /// Lower bound of a rotor's balance grade at its speed, mm/s; exact if both end planes are
    /// equally unbalanced.
    BalanceGradeMmS,
    /// Root mean square of the change of a wished infill, as a share of solid print.
    InfillChange,
}

/// The value that was reached, and a proven bound on anything better.
///
/// Valid for the given columns: no choice of what to empty in them that meets the constraints is
/// better than `bound`. A top's `bound` holds for the height of the solution's centre, and for its
/// lever if that is weighed. Its `bound_over_heights` holds for every height and lever.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Measured quantity.
    pub figure: Figure,
    /// Value of the solution; NaN if it has no such figure (an unstable top's critical speed).
    pub value: f64,
    /// Value that no interior can beat.
    pub bound: f64,
    /// Distance between the two, as a part of the value of the programme that was solved.
    pub gap_ratio: f64,
    /// Constraint residual, in units of the solid's volume and radius of gyration.
    pub residual: f64,
    /// Tops: value that no interior can beat, whatever the height of its centre; within 1e-6 of the
    /// value, relative.
    ///
    /// `None` if this was not proved in this run. It is not for refined solutions
    /// ([`bound_over_heights`](super::bound_over_heights) proves it for them), nor for tops that no
    /// speed makes stable.
    pub bound_over_heights: Option<f64>,
}

impl Figure {
    /// Returns the figure that measures an interior for an objective.
    pub(super) fn of(objective: Objective) -> Self {
        match objective {
            Objective::CriticalSpeed => Self::CriticalSpeedRpm,
            Objective::SpinIt { .. } => Self::SpinIt,
            Objective::Dominance => Self::DominanceRatio,
            Objective::TopplingAngle => Self::TopplingAngleRad,
            Objective::LowestCenter => Self::CenterHeightMm,
            Objective::MetacentricHeight => Self::MetacentricHeightMm,
            Objective::LeastRemoved => Self::VolumeMm3,
            Objective::LeastUnbalance => Self::BalanceGradeMmS,
            Objective::LeastChange => Self::InfillChange,
        }
    }

    /// Returns the value with its sign chosen so that less is better.
    pub fn cost(self, value: f64) -> f64 {
        match self {
            Self::TopplingAngleRad | Self::MetacentricHeightMm | Self::VolumeMm3 => -value,
            _ => value,
        }
    }
}

/// The optimal void and its proof.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Outcome of the run.
    pub status: Status,
    /// Optimised objective: the goal's, or the one that had to replace it for a stable result.
    pub objective: Objective,
    /// Quadric that is positive in the void; goal frame, mm.
    pub quadric: Quadric,
    /// Value, bound and gap.
    pub certificate: Certificate,
    /// Moments with the void emptied, goal frame, mm.
    pub moments: Moments,
    /// Passes over all columns; passes over a sample of them are not counted.
    pub passes: usize,
    /// One row per ascent.
    pub log: Vec<LogRow>,
    /// The last ascent pass by pass, in the certificate's figure. Passes without a finite figure
    /// are left out, such as those of a top that no speed makes stable.
    pub course: Vec<Pass>,
    pub(super) warm: Warm,
}

impl Solution {
    /// Returns true if there is a void worth making.
    pub fn is_usable(&self) -> bool {
        matches!(self.status, Status::Solved | Status::AlmostSolved)
    }

    /// Returns the solution of the same problem with all moments multiplied by `factor`. If
    /// `is_turned`, the void moves to the other side of the quadric.
    pub(super) fn stretched(self, factor: f64, is_turned: bool) -> Self {
        let Certificate {
            figure,
            value,
            bound,
            ..
        } = self.certificate;
        let stretch = if figure == Figure::VolumeMm3 {
            factor
        } else {
            1.0
        };
        let turned = Quadric(self.quadric.0.map(|coefficient| -coefficient));
        Self {
            moments: self.moments * factor,
            quadric: if is_turned { turned } else { self.quadric },
            certificate: Certificate {
                value: value * stretch,
                bound: bound * stretch,
                ..self.certificate
            },
            course: self
                .course
                .iter()
                .map(|pass| pass.map(|number| number * stretch))
                .collect(),
            ..self
        }
    }

    /// Returns the multipliers of the constraints in the solver's units, in the order of the table
    /// of rows in [`super`].
    pub fn multipliers(&self) -> Vec<f64> {
        self.warm.point.lambda.iter().copied().collect()
    }
}

/// The start of a later run on finer columns or corrected moments.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Warm {
    pub point: DualPoint,
    /// A top's height, in the solver's units, and the derivative of the objective's slope there.
    pub height: Option<Tangent>,
    /// A top's lever, if Spin-It's functional weighs it.
    pub lever: Option<Tangent>,
    /// The figure that a print near a wished infill keeps.
    pub kept: Option<Kept>,
}

/// The last known zero of a slope, and the slope's derivative there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tangent {
    pub at: f64,
    pub curvature: f64,
}
