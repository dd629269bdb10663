//! The natural up: the pose in which a model most likely stands.
//!
//! [`find_upright`] compares the poses that a model may have by itself. It rests on a face of its
//! convex hull. Or it stands along the line in which its mirror planes meet, or along its own axes.
//! The best come back, with the reasons that speak for them.
//!
//! The files, in reading order:
//!
//! * `shape`: the model in a frame of its own
//!
//! * `symmetry`, `candidates`: the mirror planes, and the poses to compare
//!
//! * `foot`, `rest`, `vessel`: what is measured of a pose
//!
//! * `score`, `pose`: the weights, and the answer
//!
//! Nothing here depends on the axes of the file but a tie. Of poses that are equally good the one
//! nearest to the file's z is taken. The answer is the same for any number of threads.

mod candidates;
mod foot;
mod pose;
mod rest;
mod score;
mod shape;
mod symmetry;
#[cfg(test)]
mod tests;
mod vessel;

use rayon::prelude::*;

use crate::base::watch::{Cancelled, Watch};
use crate::mesh::Solid;
use candidates::{poses, steadied};
pub use pose::{UprightPose, UprightReason};
use score::Judged;
use shape::Shape;
use symmetry::{Looking, Mirror};

/// Poses nearer than 15° to a better one are that one.
const SAME_COSINE: f64 = 0.966;
/// The number of poses that are filled with liquid: the best by everything else.
const MOST_FILLED: usize = 16;
/// The number of poses that are listed.
const MOST_TOLD: usize = 6;
/// Scores that differ by less are a tie: rounding and sampling move them by as much.
const TIE: f64 = 0.01;

/// Returns the poses in which a model may stand by nature, the best first. Empty if it has no
/// convex hull.
///
/// Takes about 0.2 s on 100 000 triangles.
///
/// # Errors
/// The watch was stopped.
pub fn find_upright(solid: &Solid, watch: &Watch) -> Result<Vec<UprightPose>, Cancelled> {
    let Some(shape) = Shape::of(solid) else {
        return Ok(Vec::new());
    };
    watch.check()?;
    let looking = Looking::at(&shape);
    let mirrors = looking.mirrors(watch)?;
    let judged = poses(&shape, &mirrors).into_par_iter().map(|up| {
        watch.check()?;
        Ok(Judged::of(&looking, &mirrors, &up))
    });
    let mut judged = judged.collect::<Result<Vec<Judged>, Cancelled>>()?;
    sort(&mut judged);
    judged.truncate(MOST_FILLED);
    let filled = judged.into_par_iter().map(|pose| {
        watch.check()?;
        Ok(pose.with_liquid(&shape))
    });
    let mut filled = filled.collect::<Result<Vec<Judged>, Cancelled>>()?;
    sort(&mut filled);
    Ok(tell(&shape, &mirrors, distinct(filled)))
}

/// Sorts poses, the best first.
fn sort(poses: &mut [Judged]) {
    poses.sort_by(|a, b| b.score.total_cmp(&a.score));
}

/// Returns the best of the poses that lie near each other.
fn distinct(ranked: Vec<Judged>) -> Vec<Judged> {
    let mut kept: Vec<Judged> = Vec::new();
    for pose in ranked {
        let is_new = kept
            .iter()
            .all(|known| known.up.dot(&pose.up) < SAME_COSINE);
        if is_new {
            kept.push(pose);
        }
    }
    kept
}

/// Steadies the poses, turns them into the model's frame and breaks a tie.
fn tell(shape: &Shape, mirrors: &[Mirror], ranked: Vec<Judged>) -> Vec<UprightPose> {
    let steady = |pose: Judged| {
        let up = steadied(shape, &pose.up, mirrors);
        pose.moved_to(up)
    };
    let steady = ranked.into_iter().take(2 * MOST_TOLD).map(steady);
    let mut listed: Vec<UprightPose> = distinct(steady.collect())
        .iter()
        .take(MOST_TOLD)
        .map(|pose| UprightPose {
            up: shape.frame.direction_to_model(&pose.up).normalize(),
            score: pose.score,
            lead: 0.0,
            reasons: pose.reasons(),
        })
        .collect();
    break_tie(&mut listed);
    let best = listed.first().map_or(0.0, |pose| pose.score);
    let others = listed.iter().skip(1).map(|pose| pose.score);
    let second = others.fold(f64::NEG_INFINITY, f64::max);
    for (rank, pose) in listed.iter_mut().enumerate() {
        pose.lead = pose.score - if rank == 0 { second } else { best };
    }
    listed
}

/// Puts the one nearest to the file's z before the others that are as good as the best.
fn break_tie(listed: &mut [UprightPose]) {
    let best = listed.first().map_or(0.0, |pose| pose.score);
    let tied = listed
        .iter()
        .take_while(|pose| pose.score > best - TIE)
        .count();
    let higher = |a: &usize, b: &usize| listed[*a].up.z.total_cmp(&listed[*b].up.z).then(b.cmp(a));
    if let Some(nearest) = (0..tied).max_by(higher).filter(|_| tied > 1) {
        listed[..=nearest].rotate_right(1);
        listed[0].reasons.push(UprightReason::FileUp);
    }
}
