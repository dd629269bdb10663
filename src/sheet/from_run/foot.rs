//! The foot of a top that stands on its contact without spinning.

use super::facts::Facts;
use crate::geom::Point;
use crate::goal::{GoalKind, Warning, find_foot_stability};
use crate::sheet::FootRow;

/// Returns how a top stands on its foot without spinning; `None` if it falls over, as tops do.
pub fn foot_row(facts: &Facts) -> Option<FootRow> {
    let (placed, goal) = (facts.placed, &facts.placed.placement.goal);
    if goal.kind != GoalKind::Top {
        return None;
    }
    let mesh = placed.solid().mesh();
    let mut points: Vec<Point> = mesh
        .vertices()
        .iter()
        .map(|p| goal.frame.to_local(p))
        .collect();
    // The end of a tip touches the floor; it is the origin.
    let has_tip = placed.hardware().tip.is_some();
    points.extend(has_tip.then(Point::origin));
    let center = goal
        .frame
        .to_local(&Point::from(facts.judgement.assembly.center_mm));
    find_foot_stability(&points, &center).map(|found| FootRow {
        radius_mm: found.radius_mm,
        center_height_mm: found.center_height_mm,
        rights_to_deg: found.rights_to_deg,
    })
}

/// Returns the warning of such a foot.
pub fn flat_foot(foot: &FootRow) -> Warning {
    let FootRow {
        radius_mm,
        center_height_mm,
        rights_to_deg,
    } = *foot;
    Warning::FlatFoot {
        radius_mm,
        center_height_mm,
        rights_to_deg,
    }
}
