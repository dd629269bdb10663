//! The remedy of a moved contact, spin point or axis.

use super::directions::{direction_words, nearly_words};
use super::moves::{Moves, Part};
use super::nearest::{Nearest, find_nearest};
use super::remedy::{Change, Kind, Remedy};
use super::sampled_model::SampledModel;
use crate::base::setting::{Key, Setting};
use crate::base::units::show_mm;
use crate::goal::{Contact, Request, TipChoice};

/// Returns the nearest move that helps, as a remedy. If no axis helps, it is also searched with the
/// contact below the centre of mass.
pub(super) fn remedy(model: &SampledModel, moves: &Moves) -> Remedy {
    let found = find_nearest(model, moves);
    let centered = if found.is_none() {
        moves.with_centered_contact()
    } else {
        None
    };
    let nearest = centered.and_then(|moves| find_nearest(model, &moves));
    match found.or(nearest) {
        Some(nearest) => describe(model, moves, &nearest),
        None => Remedy::dead_end(kind(moves.part), no_help(moves.part).to_owned()),
    }
}

fn kind(part: Part) -> Kind {
    match part {
        Part::Contact => Kind::NearestContact,
        Part::SpinPoint => Kind::NearestSpinPoint,
        Part::Axis => Kind::NearestAxis,
    }
}

/// Returns the words for moves of a part, none of which helps.
fn no_help(part: Part) -> &'static str {
    match part {
        Part::Contact => "other contact points on the same level",
        Part::SpinPoint => "other spin points",
        Part::Axis => "other axes",
    }
}

/// Returns the remedy of a step that was found.
fn describe(model: &SampledModel, moves: &Moves, nearest: &Nearest) -> Remedy {
    let length = nearest.step.norm();
    let amount = if moves.part == Part::Axis {
        length.to_degrees()
    } else {
        length
    };
    let change = Change {
        amount,
        settings: settings(model, moves.part, nearest),
        words: words(moves, nearest),
    };
    Remedy::helping(kind(moves.part), change, &nearest.trial)
}

fn words(moves: &Moves, nearest: &Nearest) -> String {
    let length = nearest.step.norm();
    let towards = direction_words(&moves.frame.direction_to_model(&nearest.step));
    let (distance, angle) = (show_mm(length), length.to_degrees());
    let contact = match (moves.part, nearest.request.contact) {
        (Part::Contact, _) => return format!("move the contact point {distance} toward {towards}"),
        (Part::SpinPoint, _) => return format!("move the spin point {distance} toward {towards}"),
        (Part::Axis, Some(Contact::Lowest)) => ", with the contact at the model's new lowest point",
        (Part::Axis, Some(Contact::Center)) => ", with the contact below the centre of mass",
        (Part::Axis, _) => "",
    };
    let up = nearest.request.up.direction();
    let nearly = up.and_then(|up| nearly_words(&up));
    let nearly = nearly.map_or(String::new(), |axis| format!(", so that it is {axis}"));
    format!("tilt the axis by {angle:.1}° toward {towards}{nearly}{contact}")
}

/// Returns the options for a moved part, and for the tip that it needs.
fn settings(model: &SampledModel, part: Part, nearest: &Nearest) -> Vec<Setting> {
    let moved = moved(part, &nearest.request);
    let footing = nearest.trial.placement.footing.as_ref();
    let is_new = footing.is_some_and(|footing| footing.tip().is_some())
        && model.case.request.tip == TipChoice::None;
    let tip = is_new.then(|| Setting::new(Key::Tip, TipChoice::Auto));
    moved.into_iter().chain(tip).collect()
}

fn moved(part: Part, request: &Request) -> Vec<Setting> {
    let up = Setting::new(Key::Up, request.up);
    match (part, request.contact, request.spin_point) {
        (Part::Contact, Some(contact), _) => vec![Setting::new(Key::Contact, contact)],
        (Part::SpinPoint, _, Some(point)) => vec![Setting::new(Key::SpinPoint, point)],
        (_, Some(Contact::Center), _) => vec![up, Setting::new(Key::Contact, Contact::Center)],
        _ => vec![up],
    }
}
