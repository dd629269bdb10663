//! Hardware: put into the model before anything is solved.

use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::hardware::{Allowances, fit_hardware};
use crate::mass::moments_of_mesh;
use crate::run::Placed;

/// Puts the job's hardware into the model: its sockets, its masses, and a yo-yo's halves apart.
///
/// The goal's moments count from then on what is not printed.
pub fn fit(placed: Placed, watch: &Watch) -> Result<Placed, Error> {
    let Some(hardware) = placed.request.hardware else {
        return Ok(placed);
    };
    watch.enter(Phase::Hardware);
    let allowances = Allowances {
        clearance_mm: placed.shop.printer.clearance_per_side_mm.value,
        wall_mm: placed.shop.wall.wall_mm,
    };
    let (solid, goal) = (&placed.model.solid, placed.goal());
    let fitted = fit_hardware(solid, goal, &hardware, &allowances)?;
    watch.check()?;
    if fitted.is_none() {
        return Ok(placed);
    }
    let mut placed = Placed { fitted, ..placed };
    let whole = moments_of_mesh(placed.solid().mesh()) + placed.hardware_moments();
    placed.placement.goal.solid = whole.in_frame(&placed.goal().frame);
    Ok(placed)
}
