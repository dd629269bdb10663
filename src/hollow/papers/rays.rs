//! Wu, Kramer and Westermann's method: the two ends of the solid segment on every ray.

use super::lagrangian::{Accuracy, Effort, Optimum, Start, minimise};
use super::measure::measure;
use super::method::{Found, Method, MethodError};
use super::target::Target;
use crate::base::watch::Watch;
use crate::hollow::Problem;
use crate::interior::{Choice, Rays};

/// Limit on reopening vanished segments. Without it, values ended up to 3e-4 above the best; the
/// gain soon falls.
const REOPENINGS: usize = 4;

/// The ray-rep: z₀ and z₁ on every stretch of every column, with z̲ ≤ z₀ ≤ z₁ ≤ z̄ ([`Rays`], their
/// eq. 11, 13, 14).
///
/// The moments are at most cubic in them, so the programme is smooth but not convex. A vanished
/// segment has no gradient towards material elsewhere on its ray. So after each solution such
/// segments open again where material is wanted ([`Rays::reopen`]). An interior-point method does
/// not need this, as its segments never quite vanish. The λ_max of critical speed and dominance is
/// smoothed by 1e-4 of the solid's moments.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ByRays {
    /// Accuracy and cost limits.
    pub accuracy: Accuracy,
}

impl Method for ByRays {
    fn name(&self) -> &'static str {
        "rays"
    }

    fn find(&self, problem: &Problem, watch: &Watch) -> Result<Found, MethodError> {
        let effort = Effort {
            accuracy: &self.accuracy,
            watch,
        };
        let (target, rays) = (
            Target::new(self.name(), problem)?,
            Rays::of(problem.columns),
        );
        let mut optimum = minimise(&target, &rays, Start::from(rays.nothing()), effort);
        for _ in 0..REOPENINGS {
            let reopened = rays.reopen(&optimum.x, &optimum.quadric);
            let Some(x) = reopened.filter(|_| !optimum.is_cancelled) else {
                break;
            };
            let known = Some((optimum.multipliers, optimum.penalty));
            let again = minimise(
                &target,
                &rays,
                Start {
                    x,
                    known,
                    smoothing: 0.0,
                },
                effort,
            );
            optimum = Optimum {
                evaluations: optimum.evaluations + again.evaluations,
                ..again
            };
        }
        Ok(measure(problem, &target, &rays, &optimum))
    }
}
