//! Spin-It's method: a share of every leaf of an octree, split where it is fractional until it is
//! fine, then rounded.

use super::lagrangian::{Accuracy, Effort, Optimum, Start, minimise};
use super::measure::{measure, value_of};
use super::method::{Found, Method, MethodError, Rounding};
use super::target::Target;
use crate::base::watch::Watch;
use crate::hollow::Problem;
use crate::interior::{Choice, Levels, Octree};

/// The octree of Spin-It §5 ([`Octree`]): the fill of every leaf between 0 and 1, a uniform
/// Laplacian to keep it smooth, and after each solution fractional leaves split and siblings that
/// agree merged, until what is fractional is of the finest level, one column wide. At the end every
/// share is rounded to 0 or 1, which breaks the constraints again: by how much is in
/// [`Found::rounding`] and [`Found::residual`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ByOctree {
    /// How exact, at what cost; each round of splitting has these evaluations.
    pub accuracy: Accuracy,
    /// Where it begins.
    pub levels: Levels,
    /// The weight of the Laplacian: of the mean of ½(βᵢ − βⱼ)² over neighbouring leaves, beside f.
    /// Above 1e-3 it shapes the void; at 0 leaves that the void's surface only grazes are split for
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

/// Evaluations of one round; most need a few hundred, and a round that does not end only delays the
/// next splitting.
const EVALUATIONS_A_ROUND: usize = 4000;
/// Shares this near to 0 or 1 are not fractional.
const FRACTION_TOLERANCE: f64 = 1e-3;
/// Splittings at most, for each level; siblings that merge may have to be split again.
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
            let refined = octree.refined(&optimum.x, FRACTION_TOLERANCE);
            let Some((finer, x)) = refined.filter(|_| !optimum.is_cancelled) else {
                return Ok(rounded(
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
        Ok(rounded(
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

/// The answer with every share rounded, and what that cost.
fn rounded(problem: &Problem, target: &Target, octree: &Octree, optimum: Optimum) -> Found {
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
