//! Hardware: put into the model before anything is solved.

use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::goal::{Footing, PrintStock, Request, TipChoice, place_in_material};
use crate::hardware::{Allowances, FitError, Fitted, fit_hardware};
use crate::mass::moments_of_mesh;
use crate::run::Placed;

/// Puts the job's hardware and the tip of a top into the model: sockets, masses, and a yo-yo's
/// halves apart.
///
/// A stock tip that does not fit its socket gives way to the next. The goal's moments count from
/// then on what is not printed.
pub fn fit(placed: Placed, watch: &Watch) -> Result<Placed, Error> {
    if placed.hardware().is_empty() {
        return Ok(placed);
    }
    watch.enter(Phase::Hardware);
    let mut placed = placed;
    let fitted = loop {
        watch.check()?;
        let fitted = fit_as_placed(&placed);
        let spare = match &fitted {
            Err(FitError::Seat(_)) => spare(&placed)?,
            _ => None,
        };
        match spare {
            Some(spare) => placed = spare,
            None => break fitted?,
        }
    };
    watch.check()?;
    let mut placed = Placed { fitted, ..placed };
    let whole = moments_of_mesh(placed.solid().mesh()) + placed.hardware_moments();
    placed.placement.goal.solid = whole.in_frame(&placed.goal().frame);
    Ok(placed)
}

fn fit_as_placed(placed: &Placed) -> Result<Option<Fitted>, FitError> {
    let allowances = Allowances {
        clearance_mm: placed.shop.printer.clearance_per_side_mm.value,
        wall_mm: placed.shop.wall.wall_mm,
    };
    let (solid, goal) = (&placed.model.solid, placed.goal());
    fit_hardware(solid, goal, &placed.hardware(), &allowances)
}

/// Returns the top placed on its next spare tip, `None` if it has none.
fn spare(placed: &Placed) -> Result<Option<Placed>, Error> {
    let Some(Footing::Tip { spares, .. }) = &placed.placement.footing else {
        return Ok(None);
    };
    let Some((next, rest)) = spares.split_first() else {
        return Ok(None);
    };
    let request = Request {
        tip: TipChoice::Rod(*next),
        ..placed.request
    };
    let stock = PrintStock {
        wall_mm: placed.shop.wall.wall_mm,
        density_g_cm3: placed.density_g_cm3(),
    };
    let mut placement = place_in_material(&placed.model.solid, &stock, &request)?;
    if let Some(Footing::Tip { spares, .. }) = &mut placement.footing {
        *spares = rest.to_vec();
    }
    Ok(Some(Placed {
        placement,
        ..placed.clone()
    }))
}
