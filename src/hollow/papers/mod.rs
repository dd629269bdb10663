//! The methods of the papers, as they have them: many numbers, one general optimiser.
//!
//! Each describes the void by numbers between 0 and 1 ([`Choice`]): the ends of a solid segment on
//! every ray ([`ByRays`]), a share of every voxel ([`ByVoxels`]), a share of every leaf of an
//! octree ([`ByOctree`]). All see the same columns as the quadric, so whatever they find is one of
//! the interiors that its bound speaks of, and the comparison is exact. They minimise the goal's
//! own formula f(s) subject to As = 0 by an augmented Lagrangian,
//!
//! ```text
//! minimise over 0 ≤ x ≤ 1:  f(s(x)) + λ·As(x) + ½ρ ‖As(x)‖²,    then λ ← λ + ρAs
//! ```
//!
//! each by projected L-BFGS with exact gradients. With g = ∇f + Aᵀ(λ + ρAs) the gradient by a
//! cell's share is −∫ over the cell of g·m: at the end it has one sign inside the quadric g and the
//! other outside of it. They look for the same surface, cell by cell.
//!
//! What they cannot do: prove that nothing is better or that nothing is possible; objectives
//! without a gradient, which is the toppling angle ([`super::MethodError::NotSmooth`]). The λ_max
//! of critical speed and dominance is smoothed.
//!
//! The files, in reading order: `target` f and A · `descent` L-BFGS between bounds · `lagrangian`
//! the constraints · `rays`, `voxels`, `octree` the three methods.
//!
//! Sources: Wu, Kramer, Westermann 2016; Bächer, Whiting, Bickel, Sorkine-Hornung 2014
//! ([`crate::hollow`]). Hestenes, "Multiplier and gradient methods", J. Optim. Theory Appl. 4,
//! 1969. Byrd, Lu, Nocedal, Zhu, "A limited memory algorithm for bound constrained optimization",
//! SIAM J. Sci. Comput. 16, 1995; Bertsekas, "Projected Newton methods for optimization problems
//! with simple constraints", SIAM J. Control Optim. 20, 1982.

#[cfg(test)]
mod conformance;
mod descent;
mod lagrangian;
mod octree;
mod rays;
mod target;
mod voxels;

pub use octree::ByOctree;
pub use rays::ByRays;
pub use voxels::ByVoxels;

use crate::hollow::method::{Found, Outcome, figure_for, value_of};
use crate::hollow::problem::Problem;
use crate::interior::Choice;
use lagrangian::Optimum;
use target::Target;

/// How exact the optimiser of the papers' methods shall be, and what it may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// The residual of the constraints at which it ends, in units of the solid's volume and radius
    /// of gyration.
    pub residual: f64,
    /// The slope at which it ends: the root mean square over the region of how far a step along the
    /// gradient moves, where the gradient is of order one. Much below 1e-5 the last fractional
    /// cells take most of the time.
    pub slope: f64,
    /// Evaluations of the moments and their derivative in all.
    pub evaluations: usize,
}

impl Default for Accuracy {
    fn default() -> Self {
        Self {
            residual: 1e-6,
            slope: 1e-4,
            evaluations: 20_000,
        }
    }
}

/// A residual above which the constraints count as missed.
const MISSED_RESIDUAL: f64 = 1e-3;

/// The answer of a method that needs no rounding.
fn found(problem: &Problem, target: &Target, choice: &dyn Choice, optimum: &Optimum) -> Found {
    let moments = problem.fixed - choice.moments(&optimum.x);
    let residual = target.residual(&moments);
    Found {
        outcome: outcome(optimum, residual),
        figure: figure_for(problem.goal.objective),
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
