//! Joints that nothing aligns: neither pins nor a jig.

use crate::cut::{CutError, CutPlan, PlanRequest, jigs};
use crate::run::Voids;

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
