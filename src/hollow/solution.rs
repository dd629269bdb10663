//! What the solver gives: the quadric, how far to trust it, and how it was found.

use serde::{Deserialize, Serialize};

use super::dual::programme::DualPoint;
use super::log::{LogRow, Pass};
use super::status::Status;
use crate::geom::Quadric;
use crate::goal::Objective;
use crate::mass::Moments;

/// The quantity a certificate speaks of; smaller is better but for the toppling angle, the
/// metacentric height and the volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Figure {
    /// Turns a minute of a top's least stable speed.
    CriticalSpeedRpm,
    /// Spin-It's functional, no unit.
    SpinIt,
    /// I_b/I_c, no unit.
    DominanceRatio,
    /// The tilt at which the object topples, rad.
    TopplingAngleRad,
    /// The height of the centre of mass, mm.
    CenterHeightMm,
    /// The height of the metacentre over the centre of mass, mm; more is better.
    MetacentricHeightMm,
    /// The material that stays, mm³; more is better.
    VolumeMm3,
    /// A lower bound of a rotor's balance grade at its speed, mm/s: exact where both end planes are
    /// equally unbalanced.
    BalanceGradeMmS,
}

/// What was reached, and the proof of how much better anything else could be.
///
/// Valid for the columns at hand: no choice of what to empty in them that meets the constraints is
/// better than `bound`. A top's bound is for its centre at the solution's height (and lever, where
/// that is weighed); `bound_over_heights` is for every height and lever.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// What is measured.
    pub figure: Figure,
    /// What the solution reaches; not a number where it has no such figure (an unstable top's
    /// critical speed).
    pub value: f64,
    /// What no interior can beat.
    pub bound: f64,
    /// The distance between the two as a part of the value of the programme that was solved.
    pub gap_ratio: f64,
    /// How far the constraints are from met, in units of the solid's volume and radius of gyration.
    pub residual: f64,
    /// Tops: what no interior can beat, whatever the height of its centre; a part of 1e-6 from the
    /// value or less. None where that was not proved in this run: refined solutions are not
    /// ([`bound_over_heights`](super::bound_over_heights) proves it for them), nor tops that no
    /// speed makes stable.
    pub bound_over_heights: Option<f64>,
}

impl Figure {
    /// The figure that measures how good an interior is for an objective.
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
        }
    }

    /// The value so that less is better.
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
    /// How far to trust it.
    pub status: Status,
    /// What was optimised: the goal's objective, or the one that had to replace it to be stable.
    pub objective: Objective,
    /// The void is where this is positive; goal frame, mm.
    pub quadric: Quadric,
    /// Value, bound, gap.
    pub certificate: Certificate,
    /// The moments with the void emptied, goal frame, mm.
    pub moments: Moments,
    /// The passes over all columns that were made; those over a few of them, to find out where to
    /// ask, are not counted.
    pub passes: usize,
    /// One row an ascent.
    pub log: Vec<LogRow>,
    /// The last ascent pass by pass, in the certificate's figure; passes without one, such as a
    /// top's that no speed holds up, are left out.
    pub course: Vec<Pass>,
    pub(super) warm: Warm,
}

impl Solution {
    /// Whether there is a void worth making.
    pub fn is_usable(&self) -> bool {
        matches!(self.status, Status::Solved | Status::AlmostSolved)
    }

    /// The solution of the same problem with all moments stretched by `factor`; where `is_turned`,
    /// its void is where the quadric was negative.
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

    /// The multipliers of the constraints in the solver's units, in the order of the table of rows
    /// in [`super`].
    pub fn multipliers(&self) -> Vec<f64> {
        self.warm.point.lambda.iter().copied().collect()
    }
}

/// What a later run on finer or corrected moments starts from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Warm {
    pub point: DualPoint,
    /// A top's height, in the solver's units, and how the slope of the objective grows with it.
    pub height: Option<Tangent>,
    /// A top's lever where Spin-It's functional weighs it.
    pub lever: Option<Tangent>,
}

/// Where a slope was last seen to vanish, and its derivative there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tangent {
    pub at: f64,
    pub curvature: f64,
}
