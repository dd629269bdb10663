//! The natural up of a model, or the axis nearest to it on which the goal is possible.

use crate::advice::{Case, NearbyAxis, name_direction, nearest_orientation};
use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Watch};
use crate::error::Error;
use crate::goal::{GoalError, GoalKind, Request, Up, find_upright};
use crate::job::Job;
use crate::run::{AxisChoice, NaturalUp};

/// Chooses the axis of a job that asks for the natural up.
///
/// Stand and float take it as it is. Tops and yo-yos take the axis nearest to it on which they are
/// possible. With ballast or a filling they take it as it is.
pub fn choose(job: &Job, case: &Case, watch: &Watch) -> Result<AxisChoice, Cancelled> {
    let natural = natural_up(case, watch)?;
    let spins = matches!(job.goal.kind, GoalKind::Top | GoalKind::Yoyo);
    let Some(up) = natural
        .up
        .direction()
        .filter(|_| spins && job.is_unfilled())
    else {
        return Ok(AxisChoice::Natural(natural));
    };
    // A tip that was ordered is held against the axis that would be taken without it. No other axis
    // is taken for a tip that is too short: placing refuses it.
    let waived = Case {
        request: Request {
            least_lean_deg: 0.0,
            ..case.request
        },
        ..*case
    };
    let has_ordered_tip = case.request.ordered_tip().rod().is_some();
    let asked = if has_ordered_tip { &waived } else { case };
    let nearby = nearest_orientation(asked, &up, watch)?.map(|nearby| NearbyAxis {
        request: Request {
            least_lean_deg: case.request.least_lean_deg,
            ..nearby.request
        },
        ..nearby
    });
    Ok(match nearby {
        Some(nearby) if nearby.is_turned() => AxisChoice::NearNatural {
            natural,
            nearby: Box::new(nearby),
        },
        Some(_) => AxisChoice::Natural(natural),
        None => AxisChoice::NonePossible { up: natural.up },
    })
}

fn natural_up(case: &Case, watch: &Watch) -> Result<NaturalUp, Cancelled> {
    let poses = find_upright(case.solid, watch)?;
    Ok(NaturalUp::of(&poses, |pose| name_direction(case, &pose.up)))
}

/// Names the up that helps in the refusal of a model that stands on a point.
pub fn advised(error: GoalError, case: &Case, watch: &Watch) -> Result<Error, Cancelled> {
    let GoalError::NoSupport { up, vertices, .. } = error else {
        return Ok(error.into());
    };
    let natural = natural_up(case, watch)?;
    let instead = match natural.up {
        better if better != up => Setting::new(Key::Up, better),
        _ => Setting::new(Key::Up, Up::Auto),
    };
    Ok(GoalError::NoSupport {
        up,
        vertices,
        instead,
    }
    .into())
}
