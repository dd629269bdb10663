//! The yo-yo: it spins freely about an axis through a point inside.

use super::error::GoalError;
use super::placement::Placement;
use super::site::Site;
use super::sites::SpinPoint;

pub(super) fn place(site: &Site, spin_point: SpinPoint) -> Result<Placement, GoalError> {
    let origin = match spin_point {
        SpinPoint::Center => site.upright_center(),
        SpinPoint::At(point) => site.locate_point("spin-point", point)?,
    };
    Ok(Placement {
        goal: site.goal_at(&origin, Vec::new()),
        keeps: Vec::new(),
        warnings: Vec::new(),
        footing: None,
    })
}
