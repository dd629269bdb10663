//! Like: the mass properties of a match, taken from a file.

use crate::base::digest::sha256_hex;
use crate::base::units::MM3_PER_CM3;
use crate::error::Error;
use crate::goal::{GoalError, GoalKind, Request, RequestError, Target};
use crate::io;
use crate::job::{Job, JobError, Like};
use crate::mass::{Body, moments_of_mesh};
use crate::mesh::{Solid, scaled};
use crate::run::Model;

/// Returns the job with the numbers of the body that it is to be like. Its file is read unless they
/// are there, as in the job of a kit.
///
/// # Errors
/// The file cannot be read, has changed or bounds no solid, or the goal is no match.
pub fn resolved(job: &Job, model: &Model) -> Result<Job, Error> {
    let Some(like) = &job.like else {
        return Ok(job.clone());
    };
    if job.goal.kind != GoalKind::Match {
        return Err(GoalError::from(RequestError::NoMatch(job.goal.kind)).into());
    }
    if job.goal.target.is_some() {
        return Ok(job.clone());
    }
    let bytes = io::read_bytes(&like.path)?;
    let like = bind(like, &bytes)?;
    let target = Some(measure(&like, &bytes, model.scale_ratio)?);
    Ok(Job {
        goal: Request { target, ..job.goal },
        like: Some(like),
        ..job.clone()
    })
}

/// Binds the body to the bytes of its file. Refuses if it was bound to others.
fn bind(like: &Like, bytes: &[u8]) -> Result<Like, JobError> {
    let found = sha256_hex(&[bytes]);
    match &like.sha256 {
        Some(expected) if *expected != found => Err(JobError::ModelChanged {
            path: like.path.clone(),
            found,
            expected: expected.clone(),
        }),
        _ => Ok(Like {
            sha256: Some(found),
            ..like.clone()
        }),
    }
}

/// Measures the mass properties of a file's solid, scaled as the model.
fn measure(like: &Like, bytes: &[u8], scale_ratio: f64) -> Result<Target, Error> {
    let path = || like.path.clone();
    let content = |source| io::ReadError::Content {
        path: path(),
        source,
    };
    let mesh = io::decode_model(bytes).map_err(content)?;
    let solid = Solid::new(scaled(&mesh, scale_ratio)).map_err(|defects| Error::NotSolid {
        path: path(),
        source: Box::new(defects),
    })?;
    let moments = moments_of_mesh(solid.mesh());
    Ok(Target::of(&Body::new(
        &moments,
        like.density_g_cm3 / MM3_PER_CM3,
    )))
}
