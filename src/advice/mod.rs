//! Advice: remedies for an impossible goal, the best way up, and the goals that a model could meet.
//!
//! # Remedies
//! If the solver proves that no hollowing meets a goal, something has to change. It may be the
//! size, the wall, the contact or spin point, the axis, the face it stands on, or the mass, by
//! ballast. [`remedies`] asks the same solver for the least change that is enough. It confirms
//! every answer by a solve on exact columns with the numbers that are printed. A [`Remedy`] holds
//! that number, the options to set, and the value that the goal then reaches. Otherwise it says
//! that this kind of change does not help.
//!
//! # Which way up
//! [`best_orientation`] tries a lattice of axes over the sphere, or the faces of the convex hull
//! for a standing object, and refines the best. [`prospects`] lists the goals that a model could
//! meet along its own and the coordinate axes.
//!
//! # Speed
//! Building a wall for each of hundreds of trials would take too long. So one pass samples the
//! depth below the surface. Any wall is a level set of the depth ([`crate::interior::Depths`]), and
//! any frame is a linear map of the moments ([`crate::hollow::solve_on_model_columns`]). A trial
//! then costs a few milliseconds.
//!
//! The files, in reading order:
//!
//! * `case`, `sampled_model`: the question, and the model on which requests are tried
//!
//! * `ratio`: size and wall
//!
//! * `moves`, `nearest`, `move_remedy`: contact, spin point and axis
//!
//! * `footing`: the faces to stand on
//!
//! * `ballast`: steel inside
//!
//! * `remedy`: the answer and its words
//!
//! * `orientation`, `natural`, `prospects`: the best axis, the one nearest to the natural up, and
//!   the goals a model could meet

mod ballast;
mod case;
mod confirm;
mod directions;
mod footing;
mod move_remedy;
mod moves;
mod natural;
mod nearest;
mod orientation;
mod prospects;
mod ratio;
mod reached;
mod remedy;
mod sampled_model;
#[cfg(test)]
mod tests;

use rayon::prelude::*;

use crate::base::watch::{Cancelled, Watch};
use crate::goal::GoalKind;

pub use case::Case;
pub use natural::{NearbyAxis, name_direction, nearest_orientation};
pub use orientation::{Orientation, best_orientation};
pub use prospects::{Prospect, TurnsOn, prospects};
pub use reached::Reached;
pub use remedy::{Confirmation, Kind, Remedy};

use moves::Moves;
use sampled_model::{COARSE_SAMPLES, FINE_SAMPLES, SampledModel};

/// Returns true if some hollowing meets the goal of a case, on coarse samples. Its promises of lean
/// and angle are not looked at.
///
/// Costs a pass over the samples and a trial: some tenths of a second on 100 000 triangles.
///
/// # Errors
/// The watch was stopped.
pub fn is_possible(case: &Case, watch: &Watch) -> Result<bool, Cancelled> {
    let model = SampledModel::new(*case, COARSE_SAMPLES, watch);
    let is_possible = model.allows(&case.request, case.wall_mm);
    watch.check()?;
    Ok(is_possible)
}

/// Returns true if some hollowing meets the goal of a case and its promises, with its tip, on exact
/// columns.
///
/// Costs a pass over the samples and a solve.
///
/// # Errors
/// The watch was stopped.
pub fn keeps_promises(case: &Case, watch: &Watch) -> Result<bool, Cancelled> {
    let model = SampledModel::new(*case, COARSE_SAMPLES, watch);
    let is_kept = model.confirm(&case.request, case.wall_mm).is_some();
    watch.check()?;
    Ok(is_kept)
}

/// Returns the remedies for an impossible goal: one for each kind of change, in a fixed order, with
/// those that do not help. Empty if the goal cannot be placed.
///
/// Costs some hundred trials and a few exact solves: about a second on 10 000 triangles, a few on
/// 100 000. The remedies are the same for any number of threads.
///
/// # Errors
/// The watch was stopped.
pub fn remedies(case: &Case, watch: &Watch) -> Result<Vec<Remedy>, Cancelled> {
    let model = SampledModel::new(*case, FINE_SAMPLES, watch);
    let Some(asked) = model.trial(&case.request, case.wall_mm) else {
        watch.check()?;
        return Ok(Vec::new());
    };
    let goal = &asked.placement.goal;
    let moves = Moves::of(case, goal);
    let (mut all, (moved, ballast)): (Vec<Remedy>, (Vec<Remedy>, Remedy)) = rayon::join(
        || ratio::remedies(&model),
        || {
            rayon::join(
                || {
                    moves
                        .par_iter()
                        .map(|moves| move_remedy::remedy(&model, moves))
                        .collect()
                },
                || ballast::remedy(&model),
            )
        },
    );
    all.extend(moved);
    if goal.kind == GoalKind::Stand {
        all.push(footing::remedy(&model, &goal.frame.axis()));
    }
    // What is filled takes no ballast besides.
    all.extend(case.fill.is_none().then_some(ballast));
    watch.check()?;
    Ok(all)
}
