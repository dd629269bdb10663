//! The rows of joints, dowels and bosses.

use std::collections::BTreeMap;

use super::facts::Facts;
use super::figures::in_sheet_unit;
use crate::base::units::MM3_PER_CM3;
use crate::cut::{self, Dowel, JointId, JointNote, PRESSED_MM, RodSource};
use crate::run::{BossRound, KeptBoss, Made, Placed, Remark, WrittenJig};
use crate::sheet::{BossRow, CutListRow, JigRow, JointRow, RoundRow};
use crate::verify::{HeldBy, JigFacts, PromisedJig, PromisedJoint};

/// Returns the dowels to cut, equal ones together, in the order of their pins.
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
    let words = |source: &RodSource| format!("{}: {}", source.sure, source.source);
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
            [&rod.size_source, &rod.density_source].map(words).to_vec()
        }),
    })
}

/// Returns the promises of the joints.
pub fn promised_joints(placed: &Placed, made: &Made) -> Vec<PromisedJoint> {
    let clearance_mm = placed.shop.printer.clearance_per_side_mm.value;
    let joints = made.plan.joints.iter().enumerate();
    joints
        .map(|(index, joint)| PromisedJoint {
            id: joint_id(index),
            parts: joint.parts.map(|id| id.to_string()),
            clearance_mm,
            held_by: Some(held_by(made, index)),
            glue: placed.glue_film(joint),
        })
        .collect()
}

/// Returns the name of the joint with this index.
pub fn joint_id(index: usize) -> String {
    JointId::of(index).to_string()
}

/// Returns the rows of the joints.
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
            held_by: held_by(facts.made, index),
            play: facts.judgement.joints[index].play,
            unbalance_g_mm: facts.judgement.joints[index].unbalance_g_mm,
            glue: facts.placed.glue_film(joint),
            note: joint_warning(facts.made, index)
                .map(|warning| [why_no_bosses(facts.made, joint), warning.to_owned()].concat()),
        })
        .collect()
}

/// Returns the warning of a joint that neither pins nor a jig align fully; `None` if they do.
fn joint_warning(made: &Made, index: usize) -> Option<&'static str> {
    match made.jig_of(index) {
        Some(_) => None,
        None => pin_warning(&made.plan.joints[index]),
    }
}

/// Returns the warning of a joint that its pins do not align fully; `None` if they do.
pub fn pin_warning(joint: &JointNote) -> Option<&'static str> {
    match joint.pins.len() {
        0 => Some("no room for pins: align the outlines by eye and touch"),
        1 => Some("room for one pin only: do not turn it, align the outlines"),
        _ if !joint.one_way => Some("the pins fit in more than one way: align the outlines"),
        _ if !joint.held => {
            Some("the pins leave too large a step at the rim: align the outlines by eye and touch")
        }
        _ => None,
    }
}

/// Returns the way in which the parts of a joint are aligned.
fn held_by(made: &Made, index: usize) -> HeldBy {
    if made.plan.joints[index].is_aligned() {
        HeldBy::Pins
    } else if made.jig_of(index).is_some() {
        HeldBy::Jig
    } else {
        HeldBy::Eye
    }
}

/// Returns why no bosses were made around the pins of a joint, to be read before its warning. Empty
/// if bosses were not tried.
fn why_no_bosses(made: &Made, joint: &JointNote) -> String {
    let why = made.remarks.iter().find_map(|remark| match remark {
        Remark::NoBosses { parts, why } if *parts == joint.parts => Some(why),
        _ => None,
    });
    why.map_or_else(String::new, |why| {
        format!("bosses around pins would {why}; ")
    })
}

/// Returns whether a note of the plan appears at its step: in the row of a joint, or where parts
/// without an id are printed.
pub fn is_shown_at_its_step(note: &cut::Remark) -> bool {
    use cut::Remark::{LacksPins, NoRoomForLabel};
    matches!(note, LacksPins { .. } | NoRoomForLabel { .. })
}

/// Returns the warnings of all joints in one sentence; `None` if pins or jigs align every joint.
pub fn warn_of_joints(made: &Made) -> Option<String> {
    let joints = 0..made.plan.joints.len();
    let warned = joints.filter_map(|index| Some((index, joint_warning(made, index)?)));
    let mut by_what: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    warned.for_each(|(index, what)| by_what.entry(what).or_default().push(joint_id(index)));
    let words: Vec<String> = by_what
        .into_iter()
        .map(|(what, joints)| format!("{}: {what}", joints.join(", ")))
        .collect();
    (!words.is_empty()).then(|| words.join("; "))
}

/// Returns the promise of a jig.
pub fn promised_jig(written: &WrittenJig) -> PromisedJig {
    let jig = &written.jig;
    PromisedJig {
        id: written.id(),
        joint: joint_id(jig.joint),
        file: written.file.clone(),
        print_from_model: written.evidence().pose,
        out: jig.out,
        point_mm: jig.point_mm,
        normal: jig.normal,
        gap_mm: jig.gap_mm,
        ribs_mm: jig.ribs_mm,
        pressed_mm: PRESSED_MM,
    }
}

/// Returns the rows of the jigs.
pub fn jig_rows(facts: &Facts) -> Vec<JigRow> {
    let density_g_mm3 = facts.placed.shop.material.density_g_mm3();
    let jigs = facts.made.jigs.iter().zip(&facts.judgement.jigs);
    let row = |(written, found): (&WrittenJig, &JigFacts)| JigRow {
        order: promised_jig(written),
        size_mm: found.part.size_mm,
        volume_mm3: found.part.surface.volume_mm3,
        mass_g: found.part.surface.volume_mm3 * density_g_mm3,
    };
    jigs.map(row).collect()
}

/// Returns the rows of the rounds in which bosses were kept.
pub fn round_rows(facts: &Facts) -> Vec<RoundRow> {
    let row = |(index, round): (usize, &BossRound)| RoundRow {
        round: index + 1,
        bosses: round.bosses.iter().map(boss_row).collect(),
        kept_solid_mm3: round.kept_mm3,
        before: in_sheet_unit(facts.placed, round.before.figure, round.before.value),
        after: in_sheet_unit(facts.placed, round.after.figure, round.after.value),
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

/// Returns the volume in all bosses that could have been emptied, mm³.
pub fn bosses_mm3(facts: &Facts) -> f64 {
    facts.made.bosses.last().map_or(0.0, |round| round.kept_mm3)
}
