//! The five goals, and what a model could reach of each.

use rayon::prelude::*;
use serde::Serialize;

use super::case::Case;
use super::directions::{distinct, is_turned, with_axis};
use super::natural::{NearbyAxis, name_direction, nearest_on};
use super::orientation::special_axes;
use super::reached::Reached;
use super::sampled_model::{COARSE_SAMPLES, SampledModel, Trial};
use crate::base::units::show_wobble;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Vector;
use crate::goal::{
    Contact, Footing, GoalKind, Request, Rod, ShaftAxis, SpinPoint, Up, Warning, find_shafts,
};
use crate::hollow::Status;

/// A principal axis this near to a coordinate axis is that axis: cos 1°.
const SAME_COSINE: f64 = 0.999_85;

/// A goal, and what the model can reach of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Prospect {
    /// The kind of goal.
    pub kind: GoalKind,
    /// The direction that is up.
    pub up: Up,
    /// The angle between it and the natural up, degrees; 0 for the same.
    pub off_deg: f64,
    /// Tops: the contact point; `None` for the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<Contact>,
    /// Tops: the tip that it needs; `None` if it spins on its own foot, and for the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip: Option<Rod>,
    /// Rotors: the bores and shafts of the model; `None` for the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turns_on: Option<TurnsOn>,
    /// True if some hollowing with this wall meets it and its promises of lean and toppling angle.
    /// The full solid counts too. False for a rotor whose bore and axis must first be ordered.
    pub possible: bool,
    /// The best value reached, to a few per cent; `None` if it is impossible.
    pub reached: Option<Reached>,
    /// The reason why it is impossible, with the number; empty if it is possible.
    pub reason: String,
}

/// The bores and shafts of a model that a rotor can turn on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TurnsOn {
    /// The number of their axes. If it is 1, `prepare` takes the axis without being told.
    pub axes: usize,
    /// A point on the axis of the prospect; `None` if the model has no bore and no shaft.
    pub spin_point: Option<SpinPoint>,
}

impl Prospect {
    /// Returns true if another direction than the natural up is up.
    pub fn is_turned(&self) -> bool {
        is_turned(self.off_deg)
    }

    /// Returns true if a bore and its axis must first be ordered: a rotor has neither bore nor
    /// shaft.
    pub fn needs_bore(&self) -> bool {
        self.turns_on.is_some_and(|turns_on| turns_on.axes == 0)
    }

    /// Returns the place in a list, the best first. What needs nothing is before what needs a tip,
    /// another axis or a shaft. What is impossible comes after, and what needs a bore is last.
    fn rank(&self) -> u8 {
        match self {
            needy if needy.needs_bore() => 5,
            Self {
                possible: false, ..
            } => 4,
            Self {
                kind: GoalKind::Balance,
                ..
            } => 3,
            turned if turned.is_turned() => 2,
            Self { tip: Some(_), .. } => 1,
            _ => 0,
        }
    }
}

/// Returns what a model can reach of every goal but a match with its wall, the best first.
///
/// Each goal is tried as `prepare` does. What stands or floats takes the natural up. Tops and
/// yo-yos take the axis nearest to it that works. A rotor takes a bore or a shaft of the model; one
/// without either is told to order a bore. A goal that cannot be placed is left out. Ignores the
/// request of the case.
///
/// Costs some dozen trials, and some hundred if a goal does not work on the natural up.
///
/// # Errors
/// The watch was stopped.
pub fn prospects(case: &Case, natural: &Vector, watch: &Watch) -> Result<Vec<Prospect>, Cancelled> {
    let model = SampledModel::new(*case, COARSE_SAMPLES, watch);
    let kinds = GoalKind::ALL.par_iter();
    let kinds = kinds.filter(|kind| kind.is_asked_of_a_model());
    let tried = kinds.map(|&kind| {
        let model = model.with_request(Request::new(kind));
        match kind {
            GoalKind::Top | GoalKind::Yoyo => spinning(&model, natural),
            GoalKind::Balance => turning(&model, natural),
            _ => Ok(resting(&model, natural)),
        }
    });
    let tried = tried.collect::<Result<Vec<Option<Prospect>>, Cancelled>>()?;
    watch.check()?;
    let mut found: Vec<Prospect> = tried.into_iter().flatten().collect();
    found.sort_by_key(Prospect::rank);
    Ok(found)
}

/// Returns what a top or a yo-yo reaches on the axis nearest to the natural up that works.
fn spinning(model: &SampledModel, natural: &Vector) -> Result<Option<Prospect>, Cancelled> {
    let up = name_direction(&model.case, natural);
    let direction = up.direction().unwrap_or(*natural);
    let Some(nearby) = nearest_on(model, &direction)? else {
        let refused = prospect(model, up, 0.0);
        return Ok(refused.map(Prospect::refused_everywhere));
    };
    let NearbyAxis {
        request, off_deg, ..
    } = nearby;
    let found = prospect(model, request.up, off_deg);
    Ok(found.map(|found| Prospect {
        possible: true,
        reached: found.reached.or(Some(nearby.reached)),
        reason: String::new(),
        ..found
    }))
}

