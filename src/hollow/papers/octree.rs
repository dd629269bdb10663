//! Spin-It's method: a share of every leaf of an octree, refined where it is fractional, then
//! rounded.

use super::lagrangian::{Accuracy, Effort, Optimum, Start, minimise};
use super::measure::{measure, value_of};
use super::method::{Found, Method, MethodError, Rounding};
use super::target::Target;
use crate::base::watch::Watch;
use crate::hollow::Problem;
use crate::interior::{Choice, Levels, Octree};

/// The octree of Spin-It §5 ([`Octree`]), with the fill of every leaf between 0 and 1.
///
/// A uniform Laplacian keeps the fill smooth. After each solution fractional leaves split, and
/// siblings that agree merge. This ends when all fractional leaves are of the finest level, one
/// column wide. Then every share is rounded to 0 or 1, which violates the constraints again:
/// [`Found::rounding`] and [`Found::residual`] say by how much.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ByOctree {
    /// Accuracy and cost limits; each round of splitting has these evaluations.
    pub accuracy: Accuracy,
    /// First levels of the octree.
    pub levels: Levels,
    /// Weight of the Laplacian, the mean of ½(βᵢ − βⱼ)² over neighbouring leaves, beside f. Above
    /// 1e-3 it shapes the void. At 0, leaves that the void's surface barely touches are split for
    /// nothing.
    pub smoothing: f64,
}

impl Default for ByOctree {
    fn default() -> Self {
        let accuracy = Accuracy {
            evaluations: EVALUATIONS_A_ROUND,
            ..Accuracy::default()
        };
        Self {
            accuracy,
            levels: Levels {
                inner: 5,
                boundary: 6,
            },
            smoothing: 1e-5,
        }
    }
}

/// Evaluation limit of one round. Most need a few hundred; a round that does not converge only
/// delays the next splitting.
const EVALUATIONS_A_ROUND: usize = 4000;
/// Distance from 0 or 1 within which a share is not fractional.
const FRACTION_TOLERANCE: f64 = 1e-3;
/// Limit on the splittings per level; merged siblings may have to be split again.
const SPLITTINGS_A_LEVEL: u32 = 2;

impl Method for ByOctree {
    fn name(&self) -> &'static str {
        "octree"
    }

    fn find(&self, problem: &Problem, watch: &Watch) -> Result<Found, MethodError> {
        let effort = Effort {
            accuracy: &self.accuracy,
            watch,
        };
        let target = Target::new(self.name(), problem)?;
        let mut octree = Octree::of(problem.columns, self.levels);
        let mut start = Start {
            smoothing: self.smoothing,
            ..Start::from(octree.nothing())
        };
        let mut evaluations = 0;
        for _ in 0..SPLITTINGS_A_LEVEL * octree.finest_level() {
            let optimum = minimise(&target, &octree, start, effort);
            evaluations += optimum.evaluations;
            let refined = octree.refine(&optimum.x, FRACTION_TOLERANCE);
            let Some((finer, x)) = refined.filter(|_| !optimum.is_cancelled) else {
                return Ok(round_shares(
                    problem,
                    &target,
                    &octree,
                    Optimum {
                        evaluations,
                        ..optimum
                    },
                ));
            };
            start = Start {
                x,
                known: Some((optimum.multipliers, optimum.penalty)),
                smoothing: self.smoothing,
            };
            octree = finer;
        }
        let optimum = minimise(&target, &octree, start, effort);
        evaluations += optimum.evaluations;
        Ok(round_shares(
            problem,
            &target,
            &octree,
            Optimum {
                evaluations,
                ..optimum
            },
        ))
    }
}

/// Rounds every share and measures the cost of it.
fn round_shares(problem: &Problem, target: &Target, octree: &Octree, optimum: Optimum) -> Found {
    let exact = problem.fixed - octree.moments(&optimum.x);
    let is_fractional = |x: f64| x > FRACTION_TOLERANCE && x < 1.0 - FRACTION_TOLERANCE;
    let shares = optimum.x.iter().zip(octree.weights());
    let rounding = Rounding {
        value_before: value_of(problem, &exact),
        residual_before: target.residual(&exact),
        fractional_ratio: shares
            .filter(|(x, _)| is_fractional(**x))
            .map(|(_, weight)| weight)
            .sum(),
    };
    let x = optimum.x.iter().map(|x| x.round()).collect();
    let found = measure(problem, target, octree, &Optimum { x, ..optimum });
    Found {
        rounding: Some(rounding),
        ..found
    }
}
