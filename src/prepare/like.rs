//! Like: the mass properties of a match, taken from a file.

use crate::base::digest::sha256_hex;
use crate::base::units::MM3_PER_CM3;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::goal::{GoalError, GoalKind, Request, RequestError, Target};
use crate::io;
use crate::job::{Job, JobError, Like};
use crate::mass::{Body, moments_of_mesh};
use crate::mend::{MendError, mend};
use crate::mesh::{Defects, Solid, scaled};
use crate::repair::RepairOrder;
use crate::run::Model;

/// Returns the job with the numbers of the body that it is to be like. Its file is read unless they
/// are there, as in the job of a kit.
///
/// # Errors
/// The file cannot be read, has changed or bounds no solid, or the goal is no match.
pub fn resolved(job: &Job, model: &Model, watch: &Watch) -> Result<Job, Error> {
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
    let as_in = Mending {
        model,
        order: job.repair,
        watch,
    };
    let target = Some(measure(&like, &bytes, &as_in)?);
    Ok(Job {
        goal: Request { target, ..job.goal },
        like: Some(like),
        ..job.clone()
    })
}

/// The way in which the model was read.
struct Mending<'a> {
    model: &'a Model,
    order: RepairOrder,
    watch: &'a Watch,
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

/// Measures the mass properties of a file's solid, mended and scaled as the model.
fn measure(like: &Like, bytes: &[u8], as_in: &Mending) -> Result<Target, Error> {
    let Mending {
        model,
        order,
        watch,
    } = *as_in;
    let path = || like.path.clone();
    let content = |source| io::ReadError::Content {
        path: path(),
        source,
    };
    let read = io::decode_model(bytes).map_err(content)?;
    let factor = |_| model.scale_ratio;
    let mended = mend(read, order, factor, watch).map_err(|error| match error {
        MendError::Cancelled(cancelled) => cancelled.into(),
        source => Error::Mend {
            path: path(),
            source: Box::new(source),
        },
    })?;
    let scaled = scaled(&mended.mesh, model.scale_ratio);
    let solid = Solid::new(scaled).map_err(|defects| Error::NotSolid {
        path: path(),
        source: Box::new(Defects::of(&mended.mesh).unwrap_or(defects)),
    })?;
    let moments = moments_of_mesh(solid.mesh());
    Ok(Target::of(&Body::new(
        &moments,
        like.density_g_cm3 / MM3_PER_CM3,
    )))
}
