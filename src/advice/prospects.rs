//! What a model could become, along its own and the coordinate axes.

use rayon::prelude::*;
use serde::Serialize;

use super::Case;
use super::directions::distinct;
use super::ground::{COARSE_SAMPLES, Ground, Trial};
use super::orientation::{along, points_down, special_axes};
use super::reached::Reached;
use crate::geom::Vector;
use crate::goal::{Contact, GoalKind, Request, Up};
use crate::hollow::Status;

/// A principal axis this near to a coordinate axis is that axis: cos 1°.
const SAME_COSINE: f64 = 0.999_85;

/// A goal on an axis, and whether the model can meet it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Prospect {
    /// What it would do.
    pub kind: GoalKind,
    /// Which way up.
    pub up: Up,
    /// Tops: where it touches the ground; none for the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<Contact>,
    /// Whether some hollowing with this wall does it, and the full solid too.
    pub possible: bool,
    /// What is reached at best, to a few per cent; none where it is impossible.
    pub reached: Option<Reached>,
    /// Why not, with the number; empty where it is possible.
    pub reason: String,
}

/// Which goals a model could meet with its wall: tops on their lowest point, else with the contact
/// below the centre of mass, yo-yos about their centre of mass, and standing objects, along the
/// coordinate axes and the solid's principal axes; those that cannot be placed are left out.
///
/// The request of the case is not read. Costs about thirty trials.
pub fn prospects(case: &Case) -> Vec<Prospect> {
    let ground = Ground::new(*case, COARSE_SAMPLES);
    let axes = distinct(special_axes(case), SAME_COSINE);
    let wishes: Vec<Request> = [GoalKind::Top, GoalKind::Yoyo, GoalKind::Stand]
        .iter()
        .flat_map(|&kind| wishes(kind, &axes))
        .collect();
    let found: Vec<Option<Prospect>> = wishes
        .par_iter()
        .map(|wish| prospect(&ground, wish))
        .collect();
    found.into_iter().flatten().collect()
}

fn wishes(kind: GoalKind, axes: &[Vector]) -> Vec<Request> {
    let has_sense = kind != GoalKind::Yoyo;
    let axes = axes.iter().filter(|axis| has_sense || !points_down(axis));
    axes.map(|axis| Request {
        up: worded(axis),
        ..along(&Request::new(kind), axis)
    })
    .collect()
}

/// The word for a coordinate axis, or the vector.
fn worded(axis: &Vector) -> Up {
    let words = [Up::X, Up::Y, Up::Z, Up::NegX, Up::NegY, Up::NegZ];
    let is_it = |up: &Up| up.direction().is_some_and(|direction| direction == *axis);
    words
        .into_iter()
        .find(is_it)
        .unwrap_or(Up::Along((*axis).into()))
}

fn prospect(ground: &Ground, wish: &Request) -> Option<Prospect> {
    let top = wish.kind == GoalKind::Top;
    let tried = |contact| ground.trial(&Request { contact, ..*wish }, ground.case.wall_mm);
    let lowest = tried(top.then_some(Contact::Lowest));
    let is_possible = |trial: &Option<Trial>| trial.as_ref().is_some_and(Trial::is_possible);
    let below = if top && !is_possible(&lowest) {
        tried(Some(Contact::Center))
    } else {
        None
    };
    let helps = is_possible(&below);
    let contact = top.then_some(if helps {
        Contact::Center
    } else {
        Contact::Lowest
    });
    let trial = if helps { below } else { lowest }?;
    let possible = trial.is_possible();
    let reached = Reached::of(&trial);
    let places = if top {
        ", neither on its lowest point nor below its centre of mass"
    } else {
        ""
    };
    let reason = if possible {
        String::new()
    } else {
        brief(&trial) + places
    };
    Some(Prospect {
        kind: wish.kind,
        up: wish.up,
        contact,
        possible,
        reached: possible.then_some(reached),
        reason,
    })
}

/// Why a goal is impossible, in a few words with the number.
fn brief(trial: &Trial) -> String {
    match trial.solution.status {
        Status::ConstraintsInfeasible { .. } => "it cannot be balanced about this axis".to_owned(),
        Status::NotDominant { least_ratio }
        | Status::UnstableForEveryInterior { least_ratio, .. } => {
            format!("I_b/I_c stays above {least_ratio:.3}")
        }
        Status::CannotStand { greatest_angle_rad } => {
            format!(
                "it leans over by {:.1}° at least",
                -greatest_angle_rad.to_degrees()
            )
        }
        status => status.explain(&trial.placement.goal),
    }
}
