//! Warnings and notes: the remarks of a run in words.

use super::facts::Facts;
use super::foot::flat_foot;
use super::hardware::shallow_axle;
use super::joints::{is_shown_at_its_step, warn_of_joints};
use super::parts::is_printed_in_vat;
use super::printer::{enlargement, scale_note};
use super::promise::aim;
use super::voids::cells_order;
use crate::base::numbers::{measured, number};
use crate::base::units::{MM3_PER_CM3, format_count};
use crate::cut::{self, PartId};
use crate::goal::GoalKind;
use crate::run::{Remark, WrittenPart};
use crate::sheet::FootRow;
use crate::verify::{JointFacts, RotorOrder};

/// Least volume left solid that gets a note, mm³: less would be shown as zero.
const LEAST_REPORTED_MM3: f64 = 0.05;

/// Warning for all that floats.
const SEAL: &str = "seal every joint: a void that fills with water sinks it or turns it over";

/// Warning for all that floats, if the density was not measured.
const UNWEIGHED: &str = "how deep it floats depends on a density that was not measured. Weigh coupons \
    (equipoise coupon) and prepare again. A part that is 1 % too heavy takes 1 % more water";

/// Returns the warnings for the shop.
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
    let thick = placed.model.thickened.as_ref().map(|thick| {
        format!(
            "thin features of the model were thickened, as asked: its surface moved outward by up to {}, and {} were added",
            measured(thick.moved_mm, "mm"),
            measured(thick.added_mm3, "mm³")
        )
    });
    let floats = placed.placement.goal.kind == GoalKind::Float;
    let seal = floats.then(|| SEAL.to_owned());
    let unweighed = (floats && !placed.shop.material.is_measured()).then(|| UNWEIGHED.to_owned());
    let warnings = placement
        .chain(repairs)
        .chain(thick)
        .chain(seal)
        .chain(unweighed)
        .chain(shallow_axle(placed));
    let warnings = warnings.chain(small_parts(facts)).chain(slack(facts));
    warnings.chain(warn_of_joints(facts.made)).collect()
}

/// Returns a warning of the joints of a rotor whose play can cost more than its grade; `None`
/// without any.
fn slack(facts: &Facts) -> Option<String> {
    let order = aim(facts.placed).rotor?;
    warn_of_slack(
        &facts.judgement.joints,
        &order,
        facts.judgement.assembly.mass_g,
    )
}

/// Warns of joints whose play can leave more than a grade allows to a rotor of this mass.
fn warn_of_slack(joints: &[JointFacts], order: &RotorOrder, mass_g: f64) -> Option<String> {
    let allowed_g_mm = order.allowed_g_mm(mass_g);
    let left = |joint: &JointFacts| Some((joint.id.clone(), joint.unbalance_g_mm?));
    let (ids, left_g_mm): (Vec<String>, Vec<f64>) = joints.iter().filter_map(left).unzip();
    // All joints may shift the same way.
    let all_g_mm: f64 = left_g_mm.iter().sum();
    (all_g_mm > allowed_g_mm).then(|| {
        format!(
            "{}: a shift in the joint can leave an unbalance of {} at one end of the axis, and \
             grade G\u{a0}{} allows {}. Balance the rotor on a machine once it is glued",
            ids.join(", "),
            measured(all_g_mm, "g·mm"),
            number(order.grade_mm_s),
            measured(allowed_g_mm, "g·mm")
        )
    })
}

/// Returns a warning for each part that is lighter than the least that was asked for.
fn small_parts(facts: &Facts) -> Vec<String> {
    let density_g_mm3 = facts.placed.shop.material.density_g_mm3();
    let parts = facts.made.parts.iter();
    let mass_g = |part: &WrittenPart| part.read_back.signed_volume_mm3() * density_g_mm3;
    let masses: Vec<(PartId, f64)> = parts.map(|part| (part.part.id, mass_g(part))).collect();
    warn_of_small(&masses, facts.placed.job.least_part.mass_ratio())
}

/// Warns of parts lighter than this share of all, g.
fn warn_of_small(masses_g: &[(PartId, f64)], least_ratio: f64) -> Vec<String> {
    let whole_g: f64 = masses_g.iter().map(|(_, mass_g)| mass_g).sum();
    let small = masses_g
        .iter()
        .filter(|(_, mass_g)| *mass_g < least_ratio * whole_g);
    let words = small.map(|(id, mass_g)| {
        format!(
            "{id} weighs only {} ({:.1} % of all): do not lose it",
            measured(*mass_g, "g"),
            100.0 * mass_g / whole_g
        )
    });
    words.collect()
}

