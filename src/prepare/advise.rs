//! Advice: remedies for an impossible goal, each carried out before it is reported.

use super::fields::field_hint;
use super::graded::hollow_hint;
use super::materials::material_hints;
use super::outcome::Impossible;
use super::solve::workshop;
use super::thresholds::density_hints;
use crate::advice::{self, Case, Kind, Remedy};
use crate::ballast::{Found, Load, Order, Search};
use crate::base::numbers::quantity;
use crate::base::setting::{Key, Setting};
use crate::base::units::format_count;
use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::goal::{GoalKind, Request};
use crate::hollow::{Certificate, Figure, Fill};
use crate::run::{Model, Placed, Shop};

/// Hint for models with hardware: remedies are searched for the bare model only.
const BARE: &str =
    "leave the hardware out, to be told by how much the model as it is can or cannot";
/// The most balls that are tried before ballast is advised: more take minutes.
const MOST_BALLS: u32 = 3;

/// Returns the case that advice is sought for.
pub fn case<'a>(model: &'a Model, shop: &Shop, request: Request, fill: Fill) -> Case<'a> {
    Case {
        solid: &model.solid,
        request,
        wall_mm: shop.wall.wall_mm,
        least_wall_mm: shop.printer.min_wall_mm.value,
        wall_step_mm: shop.wall.step_mm,
        density_g_cm3: shop.material.density_g_cm3.value,
        greatest_size_mm: shop.printer.max_model_length_mm(),
        fill: (fill != Fill::AIR).then_some(fill),
    }
}

/// Adds what would make an impossible goal possible, each remedy confirmed by a solve.
pub fn remedies(
    placed: &Placed,
    impossible: Impossible,
    watch: &Watch,
) -> Result<Impossible, Error> {
    let is_filled = placed.fill != Fill::AIR && placed.sparse.is_none();
    if is_filled || placed.goal().kind == GoalKind::Match || placed.job.field.is_some() {
        // The searches know of air and of infill, of no fillings, matches and fields.
        let hints = impossible
            .hints
            .into_iter()
            .chain(field_hint(placed, watch)?)
            .chain(density_hints(placed, watch)?)
            .chain(material_hints(placed, watch)?)
            .chain(hollow_hint(placed, watch)?);
        return Ok(Impossible {
            hints: hints.collect(),
            ..impossible
        });
    }
    watch.enter(Phase::Advise);
    if placed.has_ordered_hardware() {
        let hints = impossible.hints.into_iter().chain([BARE.to_owned()]);
        return Ok(Impossible {
            hints: hints.collect(),
            ..impossible
        });
    }
    let case = case(&placed.model, &placed.shop, placed.request, placed.fill);
    let remedies = advice::remedies(&case, watch)?;
    let densities = density_hints(placed, watch)?.into_iter();
    // Every hint of the solver was tried as a remedy.
    Ok(Impossible {
        remedies: with_ballast_carried_out(placed, remedies, watch)?,
        hints: densities.chain(hollow_hint(placed, watch)?).collect(),
        ..impossible
    })
}

/// Lays in the ballast that a remedy calls for, and keeps the remedy only if that does. Drops it if
/// ballast was ordered: that was just refused.
fn with_ballast_carried_out(
    placed: &Placed,
    remedies: Vec<Remedy>,
    watch: &Watch,
) -> Result<Vec<Remedy>, Error> {
    let is_ballast = |remedy: &Remedy| remedy.kind == Kind::LeastBallast;
    let (ballast, mut remedies): (Vec<Remedy>, Vec<Remedy>) =
        remedies.into_iter().partition(is_ballast);
    if !placed.job.ballast.is_none() {
        return Ok(remedies);
    }
    for remedy in ballast {
        let found = if remedy.helps() {
            Search::new(workshop(placed), watch)?.of_few_balls(MOST_BALLS)?
        } else {
            None
        };
        let firm = |found: &Found| stands_as_promised(placed, &found.solution.certificate);
        let found = found.filter(firm);
        remedies.push(match found {
            Some(found) => laid_in(remedy, &found.load),
            None => Remedy::dead_end(Kind::LeastBallast, "steel inside".to_owned()),
        });
    }
    Ok(remedies)
}

/// Returns whether a solution topples no sooner than the job promises.
fn stands_as_promised(placed: &Placed, proof: &Certificate) -> bool {
    let least_deg = placed.request.promised_angle_deg().unwrap_or(0.0);
    proof.figure != Figure::TopplingAngleRad || proof.value.to_degrees() >= least_deg
}

/// Returns the remedy of ballast with the parts that were placed.
fn laid_in(remedy: Remedy, load: &Load) -> Remedy {
    let count = load.parts.len();
    let mass_g: f64 = load.parts.iter().map(|part| part.part.mass_g).sum();
    Remedy {
        amount: Some(mass_g),
        settings: vec![Setting::new(Key::Ballast, Order::Auto)],
        words: format!(
            "add {}, {} in all",
            format_count(count, "steel ball"),
            quantity(mass_g, "g")
        ),
        ..remedy
    }
}
