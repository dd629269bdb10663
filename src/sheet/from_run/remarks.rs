//! Warnings and notes: the remarks of a run in words.

use super::facts::Facts;
use super::foot::flat_foot;
use super::hardware::shallow_axle;
use super::joints::{is_told_in_a_step, joints_to_mind};
use super::printer::{scale_note, scaled};
use crate::cut;
use crate::goal::GoalKind;
use crate::run::Remark;
use crate::sheet::FootRow;

/// Less than this left solid is not worth a warning, mm³: it would be told as nothing.
const LEAST_TOLD_MM3: f64 = 0.05;

/// What must be minded of anything hollow in water.
const SEAL: &str = "seal every joint: a void that fills with water sinks it or turns it over";

/// What must be minded of anything that floats, if its density was not measured.
const UNWEIGHED: &str = "how deep it floats rests on a density that was not measured: weigh coupons \
    (equipoise coupon) and prepare again; every part too heavy by 1 % takes 1 % more water";

/// Returns what the shop must mind.
pub fn warnings(facts: &Facts, foot: Option<&FootRow>) -> Vec<String> {
    let placed = facts.placed;
    let foot = foot.map(flat_foot);
    let placement = placed
        .placement
        .warnings
        .iter()
        .chain(&foot)
        .map(ToString::to_string);
    let repairs = placed.model.repairs.notable();
    let repairs = (!repairs.is_empty()).then(|| format!("the model was repaired: {repairs}"));
    let refused = facts.made.refused_mm3;
    let which = if facts.made.cleaning.iter().any(|round| round.by_plan) {
        "that could not be cleaned, or that the plan keeps solid,"
    } else {
        "that could not be cleaned"
    };
    let small = (refused >= LEAST_TOLD_MM3)
        .then(|| format!("{refused:.1} mm³ of voids {which} stay solid"));
    let floats = placed.placement.goal.kind == GoalKind::Float;
    let seal = floats.then(|| SEAL.to_owned());
    let unweighed = (floats && !placed.shop.material.is_measured()).then(|| UNWEIGHED.to_owned());
    let told = placement
        .chain(repairs)
        .chain(small)
        .chain(seal)
        .chain(unweighed)
        .chain(shallow_axle(placed));
    told.chain(joints_to_mind(&facts.made.plan)).collect()
}

/// Returns what a person should know: of the wall, of the files' scale, of cuts and pins.
///
/// Remarks on single joints stand in the rows of these joints.
pub fn notes(facts: &Facts) -> Vec<String> {
    let Facts { placed, made, .. } = facts;
    let wall = placed.shop.wall.why.clone();
    let scale = scaled(placed.shop.printer.print_scale_ratio()).map(scale_note);
    let is_general = |note: &&cut::Remark| !is_told_in_a_step(note);
    let planned = made.plan.notes.iter().filter(is_general);
    let planned = planned.map(ToString::to_string);
    let is_of_joint = |remark: &&Remark| matches!(remark, Remark::NoBosses { .. });
    let remarks = made.remarks.iter().filter(|remark| !is_of_joint(remark));
    let remarks = remarks.map(ToString::to_string);
    let all = std::iter::once(wall).chain(scale).chain(planned);
    all.chain(remarks).collect()
}
