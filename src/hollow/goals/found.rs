//! A solution of graded densities from its parts.

use nalgebra::DVector;

use super::kept::Kept;
use crate::geom::Quadric;
use crate::hollow::Problem;
use crate::hollow::dual::programme::DualPoint;
use crate::hollow::solution::{Certificate, Solution, Warm};
use crate::hollow::status::Status;
use crate::mass::Moments;

/// The parts of a solution that differ from case to case.
pub(super) struct Found {
    pub status: Status,
    pub quadric: Quadric,
    pub certificate: Certificate,
    pub moments: Moments,
    pub passes: usize,
    /// The figure that is kept; `None` for none.
    pub kept: Option<Kept>,
}

/// Returns the solution of a problem. Only what is kept helps another one.
pub(super) fn solution(problem: &Problem, found: Found) -> Solution {
    let Found {
        status,
        quadric,
        certificate,
        moments,
        passes,
        kept,
    } = found;
    Solution {
        status,
        objective: problem.goal.objective,
        quadric,
        certificate,
        moments,
        passes,
        log: Vec::new(),
        course: Vec::new(),
        warm: Warm {
            point: DualPoint {
                y: DVector::zeros(0),
                lambda: DVector::zeros(0),
                tau: 0.0,
            },
            height: None,
            lever: None,
            kept,
        },
    }
}
