//! The request for cuts and pins of a placed goal.

use crate::base::watch::Watch;
use crate::cut::{GoalAxis, PlanRequest};
use crate::run::Placed;

/// Returns what cuts, pins and parts must keep to for this job on its printer.
pub fn request(placed: &Placed, watch: &Watch) -> PlanRequest {
    let frame = &placed.goal().frame;
    let axis = GoalAxis {
        point: frame.origin,
        direction: frame.axis(),
    };
    let size_mm = placed.solid().mesh().longest_side_mm();
    let usual = PlanRequest::for_printer(&placed.shop.printer, size_mm, axis);
    PlanRequest {
        worth_ratio: placed.policy.cut_worth_ratio,
        rods: placed.shop.rods.clone(),
        labels: usual.labels.filter(|_| placed.job.ids.is_engraved()),
        watch: watch.clone(),
        ..usual
    }
}
