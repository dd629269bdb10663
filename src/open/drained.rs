//! One piece with drain holes: the voids stay empty, and nothing is cut.

use super::clean::{Keep, keep_solid};
use super::request::request;
use super::resolve::Resolver;
use super::way::Candidate;
use crate::base::units::format_count;
use crate::base::watch::Watch;
use crate::cut::{self, CutPlan, Drained, PlanRequest, VoidId, find_hollow_cups};
use crate::error::{CellsError, DrainError, Error};
use crate::goal::FloatConditions;
use crate::job::DrainOrder;
use crate::mass::Moments;
use crate::printer::DrainNeed;
use crate::run::{KeptCause, KeptSolid, Opened, Placed, Rung, Solved, Voids};

/// Excess of a mass over what floats that is more than rounding.
const HEAVY_RATIO: f64 = 1e-4;

/// Draws the voids of a solution and drains them through holes in the wall.
///
/// Voids that have no place for holes are kept solid, and so are ends of voids that would catch
/// resin in a vat. The rest is solved for again.
///
/// # Errors
/// No hole empties the voids of this printer or goal, the voids cannot be drawn, or the watch was
/// stopped.
pub fn drained<'a>(
    placed: &'a Placed,
    solved: Solved,
    watch: &Watch,
) -> Result<Candidate<'a>, Error> {
    let request = request(placed, watch)?;
    let mut resolver = Resolver::new(placed, solved, watch)?;
    let mut voids = resolver.draw()?;
    let mut cleaning = Vec::new();
    let mut plan = CutPlan::uncut(&voids.hollowed);
    if !voids.hollowed.voids.is_empty() {
        let need = need(placed, &voids)?;
        loop {
            watch.check()?;
            let found = cut::drain(&voids.hollowed, &request, &need)?;
            let rest = find_undrained(placed, &voids, &found, &request)?;
            let is_last = cleaning.len() == placed.policy.cleaning_rounds;
            if rest.bodies.is_empty() || is_last {
                refuse_closed(placed, &found, &need)?;
                plan = found.plan;
                break;
            }
            let lost: Vec<VoidId> = rest.kept.iter().map(|kept| kept.void).collect();
            let (round, less) = keep_solid(&mut resolver, &voids, rest, &|_| false)?;
            cleaning.push(round);
            let Some(less) = less else {
                refuse_closed(placed, &found, &need)?;
                plan = found.plan;
                break;
            };
            voids = resolver.correct(less, Moments::default())?;
            if sinks(placed, &voids) {
                return Err(no_place(placed, &lost, &need));
            }
        }
    }
    Ok(Candidate {
        opened: Opened {
            voids,
            plan,
            request,
            rung: Rung::Walls,
            remarks: Vec::new(),
            cleaning,
            bosses: Vec::new(),
        },
        resolver,
    })
}

/// Places the holes of a piece again, whose voids have changed.
///
/// # Errors
/// No hole empties the voids of this printer or goal, or a boolean failed.
pub fn drain_again(
    placed: &Placed,
    voids: &Voids,
    request: &PlanRequest,
) -> Result<CutPlan, Error> {
    let need = need(placed, voids)?;
    let found = cut::drain(&voids.hollowed, request, &need)?;
    refuse_closed(placed, &found, &need)?;
    Ok(found.plan)
}

/// Returns the holes that each void needs.
fn need(placed: &Placed, voids: &Voids) -> Result<DrainNeed, DrainError> {
    let holds_part = |void: &cut::Void| void.holds.is_some();
    if voids.hollowed.voids.iter().any(holds_part) {
        return Err(DrainError::Ballast);
    }
    let (printer, order) = (&placed.shop.printer, placed.job.drain);
    if order == DrainOrder::Never {
        let voids = format_count(voids.hollowed.voids.len(), "void");
        return Err(DrainError::Closed { voids });
    }
    let need = printer.drain_need(order.asked_mm());
    let need = need.map_err(|why| DrainError::of_printer(why, &printer.name, order))?;
    Ok(DrainNeed {
        plug_gap_mm: placed.job.plugs.then(|| printer.snug_gap_mm()),
        printed_up: placed.printed_up().map(Into::into),
        ..need
    })
}

/// Finds what must be kept solid: voids without holes, else what would catch resin.
fn find_undrained(
    placed: &Placed,
    voids: &Voids,
    found: &Drained,
    request: &PlanRequest,
) -> Result<Keep, Error> {
    let policy = &placed.policy;
    if !found.closed.is_empty() {
        let body = |void: &VoidId| voids.hollowed.voids[void.index()].mesh().clone();
        let kept = |&void: &VoidId| KeptSolid {
            void,
            cause: KeptCause::Undrainable,
        };
        return Ok(Keep {
            bodies: found.closed.iter().map(body).collect(),
            kept: found.closed.iter().map(kept).collect(),
            margin_openings: policy.refused_margin_openings,
        });
    }
    let cups = find_hollow_cups(&voids.hollowed, &found.plan, request)?;
    let kept = |cup: &cut::HollowCup| KeptSolid {
        void: cup.void,
        cause: KeptCause::Cup {
            volume_mm3: cup.volume_mm3,
        },
    };
    Ok(Keep {
        kept: cups.iter().map(kept).collect(),
        bodies: cups.into_iter().map(|cup| cup.body).collect(),
        margin_openings: policy.cleaning_margin_openings,
    })
}

/// Refuses a piece whose voids do not all have holes.
fn refuse_closed(placed: &Placed, found: &Drained, need: &DrainNeed) -> Result<(), Error> {
    if found.closed.is_empty() {
        return Ok(());
    }
    Err(no_place(placed, &found.closed, need))
}

/// Returns the error that these voids have no place for their holes.
fn no_place(placed: &Placed, voids: &[VoidId], need: &DrainNeed) -> Error {
    let voids: Vec<String> = voids.iter().map(VoidId::to_string).collect();
    let (voids, diameter_mm) = (voids.join(", "), need.diameter_mm);
    if placed.cells.is_some() {
        return CellsError::NoPlace { voids, diameter_mm }.into();
    }
    let is_asked = placed.job.drain.asked_mm().is_some();
    Error::Drain(DrainError::NoPlace {
        voids,
        diameter_mm,
        is_asked,
    })
}

/// Returns whether what should float has no void left, and is heavier than what it displaces.
fn sinks(placed: &Placed, voids: &Voids) -> bool {
    let goal = placed.goal();
    let is_heavy =
        |afloat: &FloatConditions| goal.solid.volume() > afloat.material_mm3 * (1.0 + HEAVY_RATIO);
    voids.hollowed.voids.is_empty() && goal.afloat.as_ref().is_some_and(is_heavy)
}
