//! The measured result of a method: moments, residual and figure of the interior it chose.

use super::lagrangian::Optimum;
use super::method::{Found, Outcome};
use super::target::Target;
use crate::goal::Objective;
use crate::hollow::{Figure, Problem};
use crate::interior::Choice;
use crate::mass::Moments;

/// Residual above which the constraints count as missed.
const MISSED_RESIDUAL: f64 = 1e-3;

/// Returns the result of an optimum, without rounding.
pub(super) fn measure(
    problem: &Problem,
    target: &Target,
    choice: &dyn Choice,
    optimum: &Optimum,
) -> Found {
    let moments = problem.fixed - choice.moments(&optimum.x);
    let residual = target.residual(&moments);
    Found {
        outcome: outcome(optimum, residual),
        figure: Figure::of(problem.goal.objective),
        value: value_of(problem, &moments),
        moments,
        residual,
        variables: choice.count(),
        iterations: optimum.evaluations,
        emptied: choice.emptied(&optimum.x),
        rounding: None,
    }
}

fn outcome(optimum: &Optimum, residual: f64) -> Outcome {
    match optimum {
        Optimum {
            is_cancelled: true, ..
        } => Outcome::Cancelled,
        _ if residual > MISSED_RESIDUAL => Outcome::ConstraintsMissed,
        Optimum {
            has_converged: true,
            ..
        } => Outcome::Converged,
        _ => Outcome::Unfinished,
    }
}

/// Returns the figure of a body with these moments, by the goal's own formulas.
///
/// NaN if it has none, or if the papers' methods refuse the goal.
pub(super) fn value_of(problem: &Problem, moments: &Moments) -> f64 {
    let figures = crate::goal::compute_figures(problem.goal, moments);
    let value = match problem.goal.objective {
        Objective::CriticalSpeed => figures.critical_speed_rpm,
        Objective::SpinIt { .. } => figures.spin_it,
        Objective::Dominance => Some(figures.dominance_ratio),
        Objective::TopplingAngle => figures.toppling_angle_rad,
        Objective::LowestCenter => Some(figures.center_height_mm),
        Objective::MetacentricHeight
        | Objective::LeastRemoved
        | Objective::LeastUnbalance
        | Objective::LeastChange => None,
    };
    value.unwrap_or(f64::NAN)
}
