//! The checks of a telescope: facts against promises.

use super::facts::{GROUND_LIMIT_MM, TelescopeFacts};
use super::pose::{PosePromise, PosesFacts, REACH_LIMIT_MM};
use super::promise::TelescopePromise;
use super::surfaces::Surfaces;
use crate::verify::{Check, CheckKind, Limit};

/// By how much a gap may be below the clearance, mm: facets of both sides, and the file's rounding.
pub const GAP_LIMIT_MM: f64 = 0.01;
/// By how much a wall may be below the one ordered, mm: as for gaps.
pub(super) const WALL_LIMIT_MM: f64 = 0.01;
/// By how much an outside may differ from its body, mm.
const BODY_LIMIT_MM: f64 = 0.01;
/// By how much a deviation may exceed the one promised, mm: another way of sampling.
const DEVIATION_LIMIT_MM: f64 = 0.05;
/// By how much a written placement may differ from the judge's, mm: the digits of a file.
pub(super) const PLACEMENT_LIMIT_MM: f64 = 1e-6;
/// By how much a mass may differ from the one promised, as a share: single precision.
pub(super) const MASS_LIMIT_RATIO: f64 = 1e-4;
/// By how much a centre may be off, mm.
pub(super) const CENTRE_LIMIT_MM: f64 = 0.01;
/// By how much a toppling angle may differ, degrees: the corners of a round foot.
pub(super) const TOPPLING_LIMIT_DEG: f64 = 0.05;
/// By how much a box may differ, mm.
pub(super) const BOX_LIMIT_MM: f64 = 0.02;
/// By how much a part may be above or below the plate, mm.
const PLATE_LIMIT_MM: f64 = 1e-3;

/// Holds the facts against the promises.
pub fn telescope_checks(promise: &TelescopePromise, facts: &TelescopeFacts) -> Vec<Check> {
    let mut checks = of_surfaces(facts);
    checks.extend(of_shells(promise, facts));
    checks.extend(of_joints(promise, facts));
    checks.extend(of_motion(promise, facts));
    checks.extend(of_balance(promise, facts));
    checks.extend(pose_checks(&promise.poses, &facts.poses));
    checks
}

/// Returns a check that a list of faults is empty.
pub(super) fn none(kind: CheckKind, promise: &str, faults: &[String]) -> Check {
    let check = Check::new(
        kind,
        promise,
        Some(faults.len() as f64),
        Limit::at_most(0.0, ""),
    );
    check.at((!faults.is_empty()).then(|| faults.join("; ")))
}

fn of_surfaces(facts: &TelescopeFacts) -> Vec<Check> {
    surface_checks(&Surfaces {
        broken: facts.broken.clone(),
        crossings: facts.crossings,
        in_pieces: facts.in_pieces.clone(),
        above_plate_mm: facts.above_plate_mm,
        too_large: facts.too_large.clone(),
    })
}

/// Holds the surfaces of parts, and how they lie, against what all kits promise.
pub(super) fn surface_checks(facts: &Surfaces) -> Vec<Check> {
    vec![
        none(
            CheckKind::BrokenSurfaces,
            "every part is a closed solid",
            &facts.broken,
        ),
        Check::new(
            CheckKind::SelfIntersections,
            "no part passes through itself",
            Some(facts.crossings as f64),
            Limit::at_most(0.0, ""),
        ),
        none(
            CheckKind::OneBody,
            "every part is one body",
            &facts.in_pieces,
        ),
        Check::new(
            CheckKind::Resting,
            "every part rests on the plate",
            Some(facts.above_plate_mm),
            Limit::at_most(PLATE_LIMIT_MM, "mm"),
        ),
        none(
            CheckKind::BuildVolume,
            "every part fits into the printer",
            &facts.too_large,
        ),
    ]
}

fn of_shells(promise: &TelescopePromise, facts: &TelescopeFacts) -> Vec<Check> {
    let thinnest = facts
        .shells
        .iter()
        .min_by(|a, b| a.wall_mm.total_cmp(&b.wall_mm));
    let worst = facts
        .shells
        .iter()
        .max_by(|a, b| a.body_error_mm.total_cmp(&b.body_error_mm));
    let mut checks = vec![
        Check::new(
            CheckKind::Wall,
            "the walls of the shells are as thick as ordered",
            thinnest.map(|shell| shell.wall_mm),
            Limit::at_least(promise.wall_mm - WALL_LIMIT_MM, "mm"),
        )
        .at(thinnest.map(|shell| shell.id.clone())),
        Check::new(
            CheckKind::ShellBodies,
            "every shell is a round tube about its helix, as thick as promised",
            worst.map(|shell| shell.body_error_mm),
            Limit::at_most(BODY_LIMIT_MM, "mm"),
        )
        .at(worst.map(|shell| shell.id.clone())),
    ];
    if promise.parts.iter().any(|part| part.vent_mm.is_some()) {
        let closed = facts.shells.iter().filter(|shell| shell.is_vent_closed);
        let closed: Vec<String> = closed.map(|shell| shell.id.clone()).collect();
        let words = "powder leaves every shell that holds another through its holes";
        checks.push(none(CheckKind::DrainHoles, words, &closed));
    }
    checks
}

