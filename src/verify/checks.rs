//! The list of checks of a kit.

use super::cell_walls::cell_checks;
use super::goal_checks::{figure_check, goal_checks};
use super::hardware::HardwareKind;
use super::joints::FilmError;
use super::limits::{
    CUP_LIMIT_MM3, FILM_LIMIT_RATIO, GAP_TOLERANCE_MM, GRIP_TOLERANCE_MM, JIG_SEAM_LIMIT_MM,
    LEAST_GRIP_DIAMETERS, POSE_LIMIT_RATIO, RESTING_LIMIT_MM, STRING_GAP_TOLERANCE_MM,
    VOLUME_SUM_LIMIT_RATIO, WALL_TOLERANCE_MM,
};
use super::peg_checks::peg_checks;
use super::play::worst_joint;
use super::shape_checks::shape_checks;
use super::thin_checks::thin_checks;
use super::void_checks::{holes_check, plugs_check, regions_check, void_checks};
use super::{
    Check, CheckKind, CupFacts, JigFacts, Judgement, Limit, PartFacts, Peg, Promise, PromisedPart,
};

/// Returns all checks of a kit, in the order of a person's questions. Does it do what was ordered?
/// Is the wall there? Can it be printed? Do the parts make the whole?
pub fn checks(promise: &Promise, found: &Judgement) -> Vec<Check> {
    let mut checks = goal_checks(&promise.goal, found);
    checks.extend(
        promise
            .promise
            .map(|promised| figure_check(promised, &found.assembly)),
    );
    checks.extend(
        found
            .wall_min_mm
            .map(|wall_mm| wall_check(promise.wall.required_mm, wall_mm)),
    );
    checks.extend(thin_checks(&found.thin));
    checks.extend(fit_checks(promise, found));
    checks.extend(found.ballast_room_mm.map(ballast_check));
    checks.extend(surface_checks(promise, found));
    let printed = printed(found);
    checks.extend(shape_checks(&found.shape, &printed));
    checks.extend(plate_checks(&printed));
    checks.extend(
        promise
            .printer
            .build_volume_mm
            .map(|room| room_check(&printed, room)),
    );
    checks.extend(cup_check(&found.cups));
    checks.extend(holes_check(&found.holes));
    checks.extend(plugs_check(promise, &found.plugs));
    checks.extend(cell_checks(promise, found.cells.as_ref()));
    checks.extend(void_checks(promise, &found.voids));
    checks.push(volume_check(promise, found));
    checks.extend(joint_checks(promise, found));
    checks.extend(step_check(promise, found));
    checks.extend(jig_checks(&found.jigs));
    checks.extend(found.film_error.as_ref().map(film_check));
    checks.extend(found.lost_strokes.map(marks_check));
    checks
}

fn wall_check(required_mm: f64, wall_mm: f64) -> Check {
    let limit = Limit::at_least(required_mm - WALL_TOLERANCE_MM, "mm");
    Check::new(
        CheckKind::Wall,
        "every wall between a void and the outside is at least",
        Some(wall_mm),
        limit,
    )
}

/// Checks that the hardware goes in, and that it keeps a yo-yo's halves apart.
fn fit_checks(promise: &Promise, found: &Judgement) -> Vec<Check> {
    let Some(fit) = &found.fit else {
        return Vec::new();
    };
    let gap = promise.string_gap_mm.map(|ordered_mm| {
        let off_mm = fit.gap_mm.map(|gap_mm| (gap_mm - ordered_mm).abs());
        let promise = format!("the halves are {ordered_mm} mm apart at their axle, within");
        Check::new(
            CheckKind::StringGap,
            &promise,
            off_mm,
            Limit::at_most(STRING_GAP_TOLERANCE_MM, "mm"),
        )
    });
    let room = Check::new(
        CheckKind::Hardware,
        "every piece of hardware goes into its socket, with room on each side of",
        fit.room_mm,
        Limit::at_least(0.0, "mm"),
    );
    let axle = promise
        .hardware
        .iter()
        .find(|piece| piece.kind == HardwareKind::Axle);
    let grip = axle.map(|axle| {
        let least_mm = LEAST_GRIP_DIAMETERS * axle.diameter_mm - GRIP_TOLERANCE_MM;
        Check::new(
            CheckKind::Grip,
            "each half holds the axle, by its diameter or more, along at least",
            fit.grip_mm,
            Limit::at_least(least_mm, "mm"),
        )
    });
    std::iter::once(room).chain(gap).chain(grip).collect()
}

/// Checks that every part of ballast has room in its declared place.
fn ballast_check(room_mm: f64) -> Check {
    let promise = "every part of ballast lies in a void, with a gap around it of";
    Check::new(
        CheckKind::BallastRoom,
        promise,
        Some(room_mm),
        Limit::above(0.0, "mm"),
    )
}

