//! Fit: levels, shares and a wished infill that go with each other and with the densities.

use crate::error::GradedError;
use crate::goal::GoalKind;
use crate::job::{DensityOrder, Job};

/// Refuses orders of a graded job that do not go with its densities or with each other.
///
/// # Errors
/// They say what to leave out or to order.
pub fn refuse_misfits(job: &Job, order: DensityOrder) -> Result<(), GradedError> {
    let is_match = job.goal.kind == GoalKind::Match;
    let more = job.levels.filter(|levels| !levels.is_two());
    match (job.infill, job.levels, job.keep) {
        (None, Some(_), _) if is_match && more.is_none() => {
            return Err(GradedError::TwoLevelsOfMatch);
        }
        (None, _, Some(share)) => return Err(GradedError::KeepAlone { share }),
        (Some(_), _, Some(share)) if job.goal.kind == GoalKind::Balance => {
            return Err(GradedError::KeepBalance { share });
        }
        (_, Some(_), _) if job.field.is_some() && more.is_none() => {
            return Err(GradedError::TwoLevelsOfField);
        }
        (None, Some(levels), None) if more.is_some() && !is_match && job.field.is_none() => {
            return Err(GradedError::LevelsAlone { levels });
        }
        (Some(wished), Some(_), _) if more.is_none() => {
            return Err(GradedError::TwoLevels { wished });
        }
        _ => {}
    }
    match job.infill {
        Some(wished) if job.goal.kind == GoalKind::Float => {
            Err(GradedError::WishedAfloat { wished })
        }
        Some(wished) if wished < order.low() || wished > order.high() => {
            Err(GradedError::WishedOutside {
                wished,
                densities: order,
            })
        }
        _ => Ok(()),
    }
}
