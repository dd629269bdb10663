//! One plan for voids as they are: the planner's, or the one that a person ordered.

use crate::base::verdict::Verdict;
use crate::cut::{self, CutError, CutOrder, CutPlan, Obstacle, PlanRequest, plan_by};
use crate::job::CutMode;
use crate::run::{Placed, Voids};

/// Plans cuts and pins for the voids as they are, in the way that the job asks for.
pub fn plan_once(
    placed: &Placed,
    voids: &Voids,
    request: &PlanRequest,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    let hollowed = &voids.hollowed;
    match (&placed.job.plan, placed.job.cut) {
        (Some(order), _) => match plan_by(hollowed, request, order)? {
            // The pin may stand in a boss that is still to be kept solid.
            Verdict::No(Obstacle::PinOffFace { .. }) => {
                let without_pins = CutOrder {
                    pins: Some(Vec::new()),
                    ..order.clone()
                };
                plan_by(hollowed, request, &without_pins)
            }
            plan => Ok(plan),
        },
        (None, CutMode::Auto) => cut::plan(hollowed, request),
        (None, CutMode::Never) => plan_by(hollowed, request, &CutOrder::default()),
    }
}

/// Returns whether every void of a plan is clean by the printer's rule.
///
/// The planner's own margin is not asked: to solve again for it costs more than any boss.
pub fn are_clean(plan: &CutPlan, request: &PlanRequest) -> bool {
    let mut voids = plan.voids.iter();
    voids.all(|void| void.is_clean_without_margin(request))
}
