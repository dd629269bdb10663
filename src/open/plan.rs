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

/// Drafts cuts for the voids as they are: [`plan_once`] without pins, if the planner chooses.
pub fn draft_once(
    placed: &Placed,
    voids: &Voids,
    request: &PlanRequest,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    if is_planned(placed) {
        cut::draft(&voids.hollowed, request)
    } else {
        plan_once(placed, voids, request)
    }
}

/// Returns the plan of a [`draft_once`] for the same voids.
pub fn finish_once(
    placed: &Placed,
    voids: &Voids,
    request: &PlanRequest,
    draft: CutPlan,
) -> Result<CutPlan, CutError> {
    if is_planned(placed) {
        cut::finish_draft(&voids.hollowed, request, draft)
    } else {
        Ok(draft)
    }
}

/// Returns whether the planner chooses the cuts.
fn is_planned(placed: &Placed) -> bool {
    placed.job.plan.is_none() && placed.job.cut == CutMode::Auto
}

/// Returns whether every void of a plan is clean by the printer's rule.
///
/// The planner's own margin is not asked: to solve again for it costs more than any boss.
pub fn are_clean(plan: &CutPlan, request: &PlanRequest) -> bool {
    let mut voids = plan.voids.iter();
    voids.all(|void| void.is_clean_without_margin(request))
}
