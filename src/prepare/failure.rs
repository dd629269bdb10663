//! A kit that breaks a promise: the reason, and what surely helps.

use super::advise::case;
use super::hints::{can_thicken, hint};
use super::outcome::{Failure, Prepared};
use super::reason::{is_out_of_reach, reason};
use crate::advice::{self, Kind, Remedy};
use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Phase, Watch};
use crate::error::Error;
use crate::goal::{
    Contact, PrintStock, Request, TipChoice, Up, Water, Waterline, place_in_material,
};
use crate::run::Placed;
use crate::verify::{Check, CheckKind, FigureName};

/// Steps of a degree in which a smaller promise is advised: it is rounded down to tenths.
const PROMISES_PER_DEG: f64 = 10.0;
/// The least promise that is offered, degrees: with less, an object falls at a touch.
const LEAST_PROMISE_DEG: f64 = 1.0;

/// Adds the reason why a kit breaks a promise, and what helps.
pub fn on_failure(placed: &Placed, prepared: Prepared, watch: &Watch) -> Result<Prepared, Error> {
    if prepared.passes() {
        return Ok(prepared);
    }
    watch.enter(Phase::Advise);
    let checks = prepared.checklist.checks.iter();
    let broken: Vec<&Check> = checks.filter(|check| !check.pass).collect();
    let mut hints: Vec<String> = Vec::new();
    for kind in broken.iter().map(|check| &check.kind) {
        let Some(hint) = hint(kind).filter(|hint| !hints.contains(hint)) else {
            continue;
        };
        if is_new(placed, kind) && does_help(placed, kind, watch)? {
            hints.push(hint);
        }
    }
    hints.extend(longer_tip(placed, &broken));
    hints.extend(broken.iter().copied().find_map(smaller_promise));
    let is_plain = placed.job.is_plain();
    let falls_over = broken.iter().any(|check| check.kind == CheckKind::Standing);
    let failure = Failure {
        reason: reason(&prepared, &broken),
        hints,
        // The search knows of air only.
        remedies: if falls_over && is_plain && is_out_of_reach(&prepared, &broken) {
            firmer(placed, watch)?
        } else {
            Vec::new()
        },
    };
    Ok(Prepared {
        failure: Some(failure),
        ..prepared
    })
}

/// Names the stock tip that keeps the promise of a top on a given tip that breaks it.
fn longer_tip(placed: &Placed, broken: &[&Check]) -> Option<String> {
    let is_contact = |check: &&Check| check.kind == CheckKind::Contact;
    placed.request.ordered_tip().rod()?;
    broken.iter().copied().find(|check| is_contact(check))?;
    let request = Request {
        tip: TipChoice::Auto,
        hardware: Some(placed.request.hardware_with(None)),
        ..placed.request
    };
    let stock = PrintStock {
        wall_mm: placed.shop.wall.wall_mm,
        density_g_cm3: placed.density_g_cm3(),
    };
    let placement = place_in_material(&placed.model.solid, &stock, &request).ok()?;
    let pin = placement.footing?.tip()?;
    let setting = Setting::new(Key::Tip, pin);
    Some(format!("take a longer tip (`{setting}`)"))
}

/// Names the promise that a standing object, or a top on its foot, keeps as it is.
fn smaller_promise(broken: &Check) -> Option<String> {
    let key = match broken.kind {
        CheckKind::Standing => Key::LeastAngle,
        CheckKind::Lean => Key::LeastLean,
        _ => return None,
    };
    let kept_deg = (broken.value? * PROMISES_PER_DEG).floor() / PROMISES_PER_DEG;
    let setting = Setting::new(key, kept_deg);
    (kept_deg >= LEAST_PROMISE_DEG).then(|| format!("promise no more than it keeps (`{setting}`)"))
}

/// Returns the request that a hint for a broken check calls for; `None` if the hint changes none.
fn hinted_request(placed: &Placed, kind: &CheckKind) -> Option<Request> {
    let request = placed.request;
    match kind {
        CheckKind::Contact | CheckKind::Lean => Some(Request {
            contact: Some(Contact::Center),
            tip: TipChoice::Auto,
            hardware: Some(request.hardware_with(None)),
            ..request
        }),
        CheckKind::Dominance
        | CheckKind::PromisedFigure {
            figure: FigureName::DominanceRatio,
        } => Some(Request {
            up: Up::Principal,
            ..request
        }),
        CheckKind::Waterline => Some(Request {
            water: request.water.map(|water| Water {
                waterline: Waterline::Auto,
                ..water
            }),
            ..request
        }),
        _ => None,
    }
}

/// Returns false if a hint for a broken check repeats what the job has.
fn is_new(placed: &Placed, kind: &CheckKind) -> bool {
    let hinted = hinted_request(placed, kind);
    let is_tipped = placed.request.contact == Some(Contact::Center)
        && placed.request.ordered_tip() == TipChoice::Auto;
    match kind {
        CheckKind::Contact | CheckKind::Lean => !is_tipped,
        CheckKind::SocketWall => placed.job.pins.is_printed(),
        CheckKind::ThinFeatures | CheckKind::ThinNecks => !placed.job.thicken,
        _ => hinted != Some(placed.request),
    }
}

/// Returns whether the change that a hint calls for was tried on proxies and keeps its promises.
/// What only a whole kit can show, such as room for pins, counts as untried and is kept.
fn does_help(placed: &Placed, kind: &CheckKind, watch: &Watch) -> Result<bool, Cancelled> {
    if matches!(kind, CheckKind::ThinFeatures | CheckKind::ThinNecks) {
        return can_thicken(placed, watch);
    }
    let Some(request) = hinted_request(placed, kind) else {
        return Ok(true);
    };
    let case = case(&placed.model, &placed.shop, request, placed.fill);
    advice::keeps_promises(&case, watch)
}

/// Returns what surely makes the object stand as promised: another size, wall or face.
fn firmer(placed: &Placed, watch: &Watch) -> Result<Vec<Remedy>, Cancelled> {
    let case = case(&placed.model, &placed.shop, placed.request, placed.fill);
    let found = advice::remedies(&case, watch)?.into_iter();
    // Ballast is laid in only where nothing stands at all.
    let is_firmer = |remedy: &Remedy| remedy.kind != Kind::LeastBallast && remedy.helps();
    Ok(found.filter(is_firmer).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::Limit;

    #[test]
    fn no_promise_of_less_than_a_degree_is_offered() {
        let standing = |reached_deg: f64| {
            let limit = Limit::at_least(5.0, "°");
            Check::new(CheckKind::Standing, "it stands", Some(reached_deg), limit)
        };
        let offered = smaller_promise(&standing(2.87)).unwrap();
        assert!(offered.contains("2.8"), "{offered}");
        assert!(smaller_promise(&standing(1.02)).is_some());
        for reached_deg in [0.99, 0.2, -3.0] {
            assert_eq!(smaller_promise(&standing(reached_deg)), None);
        }
    }
}
