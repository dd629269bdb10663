//! Wu, Kramer and Westermann's method: the two ends of the solid segment on every ray.

use super::super::method::{Found, Method, MethodError};
use super::super::problem::Problem;
use super::{Accuracy, find_by};
use crate::interior::Rays;
use crate::progress::Progress;

/// The ray-rep: z₀ and z₁ on every stretch of every column, with z̲ ≤ z₀ ≤ z₁ ≤ z̄ ([`Rays`], their eq. 11, 13, 14).
///
/// The moments are at most cubic in them, so the programme is smooth but not convex; from the solid it has always been
/// seen to reach the quadric's value. λ_max (critical speed, dominance) is smoothed by 1e-4 of the solid's moments.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ByRays {
    /// How exact, at what cost.
    pub accuracy: Accuracy,
}

impl Method for ByRays {
    fn name(&self) -> &'static str {
        "rays"
    }

    fn find(&self, problem: &Problem, progress: &Progress) -> Result<Found, MethodError> {
        find_by(self.name(), problem, &Rays::of(problem.columns), (&self.accuracy, progress))
    }
}
