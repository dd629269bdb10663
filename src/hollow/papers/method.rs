//! The trait of all methods that choose a void, for their comparison.

use crate::base::watch::Watch;
use crate::goal::{GoalKind, Objective};
use crate::hollow::{Figure, Problem};
use crate::interior::Emptied;
use crate::mass::Moments;

/// A method that chooses a void.
pub trait Method: Sync {
    /// Returns its name.
    fn name(&self) -> &'static str;

    /// Solves a problem. Cancelling `watch` ends it after the current step.
    fn find(&self, problem: &Problem, watch: &Watch) -> Result<Found, MethodError>;
}

/// The result of a method.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Reason it ended.
    pub outcome: Outcome,
    /// Quantity in `value`.
    pub figure: Figure,
    /// Figure of the chosen interior; NaN if it has none (an unstable top's critical speed).
    pub value: f64,
    /// Moments of the material that stays, goal frame, mm; exact for `emptied`.
    pub moments: Moments,
    /// Constraint residual, in units of the solid's volume and radius of gyration.
    pub residual: f64,
    /// Number of variables.
    pub variables: usize,
    /// Evaluations of the moments with their derivative; for the quadric, passes over the columns.
    pub iterations: usize,
    /// Emptied region, on the problem's columns.
    pub emptied: Emptied,
    /// Cost of rounding, if the method rounds.
    pub rounding: Option<Rounding>,
}

/// A result before its shares were rounded to 0 or 1; shares between cannot be printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounding {
    /// Figure with the unrounded shares.
    pub value_before: f64,
    /// Residual with the unrounded shares.
    pub residual_before: f64,
    /// Part of the region whose share was neither 0 nor 1, to a thousandth.
    pub fractional_ratio: f64,
}

/// The reason a method ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// Proved: no interior is better.
    Optimal,
    /// The constraints are met and the method has converged. No small change is better to first
    /// order within its tolerance, or thirty steps together gain less than 1e-8 of the value. It
    /// proves nothing about interiors further off.
    Converged,
    /// The evaluations were used up, or no step gained any more. The constraints are met to a
    /// thousandth.
    Unfinished,
    /// The constraint residual exceeds a thousandth. Only the quadric can prove that it must.
    ConstraintsMissed,
    /// Proved: no interior meets the goal.
    Impossible,
    /// The caller stopped the run.
    Cancelled,
}

/// The reason a method refused a problem.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MethodError {
    /// The method needs a gradient that the objective does not have.
    #[error(
        "{method} cannot optimise `{objective}`: the largest of several functions has no gradient \
         where two of them are equal, and the best lies there; use the quadric solver, or the \
         objective `lowest-center`"
    )]
    NotSmooth {
        /// Name of the method.
        method: &'static str,
        /// Requested objective.
        objective: Objective,
    },
    /// The interior is empty.
    #[error(
        "nothing may be emptied, so {method} has nothing to choose; make the model larger or the wall \
         thinner"
    )]
    NothingToEmpty {
        /// Name of the method.
        method: &'static str,
    },
    /// The method does not support the goal.
    #[error(
        "{method} supports tops, yo-yos and standing objects, but not the goal `{kind}`; use the quadric \
         solver"
    )]
    NotItsGoal {
        /// Name of the method.
        method: &'static str,
        /// Requested goal.
        kind: GoalKind,
    },
}