fn of_joints(promise: &TelescopePromise, facts: &TelescopeFacts) -> Vec<Check> {
    let tightest = facts
        .joints
        .iter()
        .min_by(|a, b| a.gap_mm.total_cmp(&b.gap_mm));
    let gap = tightest.map(|joint| joint.gap_mm);
    let stops: Vec<String> = facts
        .joints
        .iter()
        .flat_map(|j| j.stop_faults.clone())
        .collect();
    let twists: Vec<String> = facts
        .joints
        .iter()
        .flat_map(|j| j.twist_faults.clone())
        .collect();
    let behind = facts.joints.iter().filter(|joint| joint.is_open_behind);
    let behind: Vec<String> = behind.map(|joint| joint.id.clone()).collect();
    let has_caps = promise.parts.iter().any(|part| !part.is_tube);
    let mut checks = vec![
        none(
            CheckKind::Stops,
            "every shell is free up to its stop, and held by it",
            &stops,
        ),
        none(
            CheckKind::TwistStops,
            "every shell turns as far as promised, and no farther",
            &twists,
        ),
        none(
            CheckKind::WayBack,
            match has_caps {
                true => "no shell can leave backwards once its caps are in",
                false => "no shell can leave backwards",
            },
            &behind,
        ),
    ];
    if !facts.joints.is_empty() {
        let check = Check::new(
            CheckKind::Sliding,
            "shells slide with their clearance over the whole stroke",
            gap,
            Limit::at_least(promise.clearance_mm - GAP_LIMIT_MM, "mm"),
        );
        let place =
            |joint: &super::stops::JointFacts| format!("{} at {:.1} mm", joint.id, joint.at_mm);
        checks.push(check.at(tightest.map(place)));
    }
    checks
}

fn of_motion(promise: &TelescopePromise, facts: &TelescopeFacts) -> Vec<Check> {
    let deviation = facts.deviation;
    vec![
        none(
            CheckKind::Motion,
            "no two shells touch while it opens",
            &facts.too_near,
        ),
        Check::new(
            CheckKind::Placements,
            "the keys of the motion place every shell where its joints do",
            Some(facts.placement_error_mm),
            Limit::at_most(PLACEMENT_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::Deviation,
            "open, it is as near to the curve as promised",
            deviation.map(|deviation| deviation.max_mm),
            Limit::at_most(promise.deviation.max_mm + DEVIATION_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::Sizes,
            "its boxes, all in and all out, are as stated",
            Some(box_error_mm(promise, facts)),
            Limit::at_most(BOX_LIMIT_MM, "mm"),
        ),
    ]
}

fn box_error_mm(promise: &TelescopePromise, facts: &TelescopeFacts) -> f64 {
    let stated = [promise.collapsed_mm, promise.extended_mm];
    let pairs = stated.iter().flatten().zip(facts.boxes_mm.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn of_balance(promise: &TelescopePromise, facts: &TelescopeFacts) -> Vec<Check> {
    let pairs = || promise.balance.iter().zip(&facts.balance);
    let is_whole = promise.balance.len() == facts.balance.len();
    let centre = pairs()
        .map(|(stated, found)| (crate::geom::Point::from(stated.centre_mm) - found.centre).norm());
    let stands = promise.least_angle_deg.is_some();
    let lean = pairs().zip(&facts.depths_mm);
    let lean = lean.filter(|((stated, _), _)| stands || stated.toppling_deg.is_some());
    let lean = lean.map(|((stated, found), depth_mm)| {
        // Where it reaches below its root it cannot stand, and no angle is true.
        let is_true = *depth_mm <= GROUND_LIMIT_MM;
        let stated = stated.toppling_deg.filter(|_| is_true);
        (stated.unwrap_or(f64::NEG_INFINITY) - found.toppling_deg).abs()
    });
    let [centre, lean] = [centre.fold(0.0, f64::max), lean.fold(0.0, f64::max)];
    let mut checks = vec![
        Check::new(
            CheckKind::Mass,
            "it weighs what is stated",
            Some((facts.mass_g / promise.mass_g - 1.0).abs()),
            Limit::at_most(MASS_LIMIT_RATIO, ""),
        ),
        Check::new(
            CheckKind::Centres,
            "its centre of mass is where it is stated at every key",
            is_whole.then_some(centre),
            Limit::at_most(CENTRE_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::Toppling,
            "it topples as stated at every key",
            is_whole.then_some(lean),
            Limit::at_most(TOPPLING_LIMIT_DEG, "°"),
        ),
    ];
    if !promise.ballast.is_empty() {
        let words = "every piece of ballast is a stock part, and has room in its pocket";
        checks.push(none(CheckKind::BallastRoom, words, &facts.ballast_faults));
    }
    if let Some(least_deg) = promise.least_angle_deg {
        let worst = facts.balance.iter().map(|found| found.toppling_deg);
        checks.push(Check::new(
            CheckKind::Standing,
            "it stands at every key, until leaned by",
            Some(worst.fold(f64::INFINITY, f64::min)),
            Limit::at_least(least_deg, "°"),
        ));
        checks.push(Check::new(
            CheckKind::Ground,
            "nothing reaches below its foot as it opens",
            Some(facts.below_foot_mm),
            Limit::at_most(GROUND_LIMIT_MM, "mm"),
        ));
    }
    checks
}

/// Holds the facts against the promises; nothing of a kit without poses.
pub(super) fn pose_checks(promises: &[PosePromise], facts: &PosesFacts) -> Vec<Check> {
    if promises.is_empty() && facts.faults.is_empty() {
        return Vec::new();
    }
    let clear = none(
        CheckKind::Poses,
        "every pose is where it is stated, and reached without a touch",
        &facts.faults,
    );
    let reach = facts.off_mm.map(|off_mm| {
        let limit = Limit::at_most(REACH_LIMIT_MM, "mm");
        let promise = "every tip is in the place that was asked for";
        Check::new(CheckKind::Reach, promise, Some(off_mm), limit).at(facts.farthest.clone())
    });
    [clear].into_iter().chain(reach).collect()
}