impl Prospect {
    /// Returns the prospect of a goal that is impossible on this axis and on all others.
    fn refused_everywhere(self) -> Self {
        let Self { reason, .. } = &self;
        let reason = format!("{reason}, on every axis");
        Self {
            possible: false,
            reached: None,
            reason,
            ..self
        }
    }
}

/// Returns what stands or floats reaches on its natural up, else on the nearest axis of the file or
/// of the solid that works.
fn resting(model: &SampledModel, natural: &Vector) -> Option<Prospect> {
    let first = prospect(model, name_direction(&model.case, natural), 0.0);
    if first.as_ref().is_some_and(|first| first.possible) {
        return first;
    }
    let mut axes = distinct(special_axes(&model.case), SAME_COSINE);
    axes.sort_by(|a, b| b.dot(natural).total_cmp(&a.dot(natural)));
    let on = |axis: &Vector| {
        let off_deg = axis.angle(natural).to_degrees();
        prospect(model, Up::of(axis), off_deg)
    };
    let found = axes.iter().filter_map(on).find(|found| found.possible);
    found.or(first)
}

/// Returns what a rotor reaches on the bore or shaft of its model that leaves it the most material.
/// A model without one is told that it needs a bore.
fn turning(model: &SampledModel, natural: &Vector) -> Result<Option<Prospect>, Cancelled> {
    let shafts = find_shafts(model.case.solid, &model.watch)?;
    let on = |shaft: &ShaftAxis| {
        let spin_point = Some(shaft.spin_point());
        let request = Request {
            spin_point,
            ..model.case.request
        };
        let turned_deg = shaft.direction.angle(natural).to_degrees();
        let off_deg = turned_deg.min(180.0 - turned_deg);
        let found = prospect(&model.with_request(request), shaft.up(), off_deg)?;
        Some(Prospect {
            turns_on: Some(TurnsOn {
                axes: shafts.len(),
                spin_point,
            }),
            ..found
        })
    };
    if shafts.is_empty() {
        return Ok(Some(without_bore(name_direction(&model.case, natural))));
    }
    let score = |found: &Prospect| found.reached.map_or(f64::INFINITY, |value| value.score());
    let tried = shafts.iter().filter_map(on);
    Ok(tried.min_by(|a, b| score(a).total_cmp(&score(b))))
}

/// Returns the prospect of a rotor whose bore and axis must first be ordered.
fn without_bore(up: Up) -> Prospect {
    Prospect {
        kind: GoalKind::Balance,
        up,
        off_deg: 0.0,
        contact: None,
        tip: None,
        turns_on: Some(TurnsOn {
            axes: 0,
            spin_point: None,
        }),
        possible: false,
        reached: None,
        reason: "it has no bore and no shaft: order a bore, and say which axis".to_owned(),
    }
}

/// Tries the goal of a model with this up; `None` if it cannot be placed.
fn prospect(model: &SampledModel, up: Up, off_deg: f64) -> Option<Prospect> {
    let axis = up.direction()?;
    let request = &with_axis(&model.case.request, &axis);
    let is_top = request.kind == GoalKind::Top;
    let (contact, trial) = if is_top {
        let (contact, trial) = try_contacts(model, request)?;
        (Some(contact), trial)
    } else {
        (None, model.trial(request, model.case.wall_mm)?)
    };
    let reached = Reached::of(&trial.solution.certificate);
    let refusal = refusal(request, &trial, &reached);
    let footing = trial.placement.footing.as_ref();
    Some(Prospect {
        kind: request.kind,
        up,
        off_deg,
        contact,
        tip: footing.and_then(Footing::tip),
        turns_on: None,
        possible: refusal.is_none(),
        reached: refusal.is_none().then_some(reached),
        reason: refusal.unwrap_or_default(),
    })
}

/// Returns the reason why a trial does not do what is promised; `None` if it does.
fn refusal(request: &Request, trial: &Trial, reached: &Reached) -> Option<String> {
    if !trial.is_possible() {
        return Some(brief(trial));
    }
    if trial.placement.warnings.contains(&Warning::NoTip) {
        return Some("no tip below its centre of mass is held by the model".to_owned());
    }
    let angle_deg = reached.value.to_degrees();
    let is_shaky = request.kind == GoalKind::Stand && angle_deg < request.least_angle_deg;
    is_shaky.then(|| format!("topples at {angle_deg:.1}° at best"))
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
        Status::ConstraintsInfeasible { .. } => "wobbles, whatever its interior".to_owned(),
        Status::NotDominant { least_ratio }
        | Status::UnstableForEveryInterior { least_ratio, .. } => {
            format!("too tall to spin: {}", show_wobble(least_ratio))
        }
        Status::CannotStand { greatest_angle_rad } => {
            let short_deg = -greatest_angle_rad.to_degrees();
            format!("falls over ({short_deg:.1}° short)")
        }
        Status::Sinks { .. } => "sinks, even fully hollowed".to_owned(),
        Status::RidesHigh { .. } => "floats too high, even solid".to_owned(),
        Status::CannotTrim { .. } => "tilts in water".to_owned(),
        Status::Capsizes { .. } => "turns over in water".to_owned(),
        Status::CannotBalance {
            least_grade_mm_s, ..
        } => format!("shakes: G {least_grade_mm_s:.1} at best"),
        status => status.explain(&trial.placement.goal),
    }
}
