//! The conversion of a search's result into a solution in mm, with status and certificate.

use super::ascent::{Climb, End};
use super::units::Vector10;
use super::units::index;
use super::work::Work;
use crate::base::units::STANDARD_GRAVITY_MM_S2;
use crate::goal::{GoalKind, Objective, Spindle, to_rpm};
use crate::hollow::log::Pass;
use crate::hollow::solution::{Certificate, Figure, Solution, Tangent, Warm};
use crate::hollow::status::{Obstacle, Status};

/// Share of the separating multipliers beyond which one kind of constraint is the sole obstacle.
const SOLE_OBSTACLE_RATIO: f64 = 0.95;
/// Residual up to which an unfinished answer is usable: a thousandth of the solid's radius of
/// gyration.
const USABLE_RESIDUAL: f64 = 1e-3;
/// Gap up to which an unfinished answer is usable.
const USABLE_GAP_RATIO: f64 = 1e-2;

/// The result of a search, in the solver's units.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    /// Objective minimised in the end.
    pub objective: Objective,
    /// Ascent that gave the result.
    pub climb: Climb,
    /// Proof that the goal cannot be met, if there is one.
    pub verdict: Option<Status>,
    /// A top's height, and the derivative of the slope there.
    pub height: Option<Tangent>,
    /// A top's lever, if it is weighed.
    pub lever: Option<Tangent>,
    /// Lower bound of the ratio over all heights.
    pub bound_over_heights: Option<f64>,
}

impl Answer {
    pub fn new(objective: Objective, climb: Climb) -> Self {
        Self {
            objective,
            climb,
            verdict: None,
            height: None,
            lever: None,
            bound_over_heights: None,
        }
    }

    pub fn with_verdict(self, verdict: Status) -> Self {
        Self {
            verdict: Some(verdict),
            ..self
        }
    }

    /// Converts the result to mm.
    pub fn into_solution(self, work: Work) -> Solution {
        let scale = work.reach.scale;
        let best = &self.climb.best;
        let certificate = self.certificate(&work);
        Solution {
            status: self.status(&work),
            objective: self.objective,
            quadric: scale.quadric_to_mm(&(best.quadric * scale.volume_mm3)),
            course: self.course(&work, certificate.figure),
            certificate,
            moments: scale.moments_to_mm(&best.extreme.s),
            passes: work.reach.passes(),
            warm: Warm {
                point: best.point.clone(),
                height: self.height,
                lever: self.lever,
                kept: None,
            },
            log: work.into_log(),
        }
    }

    fn status(&self, work: &Work) -> Status {
        let (gap_ratio, residual) = (self.climb.best.gap_ratio(), self.climb.best.residual());
        match (self.verdict, self.climb.end) {
            (Some(verdict), _) => verdict,
            (None, End::Infeasible(least_miss)) => infeasible(work, &self.climb, least_miss),
            (None, End::Cancelled) => Status::Cancelled,
            (None, _) if work.accepts(&self.climb) => Status::Solved,
            (None, _) if residual <= USABLE_RESIDUAL && gap_ratio.abs() <= USABLE_GAP_RATIO => {
                Status::AlmostSolved
            }
            (None, _) => Status::IterationLimit {
                gap_ratio,
                residual,
            },
        }
    }

    fn certificate(&self, work: &Work) -> Certificate {
        let figure = figure_of(self.objective, self.verdict);
        let best = &self.climb.best;
        let impossible = matches!(self.climb.end, End::Infeasible(_));
        let in_figure = |ratio| {
            if impossible {
                f64::NAN
            } else {
                self.in_figure(work, figure, ratio)
            }
        };
        Certificate {
            figure,
            value: in_figure(best.value),
            bound: in_figure(best.bound),
            gap_ratio: best.gap_ratio(),
            residual: best.residual(),
            bound_over_heights: self.bound_over_heights.map(in_figure),
        }
    }

    /// Returns the passes of the ascent, converted to a figure.
    pub fn course(&self, work: &Work, figure: Figure) -> Vec<Pass> {
        let passes = self
            .climb
            .course
            .iter()
            .map(|pass| pass.map(|ratio| self.in_figure(work, figure, ratio)));
        passes.filter(Pass::is_finite).collect()
    }

