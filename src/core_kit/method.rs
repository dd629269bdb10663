//! The orders that the method of the paper cannot carry out.

use super::error::CoreRunError;
use crate::job::core_kit::CoreJob;
use crate::polyhedra::vertices::StartSolid;

/// Refuses an order that the method of the paper cannot carry out.
///
/// # Errors
/// Vertices make one polyhedron, and keep the faces of their start.
pub fn check_method(job: &CoreJob) -> Result<(), CoreRunError> {
    let starts = job.method.starts();
    let fewest = starts.into_iter().map(StartSolid::face_count).min();
    let (Some(fewest), None) = (fewest, &job.base) else {
        return Ok(());
    };
    if !job.polyhedra.is_one() {
        return Err(CoreRunError::VerticesOfSeveral {
            polyhedra: job.polyhedra,
        });
    }
    if job.faces < fewest {
        return Err(fewer_than_start(job));
    }
    Ok(())
}

/// Returns the error of an order for fewer faces than any start of its method has.
pub fn fewer_than_start(job: &CoreJob) -> CoreRunError {
    let starts = job.method.starts().into_iter();
    CoreRunError::FewerThanStart {
        faces: job.faces,
        fewest: starts.map(StartSolid::face_count).min().unwrap_or(0),
    }
}
