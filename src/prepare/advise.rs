//! Advice: remedies for an impossible goal, and hints for a kit that breaks a promise.

use super::hints::hint;
use super::outcome::{Failure, Impossible, Prepared};
use crate::advice::{self, Case, Kind, Remedy};
use crate::base::numbers::quantity;
use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Phase, Watch};
use crate::error::Error;
use crate::goal::{PrintStock, Request, TipChoice, place_in_material};
use crate::run::{Model, Placed, Shop};
use crate::verify::{Check, CheckKind, FigureName};

/// Hint for models with hardware: remedies are searched for the bare model only.
const BARE: &str =
    "leave the hardware out, to be told by how much the model as it is can or cannot";
/// Steps of a degree in which a smaller promise is advised: it is rounded down to tenths.
const PROMISES_PER_DEG: f64 = 10.0;
/// The hint that helps most goals a little.
const MORE_ROOM: &str = "make it larger with the same wall, or the wall thinner: either leaves the solver more to choose from";

/// Returns the case that advice is sought for.
pub fn case<'a>(model: &'a Model, shop: &Shop, request: Request) -> Case<'a> {
    Case {
        solid: &model.solid,
        request,
        wall_mm: shop.wall.wall_mm,
        least_wall_mm: shop.printer.min_wall_mm.value,
        wall_step_mm: shop.wall.step_mm,
        density_g_cm3: shop.material.density_g_cm3.value,
        greatest_size_mm: shop.printer.max_model_length_mm(),
    }
}

/// Adds what would make an impossible goal possible, each remedy confirmed by a solve.
pub fn remedies(
    placed: &Placed,
    impossible: Impossible,
    watch: &Watch,
) -> Result<Impossible, Error> {
    if placed.job.fill.is_some() {
        // The searches know of air only.
        return Ok(impossible);
    }
    watch.enter(Phase::Advise);
    if placed.has_ordered_hardware() {
        let hints = impossible.hints.into_iter().chain([BARE.to_owned()]);
        return Ok(Impossible {
            hints: hints.collect(),
            ..impossible
        });
    }
    let case = case(&placed.model, &placed.shop, placed.request);
    let remedies = advice::remedies(&case, watch)?;
    let hints = if remedies.iter().any(Remedy::helps) {
        Vec::new()
    } else {
        impossible.hints
    };
    Ok(Impossible {
        remedies,
        hints,
        ..impossible
    })
}

/// Adds the reason why a kit breaks a promise, and what helps.
pub fn on_failure(placed: &Placed, prepared: Prepared, watch: &Watch) -> Result<Prepared, Error> {
    if prepared.passes() {
        return Ok(prepared);
    }
    watch.enter(Phase::Advise);
    let checks = prepared.checklist.checks.iter();
    let broken: Vec<&Check> = checks.filter(|check| !check.pass).collect();
    let mut hints: Vec<String> = Vec::new();
    for hint in broken.iter().filter_map(|check| hint(&check.kind)) {
        if !hints.contains(&hint) {
            hints.push(hint);
        }
    }
    hints.extend(longer_tip(placed, &broken));
    hints.extend(broken.iter().copied().find_map(smaller_promise));
    hints.push(MORE_ROOM.to_owned());
    let falls_over = broken.iter().any(|check| check.kind == CheckKind::Standing);
    let failure = Failure {
        reason: reason(&prepared, &broken),
        hints,
        remedies: if falls_over {
            other_faces(placed, watch)?
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
    let is_contact = |check: &&Check| matches!(check.kind, CheckKind::Contact | CheckKind::Lean);
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
    (kept_deg > 0.0).then(|| format!("promise no more than it keeps (`{setting}`)"))
}

/// Explains what the goal could have reached, and what the parts keep of it.
fn reason(prepared: &Prepared, broken: &[&Check]) -> String {
    let proof = &prepared.checklist.certificate;
    let names: Vec<String> = broken.iter().map(|check| check.kind.to_string()).collect();
    let unit = proof.figure.unit();
    let shaky = broken.iter().find(|check| {
        check.kind == CheckKind::Standing
            && proof.figure == FigureName::TopplesDeg
            && !check.comparison.holds(proof.bound, check.limit)
    });
    if let Some(check) = shaky {
        return format!(
            "it topples too early: no hollowing with this wall reaches more than {}, and {} are promised",
            quantity(proof.bound, unit),
            quantity(check.limit, unit)
        );
    }
    match proof.written_value {
        Some(written) => format!(
            "the kit breaks {}: the best void there is reaches a {} of {}, and of that the parts that can be made keep {}; what \
             pins, cuts and cleaning take is more than there is to spare",
            names.join(", "),
            proof.figure.name(),
            quantity(proof.bound, unit),
            quantity(written, unit)
        ),
        None => format!("the kit breaks {}", names.join(", ")),
    }
}

/// Returns the nearest other faces that the object surely stands on.
fn other_faces(placed: &Placed, watch: &Watch) -> Result<Vec<Remedy>, Cancelled> {
    let case = case(&placed.model, &placed.shop, placed.request);
    let found = advice::remedies(&case, watch)?.into_iter();
    let is_face = |remedy: &Remedy| remedy.kind == Kind::NearestFace && remedy.helps();
    Ok(found.filter(is_face).collect())
}
