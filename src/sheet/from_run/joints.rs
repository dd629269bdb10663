//! The checklist's rows of how parts are joined.

use std::collections::BTreeMap;

use super::facts::Facts;
use super::figures::shown;
use crate::base::units::MM3_PER_CM3;
use crate::cut::{self, CutPlan, Dowel, JointId, JointNote, RodSource};
use crate::run::{BossRound, KeptBoss, Made, Placed, Remark};
use crate::sheet::{BossRow, CutListRow, JointRow, RoundRow};
use crate::verify::PromisedJoint;

/// What dowels are to be cut, alike ones together, in the order of their rods.
pub fn cut_list(facts: &Facts) -> Vec<CutListRow> {
    let dowels = facts
        .made
        .plan
        .pins
        .iter()
        .filter_map(|pin| pin.dowel.as_ref());
    let mut rows: Vec<CutListRow> = Vec::new();
    for dowel in dowels {
        let alike =
            |row: &&mut CutListRow| row.rod == dowel.rod && row.length_mm == dowel.length_mm;
        match rows.iter_mut().find(alike) {
            Some(row) => row.count += 1,
            None => rows.extend(row_of(facts, dowel)),
        }
    }
    rows
}

fn row_of(facts: &Facts, dowel: &Dowel) -> Option<CutListRow> {
    let rod = facts
        .placed
        .shop
        .rods
        .iter()
        .find(|rod| rod.id == dowel.rod);
    let said = |source: &RodSource| format!("{}: {}", source.sure, source.source);
    let pin = facts
        .made
        .plan
        .pins
        .iter()
        .find(|pin| pin.dowel.as_ref() == Some(dowel))?;
    let bar = pin.dowel_bar()?;
    Some(CutListRow {
        count: 1,
        rod: dowel.rod.clone(),
        name: rod.map_or(dowel.rod.clone(), |rod| rod.name.clone()),
        diameter_mm: pin.diameter_mm,
        length_mm: dowel.length_mm,
        mass_g: bar.moments().volume() * dowel.density_g_cm3 / MM3_PER_CM3,
        sources: rod.map_or(Vec::new(), |rod| {
            [&rod.size_source, &rod.density_source].map(said).to_vec()
        }),
    })
}

/// What is ordered of each joint.
pub fn promised_joints(placed: &Placed, plan: &CutPlan) -> Vec<PromisedJoint> {
    let clearance_mm = placed.shop.printer.clearance_per_side_mm.value;
    let joints = plan.joints.iter().enumerate();
    joints
        .map(|(index, joint)| PromisedJoint {
            id: joint_id(index),
            clearance_mm,
            glue: placed.glue_film(joint),
        })
        .collect()
}

/// The name of the joint with this index.
pub fn joint_id(index: usize) -> String {
    JointId::of(index).to_string()
}

/// The joints of the checklist.
pub fn joint_rows(facts: &Facts) -> Vec<JointRow> {
    let joints = facts.made.plan.joints.iter().enumerate();
    joints
        .map(|(index, joint)| JointRow {
            id: joint_id(index),
            cut: joint.cut.to_string(),
            parts: joint.parts.map(|id| id.to_string()),
            area_mm2: joint.area_mm2,
            pins: joint.pins.len(),
            clearance_mm: facts.placed.shop.printer.clearance_per_side_mm.value,
            glue: facts.placed.glue_film(joint),
            note: to_mind(joint).map(|mind| [refused(facts.made, joint), mind.to_owned()].concat()),
        })
        .collect()
}

/// What to mind of a joint that has not at least two pins that fit one way only.
fn to_mind(joint: &JointNote) -> Option<&'static str> {
    match joint.pins.len() {
        0 => Some("no room for pins: align the outlines by eye and touch"),
        1 => Some("room for one pin only: mind the turn, align the outlines"),
        _ if !joint.one_way => {
            Some("the pins fit in more than one way: mind the turn, align the outlines")
        }
        _ => None,
    }
}

/// Returns why no bosses were made around pins of a joint, to be read before what to mind of it;
/// empty if that was not tried.
fn refused(made: &Made, joint: &JointNote) -> String {
    let why = made.remarks.iter().find_map(|remark| match remark {
        Remark::NoBosses { parts, why } if *parts == joint.parts => Some(why),
        _ => None,
    });
    why.map_or_else(String::new, |why| {
        format!("bosses around pins would {why}; ")
    })
}

/// Whether a note of the plan is told where it is needed: what to mind of a joint in its row, and
/// which parts bear no id at the printing.
pub fn is_told_in_a_step(note: &cut::Remark) -> bool {
    use cut::Remark::{LacksPins, NoRoomForLabel};
    matches!(note, LacksPins { .. } | NoRoomForLabel { .. })
}

/// The joints that are to be minded, in one warning; none where all fit one way only.
pub fn joints_to_mind(plan: &CutPlan) -> Option<String> {
    let minded = plan
        .joints
        .iter()
        .enumerate()
        .filter_map(|(index, joint)| Some((index, to_mind(joint)?)));
    let mut by_what: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    minded.for_each(|(index, what)| by_what.entry(what).or_default().push(joint_id(index)));
    let told: Vec<String> = by_what
        .into_iter()
        .map(|(what, joints)| format!("{}: {what}", joints.join(", ")))
        .collect();
    (!told.is_empty()).then(|| told.join("; "))
}

/// The boss rounds of a run.
pub fn round_rows(facts: &Facts) -> Vec<RoundRow> {
    let row = |(index, round): (usize, &BossRound)| RoundRow {
        round: index + 1,
        bosses: round.bosses.iter().map(boss_row).collect(),
        kept_solid_mm3: round.kept_mm3,
        before: shown(facts.placed, round.before.figure, round.before.value),
        after: shown(facts.placed, round.after.figure, round.after.value),
        gap_ratio: round.after.gap_ratio,
    };
    facts.made.bosses.iter().enumerate().map(row).collect()
}

fn boss_row(boss: &KeptBoss) -> BossRow {
    BossRow {
        pin: boss.pin.id.to_string(),
        parts: boss.parts.map(|id| id.to_string()),
        center_mm: boss.pin.center_mm,
        volume_mm3: boss.volume_mm3,
    }
}

/// What could have been emptied in all bosses, mm³.
pub fn bosses_mm3(facts: &Facts) -> f64 {
    facts.made.bosses.last().map_or(0.0, |round| round.kept_mm3)
}
