//! The axis of a rotor: its bore or its shaft.

use crate::advice::Case;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::geom::Vector;
use crate::goal::{
    GoalError, GoalKind, PrintStock, Request, ShaftAxis, ShaftList, SpinPoint, Up, find_shafts,
    place_in_material,
};
use crate::job::Job;
use crate::run::{AxisChoice, Model};

/// Returns true if a request is for a rotor that turns on what the model has: no bore is ordered.
pub fn turns_on_model(request: &Request) -> bool {
    let has_bore = request.rotor.is_some_and(|rotor| rotor.bore.is_some());
    request.kind == GoalKind::Balance && !has_bore
}

/// Chooses the one bore or shaft on which a rotor turns, and that its request allows.
///
/// # Errors
/// The model has none, several, or none on the axis that was ordered.
pub fn choose(job: &Job, model: &Model, case: &Case, watch: &Watch) -> Result<AxisChoice, Error> {
    let shafts = find_shafts(&model.solid, watch)?;
    if shafts.is_empty() {
        return Err(GoalError::NoShaft.into());
    }
    let stock = PrintStock {
        wall_mm: case.wall_mm,
        density_g_cm3: case.density_g_cm3,
    };
    let fits = |shaft: &ShaftAxis| {
        let request = request_on(&job.goal, shaft);
        let goal = place_in_material(&model.solid, &stock, &request)?.goal;
        Ok(shaft.is_along(&goal.frame.origin, &goal.frame.axis()))
    };
    let mut allowed = Vec::new();
    for shaft in &shafts {
        if fits(shaft).map_err(|error: GoalError| Error::from(error))? {
            allowed.push(shaft.clone());
        }
    }
    match (allowed.pop(), allowed.len()) {
        (Some(only), 0) => Ok(AxisChoice::OnShaft(as_typed(&job.goal, only))),
        (Some(last), _) => {
            allowed.push(last);
            let found = ShaftList(allowed);
            Err(GoalError::SeveralShafts { found }.into())
        }
        (None, _) => {
            let found = ShaftList(shafts);
            Err(GoalError::OffShaft { found }.into())
        }
    }
}

/// Returns the request on a shaft, as far as the request leaves its axis open.
pub fn request_on(request: &Request, shaft: &ShaftAxis) -> Request {
    let is_open = matches!(request.up, Up::Natural | Up::Auto);
    Request {
        up: if is_open { shaft.up() } else { request.up },
        spin_point: match request.spin_point {
            Some(SpinPoint::At(point)) => Some(SpinPoint::At(point)),
            _ => Some(shaft.spin_point()),
        },
        ..*request
    }
}

/// Returns a shaft with the axis that a request names for it, which may differ by a little.
fn as_typed(request: &Request, shaft: ShaftAxis) -> ShaftAxis {
    let on_it = request_on(request, &shaft);
    let direction = on_it.up.direction().unwrap_or(shaft.direction);
    let point = match on_it.spin_point {
        Some(SpinPoint::At(point)) => Vector::from(point).into(),
        _ => shaft.point,
    };
    ShaftAxis {
        direction,
        point,
        ..shaft
    }
}
