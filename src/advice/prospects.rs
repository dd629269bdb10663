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
use crate::goal::{Contact, Footing, GoalKind, Request, Rod, Up, Warning};
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
    /// Tops: the tip that it needs; `None` if it spins on its own foot, and for the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip: Option<Rod>,
    /// True if some hollowing with this wall meets it and its promises of lean and toppling angle.
    /// The full solid counts too.
    pub possible: bool,
    /// The best value reached, to a few per cent; `None` if it is impossible.
    pub reached: Option<Reached>,
    /// The reason why it is impossible, with the number; empty if it is possible.
    pub reason: String,
}

/// Returns the goals that a model could meet with its wall, along the coordinate axes and the
/// solid's principal axes. They are tops on their lowest point, else on a tip below the centre of
/// mass; yo-yos about their centre of mass; and standing objects. Goals that cannot be
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
        up: Up::of(axis),
        ..with_axis(&Request::new(kind), axis)
    })
    .collect()
}

fn prospect(model: &SampledModel, request: &Request) -> Option<Prospect> {
    let is_top = request.kind == GoalKind::Top;
    let (contact, trial) = if is_top {
        let (contact, trial) = try_contacts(model, request)?;
        (Some(contact), trial)
    } else {
        (None, model.trial(request, model.case.wall_mm)?)
    };
    let reached = Reached::of(&trial.solution.certificate);
    let refusal = refusal(request, &trial, &reached);
    let possible = refusal.is_none();
    let footing = trial.placement.footing.as_ref();
    Some(Prospect {
        kind: request.kind,
        up: request.up,
        contact,
        tip: footing.and_then(Footing::tip).filter(|_| possible),
        possible,
        reached: possible.then_some(reached),
        reason: refusal.unwrap_or_default(),
    })
}

/// Returns the reason why a trial does not do what is promised; `None` if it does.
fn refusal(request: &Request, trial: &Trial, reached: &Reached) -> Option<String> {
    let is_top = request.kind == GoalKind::Top;
    if !trial.is_possible() {
        let places = if is_top {
            ", neither on its lowest point nor below its centre of mass"
        } else {
            ""
        };
        return Some(brief(trial) + places);
    }
    if trial.placement.warnings.contains(&Warning::NoTip) {
        return Some("no tip below its centre of mass is held by the model".to_owned());
    }
    let angle_deg = reached.value.to_degrees();
    let is_shaky = request.kind == GoalKind::Stand && angle_deg < request.least_angle_deg;
    is_shaky.then(|| format!("it stands, but topples at {angle_deg:.1}° at best"))
}

/// Tries a top on its lowest point if it leans there as promised, else below its centre of mass.
/// Returns the contact that is possible, the latter if none is.
fn try_contacts(model: &SampledModel, request: &Request) -> Option<(Contact, Trial)> {
    let with = |contact| {
        let request = Request {
            contact: Some(contact),
            ..*request
        };
        let trial = model.trial_as_promised(&request, model.case.wall_mm)?;
        Some((contact, trial))
    };
    let is_possible = |(_, trial): &(Contact, Trial)| trial.is_possible();
    let spins = model.spins_on_lowest(request);
    let lowest = spins.then(|| with(Contact::Lowest)).flatten();
    lowest.filter(is_possible).or_else(|| with(Contact::Center))
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
                "falls over ({:.1}° short)",
                -greatest_angle_rad.to_degrees()
            )
        }
        status => status.explain(&trial.placement.goal),
    }
}
