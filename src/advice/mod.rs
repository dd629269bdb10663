//! Advice: what would make an impossible goal possible, which way up is best, and what a model
//! could become at all.
//!
//! # Remedies
//! Where the solver proves that no hollowing meets a goal, something has to give: the size, the
//! wall, the contact or spin point, the axis, the face it stands on, or the material, by ballast.
//! [`remedies`] asks the same solver how little is enough, and confirms every answer by a solve on
//! exact columns with the very numbers that are printed. A [`Remedy`] carries that number, what to
//! type, and what the goal then reaches; or says that this way leads nowhere.
//!
//! # Which way up
//! [`best_orientation`] tries a lattice of axes over the sphere (for a standing object the faces of
//! its convex hull) and refines the best; [`prospects`] lists what a model could become along its
//! own and the coordinate axes.
//!
//! # How it is quick enough
//! Hundreds of trials cannot each build a wall. One pass samples the depth below the surface; any
//! wall is a level set of it ([`crate::interior::Depths`]), and any frame is a linear map of the
//! moments ([`crate::hollow::solve_on_model_columns`]). A trial then costs a few milliseconds.
//!
//! The files, in reading order: `ground` what a trial is · `ratio` size and wall · `moves`,
//! `nearest` contact and axis · `footing` the faces to stand on · `ballast` · `remedy` the values
//! and their words · `orientation` and `prospects`.

mod ballast;
mod confirm;
mod directions;
mod footing;
mod ground;
mod moves;
mod nearest;
mod orientation;
mod prospects;
mod ratio;
mod reached;
mod remedy;
#[cfg(test)]
mod tests;

use rayon::prelude::*;

use crate::goal::{GoalKind, Request};
use crate::mesh::Solid;

pub use orientation::{Orientation, best_orientation};
pub use prospects::{Prospect, prospects};
pub use reached::Reached;
pub use remedy::{Confirmation, Kind, Remedy};

use ground::{FINE_SAMPLES, Ground};
use moves::Moves;

/// What is wished for, and what the printer allows.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a> {
    /// The model, mm.
    pub solid: &'a Solid,
    /// The goal.
    pub request: Request,
    /// The wall that is printed, mm.
    pub wall_mm: f64,
    /// The thinnest wall the printer makes, mm.
    pub least_wall_mm: f64,
    /// Walls are whole multiples of this, mm.
    pub wall_step_mm: f64,
    /// The density of what is printed, g/cm³.
    pub density_g_cm3: f64,
    /// The longest model whose kit this printer could print, mm.
    pub greatest_size_mm: f64,
}

/// What would make an impossible goal possible: a remedy for each way there is, in a fixed order,
/// also those that lead nowhere. Empty where the goal cannot be placed.
///
/// Costs some hundred trials and a few exact solves: about a second on 10 000 triangles, a few on
/// 100 000. The same remedies for any number of threads.
pub fn remedies(case: &Case) -> Vec<Remedy> {
    let ground = Ground::new(*case, FINE_SAMPLES);
    let Some(asked) = ground.trial(&case.request, case.wall_mm) else {
        return Vec::new();
    };
    let goal = &asked.placement.goal;
    let moves = Moves::of(case, goal);
    let (mut all, (moved, ballast)): (Vec<Remedy>, (Vec<Remedy>, Remedy)) = rayon::join(
        || ratio::remedies(&ground),
        || {
            rayon::join(
                || {
                    moves
                        .par_iter()
                        .map(|moves| moved(&ground, moves))
                        .collect()
                },
                || ballast::remedy(&ground),
            )
        },
    );
    all.extend(moved);
    if goal.kind == GoalKind::Stand {
        all.push(footing::remedy(&ground, &goal.frame.axis()));
    }
    all.push(ballast);
    all
}

/// The nearest step of a kind; where no axis helps, also with the contact below the centre of mass.
fn moved(ground: &Ground, moves: &Moves) -> Remedy {
    let found = nearest::nearest(ground, moves);
    let other = if found.is_none() {
        moves.over_the_center()
    } else {
        None
    };
    match other.and_then(|other| Some((nearest::nearest(ground, &other)?, other))) {
        Some((nearest, other)) => other.remedy(Some(nearest)),
        None => moves.remedy(found),
    }
}
