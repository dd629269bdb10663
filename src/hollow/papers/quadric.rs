//! The solver itself behind the trait of the papers' methods.

use super::method::{Found, Method, MethodError, Outcome};
use crate::base::watch::Watch;
use crate::hollow::{Problem, Settings, Solution, Status, solve};
use crate::interior::Emptied;

/// The solver of this program: one quadric, with a certificate ([`solve`]).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ByQuadric {
    /// Accuracy and cost limits.
    pub settings: Settings,
}

impl Method for ByQuadric {
    fn name(&self) -> &'static str {
        "quadric"
    }

    fn find(&self, problem: &Problem, watch: &Watch) -> Result<Found, MethodError> {
        let solution = solve(problem, &self.settings, watch);
        Ok(Found {
            outcome: outcome_of(&solution),
            figure: solution.certificate.figure,
            value: solution.certificate.value,
            moments: solution.moments,
            residual: solution.certificate.residual,
            variables: solution.quadric.0.len(),
            iterations: solution.passes,
            emptied: Emptied::where_positive(problem.columns, &solution.quadric),
            rounding: None,
        })
    }
}

fn outcome_of(solution: &Solution) -> Outcome {
    match solution.status {
        Status::Solved => Outcome::Optimal,
        Status::AlmostSolved | Status::IterationLimit { .. } => Outcome::Unfinished,
        Status::Cancelled => Outcome::Cancelled,
        _ => Outcome::Impossible,
    }
}