/// Words the volume that stays solid for cleaning; `None` if there is next to none.
fn left_solid(facts: &Facts) -> Option<String> {
    let refused = facts.made.refused_mm3;
    let by_plan = facts.made.cleaning.iter().any(|round| round.by_plan);
    let why = match (is_printed_in_vat(facts.placed), by_plan) {
        _ if facts.placed.sparse.is_some() => "because it is too narrow for infill",
        (false, false) => "because it could not be cleaned",
        (true, false) => "because it could not be drained or cleaned",
        (false, true) => "because it could not be cleaned or because the plan keeps it solid",
        (true, true) => {
            "because it could not be drained or cleaned or because the plan keeps it solid"
        }
    };
    (refused >= LEAST_REPORTED_MM3).then(|| {
        format!(
            "{} is left solid, {why}; it is counted already, and nothing needs to be done",
            measured(refused / MM3_PER_CM3, "cm³")
        )
    })
}

/// Words the cells inside of a piece, and how to know that they are empty; `None` without cells.
fn cells(facts: &Facts) -> Option<String> {
    let order = cells_order(facts.placed, facts.made)?;
    Some(format!(
        "{} of about {} inside, between walls of {} with {} of {}: {} drain. Weigh the cleaned \
         piece: a full cell makes it heavier than the sheet says",
        format_count(order.places_mm.len(), "cell"),
        measured(order.size_mm, "mm"),
        measured(order.wall_mm, "mm"),
        format_count(order.openings_mm.len(), "opening"),
        measured(order.opening_mm, "mm"),
        measured(order.drained_mm3 / MM3_PER_CM3, "cm³"),
    ))
}

/// Returns the offers of other plans.
pub fn offers(facts: &Facts) -> Vec<String> {
    let remarks = facts.made.remarks.iter();
    let offers = remarks.filter(|remark| remark.is_offer());
    offers.map(ToString::to_string).collect()
}

/// Returns notes on the wall, on the scale of the files, on cuts and pins.
///
/// Remarks on single joints stand in the rows of these joints, and offers on the cover.
pub fn notes(facts: &Facts) -> Vec<String> {
    let Facts { placed, made, .. } = facts;
    let wall = placed.shop.wall.why.clone();
    let scale = enlargement(placed.shop.printer.print_scale_ratio()).map(scale_note);
    let is_general = |note: &&cut::Remark| !is_shown_at_its_step(note);
    let planned = made.plan.notes.iter().filter(is_general);
    let planned = planned.map(ToString::to_string);
    let is_told = |remark: &&Remark| matches!(remark, Remark::NoBosses { .. }) || remark.is_offer();
    let remarks = made.remarks.iter().filter(|remark| !is_told(remark));
    let remarks = remarks.map(ToString::to_string);
    let all = std::iter::once(wall)
        .chain(cells(facts))
        .chain(scale)
        .chain(left_solid(facts))
        .chain(planned);
    all.chain(remarks).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_below_the_least_is_told_with_its_share() {
        let masses = [(PartId::of(0), 0.35), (PartId::of(1), 24.65)];
        let said = warn_of_small(&masses, 0.02)
            .join(";")
            .replace('\u{a0}', " ");
        assert_eq!(
            said,
            "P01 weighs only 0.35 g (1.4 % of all): do not lose it"
        );
        assert!(warn_of_small(&masses, 0.01).is_empty());
    }

    #[test]
    fn joints_whose_play_costs_more_than_the_grade_are_told_with_both_figures() {
        let joint = |id: &str, unbalance_g_mm| JointFacts {
            id: id.to_owned(),
            play: None,
            unbalance_g_mm,
        };
        let order = RotorOrder {
            speed_rpm: 3000.0,
            grade_mm_s: 6.3,
        };
        let joints = [
            joint("J1", Some(0.9)),
            joint("J2", Some(0.2)),
            joint("J3", None),
        ];
        // G 6.3 at 3000 rpm allows 1.0027 g·mm to 100 g, in each of two planes.
        let said = warn_of_slack(&joints, &order, 100.0).unwrap();
        let said = said.replace('\u{a0}', " ");
        assert!(
            said.starts_with("J1, J2: a shift in the joint can leave an unbalance of 1.1"),
            "{said}"
        );
        assert!(said.contains("grade G 6.3 allows 1 g·mm"), "{said}");
        assert_eq!(warn_of_slack(&joints[..1], &order, 100.0), None);
    }
}
