//! Place: the goal in the model, with its axis, its waterline and its hardware.

use super::{
    advise, densities, fields, graded, hardware, inner_cells, like, mean, rotor, upright, waterline,
};
use crate::advice::{Case, best_orientation, is_possible};
use crate::base::watch::Watch;
use crate::error::Error;
use crate::goal::{
    Contact, GoalError, GoalKind, MeasuredSolid, Placement, PrintStock, Request, TipChoice, Up,
    place_in_material, spins_on_lowest,
};
use crate::hollow::Fill;
use crate::job::{CutMode, Job};
use crate::run::{AxisChoice, Model, NaturalUp, Placed, Policy, Shop};

/// Places the job's goal in the model and settles what the job leaves open.
pub fn goal(job: &Job, model: Model, shop: Shop, watch: &Watch) -> Result<Placed, Error> {
    let job = &like::resolved(job, &model, watch)?;
    let sparse = graded::sparse_print(job, &shop.printer)?;
    let cells = inner_cells::sizes(job, &model, &shop)?;
    let laid = sparse.as_ref().and_then(densities::fill);
    let laid = laid.or(cells.as_ref().map(inner_cells::fill));
    let filled = || fill(job, shop.material.density_g_cm3.value);
    let fill = laid.map_or_else(filled, Ok)?;
    // The searches know of infill and of cells, and of no fillings.
    let searched = laid.unwrap_or(Fill::AIR);
    let case = |request: Request| advise::case(&model, &shop, request, searched);
    let choice = choose_axis(job, &model, &case(job.goal), watch)?;
    let request = match &choice {
        Some(AxisChoice::Best { request, .. }) => **request,
        Some(AxisChoice::NearNatural { nearby, .. }) => nearby.request,
        Some(AxisChoice::OnShaft(shaft)) => rotor::request_on(&job.goal, shaft),
        Some(AxisChoice::NonePossible { up } | AxisChoice::Natural(NaturalUp { up, .. })) => {
            Request {
                up: *up,
                ..job.goal
            }
        }
        None => job.goal,
    };
    let stock = PrintStock {
        wall_mm: shop.wall.wall_mm,
        density_g_cm3: shop.material.density_g_cm3.value,
    };
    let request = Request {
        contact: choose_contact(job, &case(request), watch)?,
        ..request
    };
    let placement = match place_in_material(&model.solid, &stock, &request) {
        Ok(placement) => placement,
        Err(error) => return Err(upright::advised(error, &case(request), watch)?),
    };
    refuse_air(&request, &placement)?;
    let bound = bound(job, &model, cells.is_some());
    let placed = Placed {
        fill,
        sparse,
        cells: None,
        policy: Policy::with_joint_price(bound.joint_price_ratio).with_effort(bound.effort),
        job: bound,
        model,
        shop,
        request,
        choice,
        placement,
        fitted: None,
    };
    let placed = hardware::fit(waterline::choose(placed, watch)?, watch)?;
    let placed = fields::with_field(mean::with_levels(placed, watch)?, watch)?;
    let placed = inner_cells::with_cells(placed, cells, watch)?;
    graded::refuse_pieces(&placed)?;
    graded::refuse_holes(&placed)?;
    Ok(placed)
}

/// Returns a job bound to the bytes of its model. What is made of cells drains, and is never cut.
fn bound(job: &Job, model: &Model, has_cells: bool) -> Job {
    let mut bound = job.clone();
    bound.model.sha256 = Some(model.sha256.clone());
    if has_cells {
        bound.cut = CutMode::Never;
    }
    bound
}

/// Chooses the axis of a request that leaves it open; `None` if the request names one.
fn choose_axis(
    job: &Job,
    model: &Model,
    case: &Case,
    watch: &Watch,
) -> Result<Option<AxisChoice>, Error> {
    let request = &job.goal;
    if rotor::turns_on_model(request) {
        return rotor::choose(job, model, case, watch).map(Some);
    }
    if request.up == Up::Natural {
        return Ok(Some(upright::choose(job, case, watch)?));
    }
    if request.up != Up::Auto {
        return Ok(None);
    }
    let Some(best) = best_orientation(case, watch)? else {
        let up = if request.kind == GoalKind::Stand {
            Up::Z
        } else {
            Up::Principal
        };
        return Ok(Some(AxisChoice::NonePossible { up }));
    };
    Ok(Some(AxisChoice::Best {
        request: Box::new(best.request),
        tried: best.tried,
        possible: best.possible,
        reached: best.reached,
    }))
}

/// Refuses a top that is ordered without a tip and spins on nothing, whatever lean it waives.
fn refuse_air(request: &Request, placement: &Placement) -> Result<(), GoalError> {
    match placement.air_mm() {
        Some(missing_mm) if request.ordered_tip() == TipChoice::None => {
            Err(GoalError::NothingToSpinOn { missing_mm })
        }
        _ => Ok(()),
    }
}

/// Returns the contact of a request, chosen if it leaves it open.
///
/// It is the lowest point if the top keeps its promise there and some hollowing makes it spin. Else
/// it is below the centre of mass, if that is possible or the lowest point keeps no promise.
fn choose_contact(job: &Job, case: &Case, watch: &Watch) -> Result<Option<Contact>, Error> {
    let request = &case.request;
    if request.contact != Some(Contact::Auto) {
        return Ok(request.contact);
    }
    let lowest = spins_on_lowest(&MeasuredSolid::new(case.solid), case.wall_mm, request)?;
    let is_known = request.ordered_tip() == TipChoice::None || !job.is_unfilled();
    if !lowest || is_known {
        return Ok(Some(if lowest {
            Contact::Lowest
        } else {
            Contact::Center
        }));
    }
    for contact in [Contact::Lowest, Contact::Center] {
        let contact = Some(contact);
        let tried = Case {
            request: Request {
                contact,
                ..*request
            },
            ..*case
        };
        if is_possible(&tried, watch)? {
            return Ok(contact);
        }
    }
    Ok(Some(Contact::Lowest))
}

/// Returns the filling of the voids; an error if it does not go with the rest of the job.
fn fill(job: &Job, density_g_cm3: f64) -> Result<Fill, Error> {
    let Some(filling) = job.fill else {
        return Ok(Fill::AIR);
    };
    if !job.ballast.is_none() {
        return Err(Error::FillAndBallast {
            fill: filling,
            order: job.ballast.clone(),
        });
    }
    let ratio = filling.density_g_cm3() / density_g_cm3;
    let fill = Fill::new(ratio).ok_or(Error::FillLikePrint {
        fill: filling,
        density_g_cm3,
    })?;
    if fill.is_heavier() && job.goal.kind == GoalKind::Balance {
        return Err(Error::HeavyFillInRotor { fill: filling });
    }
    Ok(fill)
}
