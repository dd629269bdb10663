//! Joints that nothing aligns: neither pins nor a jig.

use crate::cut::{CutError, CutPlan, PlanRequest, jigs};
use crate::run::{Opened, Voids};

/// Counts the joints of a plan that neither pins nor a jig align.
pub fn count_unaligned(
    voids: &Voids,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<usize, CutError> {
    let without_pins = plan.joints.iter().filter(|joint| !joint.is_aligned());
    let jigs = jigs(&voids.hollowed, plan, request)?;
    Ok(without_pins.count().saturating_sub(jigs.len()))
}

/// Counts those of a plan with its voids.
pub fn count_unaligned_of(opened: &Opened) -> Result<usize, CutError> {
    count_unaligned(&opened.voids, &opened.plan, &opened.request)
}