/// Returns the facts about all that is printed: parts and jigs.
fn printed(found: &Judgement) -> Vec<PartFacts> {
    let jigs = found.jigs.iter().map(|jig| &jig.part);
    found.parts.iter().chain(jigs).cloned().collect()
}

/// Checks that the surfaces of all files can be printed.
fn surface_checks(promise: &Promise, found: &Judgement) -> Vec<Check> {
    let printed = printed(found);
    let uncut = std::iter::once(("hollowed.stl", &found.surface));
    let surfaces: Vec<_> = uncut
        .chain(printed.iter().map(|p| (p.id.as_str(), &p.surface)))
        .collect();
    let broken = surfaces
        .iter()
        .filter_map(|(id, s)| s.defect.as_ref().map(|why| format!("{id}: {why}")));
    let crossed = surfaces.iter().filter(|(_, s)| s.crossings > 0);
    let crossings = surfaces.iter().map(|(_, s)| s.crossings).sum();
    let cavities = match &promise.infill {
        Some(infill) => regions_check(promise, found, infill),
        None => cavities_check(found),
    };
    vec![
        no_faults(
            CheckKind::BrokenSurfaces,
            "every file is closed, 2-manifold and turned outward",
            broken.clone().count(),
        )
        .at(join_words(broken)),
        no_faults(
            CheckKind::SelfIntersections,
            "no surface passes through itself",
            crossings,
        )
        .at(join_words(
            crossed.map(|(id, s)| format!("{id}: {}", s.crossings)),
        )),
        cavities,
    ]
    .into_iter()
    .chain(beyond_check(found))
    .collect()
}

/// Checks that no part has a closed cavity.
fn cavities_check(found: &Judgement) -> Check {
    let parts = &found.parts;
    let sealed = parts.iter().filter(|part| part.cavities > 0);
    let count = parts.iter().map(|part| part.cavities).sum();
    let words = sealed.map(|part| format!("{}: {}", part.id, part.cavities));
    let promise = if found.holes.is_empty() {
        "every void is opened by a cut"
    } else {
        "every void is opened by a drain hole"
    };
    no_faults(CheckKind::ClosedCavities, promise, count).at(join_words(words))
}

/// Checks that no more is said to be laid beyond the written print than slicers lay.
fn beyond_check(found: &Judgement) -> Option<Check> {
    let ratio = found.beyond_ratio?;
    Some(Check::new(
        CheckKind::LaidBeyond,
        "what the slicer laid beyond the written print is no more than slicers lay, as a share",
        Some(ratio),
        Limit::at_most(1.0, ""),
    ))
}

/// Checks that every part lies on the plate as its pose says.
fn plate_checks(parts: &[PartFacts]) -> Vec<Check> {
    let (resting, resting_at) = worst_part(parts, |part| part.lowest_mm.abs());
    let (pose, pose_at) = worst_part(parts, |part| part.pose_error);
    vec![
        Check::new(
            CheckKind::Resting,
            "every part rests on the plate",
            resting,
            Limit::at_most(RESTING_LIMIT_MM, "mm"),
        )
        .at(resting_at),
        Check::new(
            CheckKind::Pose,
            "every pose is a turn and a shift",
            pose,
            Limit::at_most(POSE_LIMIT_RATIO, ""),
        )
        .at(pose_at),
    ]
}

/// Checks that every part fits the printer, by the least room left along any axis.
fn room_check(parts: &[PartFacts], room_mm: [f64; 3]) -> Check {
    let excess = |part: &PartFacts| {
        let over = [0, 1, 2].map(|axis| part.size_mm[axis] - room_mm[axis]);
        over.into_iter().fold(f64::NEG_INFINITY, f64::max)
    };
    let (excess_mm, at) = worst_part(parts, excess);
    let left_mm = excess_mm.map(|excess| -excess);
    Check::new(
        CheckKind::BuildVolume,
        "every part fits, with room to spare of",
        left_mm,
        Limit::at_least(0.0, "mm"),
    )
    .at(at)
}

/// Checks that no part encloses resin while it is printed; `None` for other processes than resin in
/// a vat.
fn cup_check(cups: &[CupFacts]) -> Option<Check> {
    let worst = cups
        .iter()
        .max_by(|a, b| a.volume_mm3.total_cmp(&b.volume_mm3))?;
    let promise = "no part encloses more resin against the film at any layer than";
    let limit = Limit::at_most(CUP_LIMIT_MM3, "mm³");
    let check = Check::new(CheckKind::Cups, promise, Some(worst.volume_mm3), limit);
    Some(check.at(Some(worst.id.clone())))
}

