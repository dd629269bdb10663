//! Plans by tendency: what each asks for, and which are the same.

use crate::cut::{Cut, CutPlan, PlanRequest};
use crate::run::Tendency;

/// Distance up to which two planes are one cut, mm: less than a saw takes away.
const SAME_CUT_MM: f64 = 0.5;
/// Length of the difference of two unit normals up to which their cuts are one: 0.1°.
const SAME_NORMAL: f64 = 2e-3;

/// Score of a part beyond two where few are wanted: as much as a seam half around the model.
const FEW_PARTS_WEIGHT: f64 = 1.5;

/// Weight of walls without sight where few parts are wanted and seams are looked at. A part then
/// weighs as much as a third of all walls. A neck that leaves some of a void solid is cut in place
/// of a body and two arms.
const FEW_PARTS_LACK_WEIGHT: f64 = 4.0;

/// Returns a request of which each part costs more, and no extra cut is made. What stays solid
/// weighs as much as before.
pub fn with_fewer_parts(request: PlanRequest) -> PlanRequest {
    PlanRequest {
        worth_ratio: 1.0,
        part_weight: FEW_PARTS_WEIGHT,
        ..request
    }
}

/// Returns a request with a tendency.
pub fn lean(mut request: PlanRequest, tendency: Tendency) -> PlanRequest {
    let seams = &mut request.seams;
    match tendency {
        Tendency::FewerParts => {
            if seams.skin.is_some() {
                seams.lack_weight = Some(FEW_PARTS_LACK_WEIGHT);
            }
            return with_fewer_parts(request);
        }
        Tendency::Level => seams.only_level = true,
        Tendency::Short => *seams = seams.unseen(),
        _ => {}
    }
    request
}

/// Returns whether two plans have the same cuts, in any order.
pub fn have_same_cuts(one: &CutPlan, other: &CutPlan) -> bool {
    let is_same = |a: &Cut, b: &Cut| {
        let (Ok(a), Ok(b)) = (a.plane(), b.plane()) else {
            return false;
        };
        let sense = a.normal.dot(&b.normal).signum();
        let is_near = (a.offset_mm - sense * b.offset_mm).abs() < SAME_CUT_MM;
        is_near && (a.normal - b.normal * sense).norm() < SAME_NORMAL
    };
    let has = |cut: &Cut| other.cuts.iter().any(|known| is_same(cut, known));
    one.cuts.len() == other.cuts.len() && one.cuts.iter().all(has)
}