    /// Converts a ratio of the programme to a figure.
    pub fn in_figure(&self, work: &Work, figure: Figure, ratio: f64) -> f64 {
        let conversion = Conversion {
            work,
            objective: self.objective,
            figure,
        };
        conversion.figure_of(&self.climb.best.extreme.s, ratio)
    }
}

/// The conversion of a programme's ratio to the figure that people know.
pub(crate) struct Conversion<'a, 'b> {
    pub work: &'a Work<'b>,
    pub objective: Objective,
    pub figure: Figure,
}

impl Conversion<'_, '_> {
    /// Returns the figure of an interior with these moments and this ratio. It is monotone in the
    /// ratio, so a bound stays a bound.
    pub fn figure_of(&self, s: &Vector10, ratio: f64) -> f64 {
        let work = self.work;
        match self.figure {
            Figure::CriticalSpeedRpm => {
                to_rpm((STANDARD_GRAVITY_MM_S2 / -work.to_mm(ratio)).sqrt())
            }
            Figure::SpinIt => functional(work, self.objective, s, ratio),
            Figure::DominanceRatio | Figure::InfillChange => ratio,
            Figure::TopplingAngleRad => -ratio.atan(),
            Figure::CenterHeightMm => work.to_mm(ratio),
            Figure::MetacentricHeightMm => {
                work.goal.afloat.unwrap_or_default().metacenter_mm - work.to_mm(ratio)
            }
            Figure::VolumeMm3 => -ratio * work.reach.scale.volume_mm3,
            Figure::BalanceGradeMmS => {
                let grade = |spindle: &Spindle| grade_mm_s(spindle, work.to_mm(ratio));
                work.goal.spindle.as_ref().map_or(f64::NAN, grade)
            }
        }
    }
}

/// Returns Spin-It's functional of an interior with these moments and this inertia ratio.
pub(crate) fn functional(work: &Work, objective: Objective, s: &Vector10, ratio: f64) -> f64 {
    let Objective::SpinIt { gamma_c, gamma_i } = objective else {
        return ratio * ratio;
    };
    if gamma_c == 0.0 || work.goal.kind != GoalKind::Top {
        return gamma_i * ratio * ratio;
    }
    let lever = s[index::Z] / work.reach.scale.moments_to_units(&work.goal.solid)[index::Z];
    gamma_c * lever * lever + gamma_i * ratio * ratio
}

/// Returns the least balance grade, mm/s, of a rotor with the unbalance ratio ‖(U_A, U_B)‖/M, mm.
///
/// The grade is twice the larger of the two planes' unbalances per mass, times ω. The larger of two
/// vectors is at least their joint length over √2.
pub(crate) fn grade_mm_s(spindle: &Spindle, ratio_mm: f64) -> f64 {
    std::f64::consts::SQRT_2 * ratio_mm * spindle.rotor.omega_rad_s()
}

fn figure_of(objective: Objective, verdict: Option<Status>) -> Figure {
    match verdict {
        Some(Status::UnstableForEveryInterior { .. } | Status::NotDominant { .. }) => {
            Figure::DominanceRatio
        }
        _ => Figure::of(objective),
    }
}

fn infeasible(work: &Work, climb: &Climb, least_miss: f64) -> Status {
    let separator = work.reach.scale.quadric_to_mm(&climb.best.quadric);
    Status::ConstraintsInfeasible {
        obstacle: obstacle(&climb.best.quadric),
        least_miss,
        separator,
    }
}

/// Returns the constraints that make up the separating quadric.
fn obstacle(separator: &Vector10) -> Obstacle {
    let squared = |moments: &[usize]| {
        moments
            .iter()
            .map(|&i| separator[i] * separator[i])
            .sum::<f64>()
    };
    let center = squared(&[index::X, index::Y, index::Z]);
    let axis = squared(&[index::XZ, index::YZ]);
    let share = center / (center + axis);
    if share > SOLE_OBSTACLE_RATIO {
        Obstacle::Center
    } else if share < 1.0 - SOLE_OBSTACLE_RATIO {
        Obstacle::PrincipalAxis
    } else {
        Obstacle::Both
    }
}
