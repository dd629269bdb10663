//! The goals that a model could meet, along its own and the coordinate axes.

use rayon::prelude::*;
use serde::Serialize;

use super::case::Case;
use super::directions::{distinct, with_axis};
use super::orientation::{points_down, special_axes};
use super::reached::Reached;
use super::sampled_model::{COARSE_SAMPLES, SampledModel, Trial};
use crate::base::watch::Watch;
use crate::geom::Vector;
use crate::goal::{Contact, GoalKind, Request, Up};
use crate::hollow::Status;

/// A principal axis this near to a coordinate axis is that axis: cos 1°.
const SAME_COSINE: f64 = 0.999_85;

/// A goal on an axis, and whether the model can meet it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Prospect {
    /// The kind of goal.
    pub kind: GoalKind,
    /// The direction that is up.
    pub up: Up,
    /// Tops: the contact point; `None` for the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<Contact>,
    /// True if some hollowing with this wall meets it; the full solid counts too.
    pub possible: bool,
    /// The best value reached, to a few per cent; `None` if it is impossible.
    pub reached: Option<Reached>,
    /// The reason why it is impossible, with the number; empty if it is possible.
    pub reason: String,
}

/// Returns the goals that a model could meet with its wall, along the coordinate axes and the
/// solid's principal axes. They are tops on their lowest point, else with the contact below the
/// centre of mass; yo-yos about their centre of mass; and standing objects. Goals that cannot be
/// placed are left out.
///
/// Ignores the request of the case. Costs about thirty trials.
pub fn prospects(case: &Case) -> Vec<Prospect> {
    let model = SampledModel::new(*case, COARSE_SAMPLES, &Watch::silent());
    let axes = distinct(special_axes(case), SAME_COSINE);
    let requests: Vec<Request> = [GoalKind::Top, GoalKind::Yoyo, GoalKind::Stand]
        .iter()
        .flat_map(|&kind| requests(kind, &axes))
        .collect();
    let found: Vec<Option<Prospect>> = requests
        .par_iter()
        .map(|request| prospect(&model, request))
        .collect();
    found.into_iter().flatten().collect()
}

fn requests(kind: GoalKind, axes: &[Vector]) -> Vec<Request> {
    let has_sense = kind != GoalKind::Yoyo;
    let axes = axes.iter().filter(|axis| has_sense || !points_down(axis));
    axes.map(|axis| Request {
        up: name_axis(axis),
        ..with_axis(&Request::new(kind), axis)
    })
    .collect()
}

/// Returns the word for a coordinate axis, or the vector.
pub(super) fn name_axis(axis: &Vector) -> Up {
    let words = [Up::X, Up::Y, Up::Z, Up::NegX, Up::NegY, Up::NegZ];
    let is_it = |up: &Up| up.direction().is_some_and(|direction| direction == *axis);
    words
        .into_iter()
        .find(is_it)
        .unwrap_or(Up::Along((*axis).into()))
}

fn prospect(model: &SampledModel, request: &Request) -> Option<Prospect> {
    let top = request.kind == GoalKind::Top;
    let with_contact = |contact| {
        model.trial(
            &Request {
                contact,
                ..*request
            },
            model.case.wall_mm,
        )
    };
    let lowest = with_contact(top.then_some(Contact::Lowest));
    let is_possible = |trial: &Option<Trial>| trial.as_ref().is_some_and(Trial::is_possible);
    let below = if top && !is_possible(&lowest) {
        with_contact(Some(Contact::Center))
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
    let reached = Reached::of(&trial.solution.certificate);
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
        kind: request.kind,
        up: request.up,
        contact,
        possible,
        reached: possible.then_some(reached),
        reason,
    })
}

/// Returns the reason why a goal is impossible, in a few words with the number.
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
