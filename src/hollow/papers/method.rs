//! One trait for every way to find what to empty, so that they can be compared: the quadric, and
//! the papers' own.

use crate::base::watch::Watch;
use crate::goal::{GoalKind, Objective};
use crate::hollow::{Figure, Problem};
use crate::interior::Emptied;
use crate::mass::Moments;

/// A way to find what to empty.
pub trait Method: Sync {
    /// A word for it.
    fn name(&self) -> &'static str;

    /// What it finds for a problem. Cancelling `watch` ends it after the step at hand.
    fn find(&self, problem: &Problem, watch: &Watch) -> Result<Found, MethodError>;
}

/// What a method found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// How far to trust it.
    pub outcome: Outcome,
    /// What `value` is.
    pub figure: Figure,
    /// The figure of the chosen interior; not a number where it has none (an unstable top's
    /// critical speed).
    pub value: f64,
    /// The moments of the material that is left, goal frame, mm; exact for what is emptied.
    pub moments: Moments,
    /// How far the constraints are from met, in units of the solid's volume and radius of gyration.
    pub residual: f64,
    /// How many numbers the method chose.
    pub variables: usize,
    /// How often it evaluated the moments with their derivative (the quadric: passes over the
    /// columns).
    pub iterations: usize,
    /// What is emptied, on the problem's columns.
    pub emptied: Emptied,
    /// What rounding cost, where the method rounds.
    pub rounding: Option<Rounding>,
}

/// An answer before its shares were rounded to 0 and 1, which cannot be printed in between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounding {
    /// The figure with the shares as they were.
    pub value_before: f64,
    /// The residual with them.
    pub residual_before: f64,
    /// The share of the region whose share was neither 0 nor 1, to a thousandth.
    pub fractional_ratio: f64,
}

/// How a method ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// No interior is better, which is proved.
    Optimal,
    /// The constraints are met, and no small change is better to first order, within the method's
    /// tolerance, or thirty steps together gain less than 1e-8 of the value. It proves nothing
    /// about interiors further off.
    Converged,
    /// The evaluations were used up, or no step gained any more, before that; the constraints are
    /// met to a thousandth.
    Unfinished,
    /// The constraints are missed by more than a thousandth. Only the quadric can prove that they
    /// must be.
    ConstraintsMissed,
    /// It is proved that no interior does what is asked for.
    Impossible,
    /// The caller stopped the run.
    Cancelled,
}

/// Why a method was not begun.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MethodError {
    /// The method needs a gradient that the objective does not have.
    #[error(
        "{method} cannot optimise `{objective}`: the largest of several functions has no gradient where two of them \
         are equal, which is where the best is found; use the quadric solver, or the objective `lowest-center`"
    )]
    NotSmooth {
        /// The method's word.
        method: &'static str,
        /// What was asked for.
        objective: Objective,
    },
    /// There is nothing to choose.
    #[error(
        "nothing may be emptied, so {method} has nothing to choose; make the model larger or the wall thinner"
    )]
    NothingToEmpty {
        /// The method's word.
        method: &'static str,
    },
    /// The method was not made for the goal.
    #[error(
        "{method} knows tops, yo-yos and what stands, but not the goal `{kind}`; use the quadric solver"
    )]
    NotItsGoal {
        /// The method's word.
        method: &'static str,
        /// What was asked for.
        kind: GoalKind,
    },
}