/// Checks that the parts add up to the uncut body, plus the pins, less the sockets and ids.
fn volume_check(promise: &Promise, found: &Judgement) -> Check {
    let sum = |pegs: &[Peg]| pegs.iter().map(|peg| peg.volume_mm3).sum::<f64>();
    let marks = |part: &PromisedPart| part.marks.iter().map(|mark| mark.volume_mm3).sum::<f64>();
    let joints: f64 = promise
        .parts
        .iter()
        .map(|part| sum(&part.pins) - sum(&part.sockets) - marks(part))
        .sum();
    let whole = found.hollowed.volume_mm3;
    let drained_mm3: f64 = found.drained_mm3.iter().sum();
    let plugs_mm3: f64 = found.plugs.iter().map(|plug| plug.volume_mm3).sum();
    let off_mm3 = found.assembly.volume_mm3 - whole - joints + drained_mm3 - plugs_mm3;
    let error = off_mm3.abs() / whole;
    Check::new(
        CheckKind::Volumes,
        if found.holes.is_empty() {
            "the parts add up to the uncut body, its pins, sockets and engraved ids"
        } else if found.plugs.is_empty() {
            "the piece is the uncut body, less its drain holes"
        } else {
            "the parts are the uncut body, less its drain holes, and their plugs"
        },
        Some(error),
        Limit::at_most(VOLUME_SUM_LIMIT_RATIO, ""),
    )
}

/// Checks that the pins are in the files, fit their sockets and leave the wall, and that no part
/// reaches into another.
fn joint_checks(promise: &Promise, found: &Judgement) -> Vec<Check> {
    let apart = no_faults(
        CheckKind::Overlap,
        "no part reaches into another",
        found.overlaps,
    );
    let mut checks = peg_checks(&found.pegs, promise.printer.minimum_wall_mm);
    checks.push(apart);
    checks
}

/// Checks that pins leave no large step at the rim of their joint. `None` if no joint is held by
/// pins, or the process has no limit.
fn step_check(promise: &Promise, found: &Judgement) -> Option<Check> {
    let limit_mm = promise.printer.seam_step_mm?;
    let worst = worst_joint(promise, &found.joints)?;
    let words = "the parts of every joint meet at its rim, however its pins are pushed, within";
    let limit = Limit::at_most(limit_mm, "mm");
    let check = Check::new(CheckKind::JointStep, words, Some(worst.step_mm()), limit);
    Some(check.at(Some(worst.id.clone())))
}

/// Checks that every jig comes off, keeps its gap and leaves the seam free; empty without jigs.
fn jig_checks(jigs: &[JigFacts]) -> Vec<Check> {
    let worst = |value: fn(&JigFacts) -> f64| {
        let worst = jigs.iter().max_by(|a, b| value(a).total_cmp(&value(b)));
        worst.map(|jig| (value(jig), Some(jig.part.id.clone())))
    };
    let caught = worst(|jig| jig.caught as f64).map(|(caught, at)| {
        let words = "every jig comes off straight, and nothing catches it";
        no_faults(CheckKind::JigWay, words, caught as usize).at(at)
    });
    let gap = worst(|jig| jig.ordered_gap_mm - jig.gap_mm).map(|(lack_mm, at)| {
        let words = "every jig keeps its gap from the outside; short by at most";
        let limit = Limit::at_most(GAP_TOLERANCE_MM, "mm");
        Check::new(CheckKind::JigGap, words, Some(lack_mm.max(0.0)), limit).at(at)
    });
    let seam = worst(|jig| -jig.seam_mm).map(|(over_mm, at)| {
        let words = "every jig leaves room along its seam of";
        let limit = Limit::at_least(JIG_SEAM_LIMIT_MM, "mm");
        Check::new(CheckKind::JigSeam, words, Some(-over_mm), limit).at(at)
    });
    caught.into_iter().chain(gap).chain(seam).collect()
}

/// Checks that all strokes of the engraved ids are there.
fn marks_check(lost: usize) -> Check {
    let promise = "every stroke of every engraved id is as deep as promised, but for";
    no_faults(CheckKind::EngravedIds, promise, lost)
}

/// Checks that the films of glue are as large as the faces in the files.
fn film_check(error: &FilmError) -> Check {
    let promise = "every film of glue is as large as its faces, but for a share of";
    Check::new(
        CheckKind::Glue,
        promise,
        Some(error.ratio),
        Limit::at_most(FILM_LIMIT_RATIO, ""),
    )
    .at(Some(error.joint.clone()))
}

/// Checks that a count of faults is zero.
pub(super) fn no_faults(kind: CheckKind, promise: &str, count: usize) -> Check {
    Check::new(kind, promise, Some(count as f64), Limit::at_most(0.0, ""))
}

/// Returns the largest value of any part and the part's id; `None` without parts.
fn worst_part(
    parts: &[PartFacts],
    value: impl Fn(&PartFacts) -> f64,
) -> (Option<f64>, Option<String>) {
    let worst = parts
        .iter()
        .map(|part| (value(part), part))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    (
        worst.map(|(value, _)| value),
        worst.map(|(_, part)| part.id.clone()),
    )
}

/// Returns all words separated by semicolons, or `None` if there are none.
fn join_words(words: impl Iterator<Item = String>) -> Option<String> {
    let words: Vec<String> = words.collect();
    (!words.is_empty()).then(|| words.join("; "))
}
