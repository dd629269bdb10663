//! Joints that nothing aligns: neither pins nor a jig.

use super::way::Candidate;
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

/// Counts those of the best of several plans.
pub fn count_unaligned_in_best(candidates: &[Candidate]) -> Result<usize, CutError> {
    let best = candidates.first().map(|candidate| &candidate.opened);
    best.map_or(Ok(0), |best| {
        count_unaligned(&best.voids, &best.plan, &best.request)
    })
}
