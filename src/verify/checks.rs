//! The list of checks, and the limits they hold.

use super::joints::{film_check, marks_check};
use super::{
    Afloat, Aim, Check, CheckKind, FigureName, Figures, Judgement, Limit, PartFacts, Peg, PegFacts,
    Promise, PromisedPart, RotorOrder, WaterOrder, ballast, cleaning::cleaning_checks,
};
use crate::goal::GoalKind;

/// The centre of mass of a written top or yo-yo may lie this far from its axis, mm. Above it the
/// wobble is felt; far below it is lost in the printer's own accuracy.
pub const AXIS_OFFSET_LIMIT_MM: f64 = 0.005;
/// The principal axis may lean this far from the spin axis, degrees; the same reasons.
pub const AXIS_TILT_LIMIT_DEG: f64 = 0.05;
/// I_b/I_c must be below this for the spin axis to be the stable one (intermediate axis theorem).
pub const DOMINANCE_LIMIT_RATIO: f64 = 1.0;
/// A standing object must topple at more than this, degrees.
pub const STANDING_LIMIT_DEG: f64 = 0.0;
/// A floating object's waterline may be this far from the predicted one, mm: the surface of water
/// hides far more.
pub const WATERLINE_LIMIT_MM: f64 = 0.02;
/// The metacentre must lie higher than this above the centre of mass, mm, for it to stay upright.
pub const METACENTRIC_LIMIT_MM: f64 = 0.0;
/// It must right itself from this heel, degrees: with less, a ripple turns it over.
pub const RIGHTING_LIMIT_DEG: f64 = 5.0;
/// The wall may be this much thinner than ordered, mm: the chords of a curved surface. Above it a
/// printed wall loses a pixel.
pub const WALL_TOLERANCE_MM: f64 = 0.01;
/// The string gap of a yo-yo may be this far from the ordered one, mm: the rounding of a file, far
/// below a layer.
pub const STRING_GAP_TOLERANCE_MM: f64 = 1e-3;
/// Volumes of the parts add up to this share of the body. STL's f32 coordinates leave about 1e-7 of
/// 100 mm.
pub const VOLUME_SUM_LIMIT_RATIO: f64 = 1e-6;
/// A part rests on the plate within this, mm: two f32 steps at 300 mm. Above it a slicer's first
/// layer is thin.
pub const RESTING_LIMIT_MM: f64 = 1e-4;
/// A pose's matrix is rigid within this: rounding of a 4×4 matrix is 1e-15, a mirror 2, a 0.01 %
/// stretch 2e-4.
pub const POSE_LIMIT_RATIO: f64 = 1e-9;
/// A pin or socket may be this far from its promised radius, length or depth, mm: the flats of a
/// circle of 48 sides lie 0.004 mm inside it at 4 mm across; above it a pin may bind, or rattle.
pub const PIN_LIMIT_MM: f64 = 0.02;
/// The gap between a pin and its socket may be this much narrower than ordered, mm: the rounding of
/// files; above it, and still far below what a printer can hold, a shop's own clearance would be
/// eaten into.
pub const GAP_TOLERANCE_MM: f64 = 1e-3;
/// The written assembly may miss the promised figure by this share: above the rounding of STL
/// (1e-6), below anything a person can measure.
pub const FIGURE_SLACK_RATIO: f64 = 1e-3;
/// Every check of a kit, in the order a person asks: does it do what was asked, is the wall there,
/// can it be printed, do the parts make the whole.
pub fn checks(promise: &Promise, found: &Judgement) -> Vec<Check> {
    let mut checks = goal_checks(&promise.goal, &found.assembly);
    checks.extend(
        promise
            .promise
            .map(|p| figure_check(p.figure, p.value, &found.assembly)),
    );
    checks.extend(
        found
            .wall_min_mm
            .map(|wall_mm| wall_check(promise.wall.required_mm, wall_mm)),
    );
    checks.extend(fit_checks(promise, found));
    checks.extend(found.ballast_room_mm.map(ballast::room_check));
    checks.extend(surface_checks(found));
    checks.extend(plate_checks(&found.parts));
    checks.extend(
        promise
            .printer
            .build_volume_mm
            .map(|room| room_check(&found.parts, room)),
    );
    checks.extend(cleaning_checks(promise, &found.voids));
    checks.push(volume_check(promise, found));
    checks.extend(joint_checks(promise, found));
    checks.extend(found.film_error.clone().map(film_check));
    checks.extend(found.lost_strokes.map(marks_check));
    checks
}

/// Whether the assembly does what the goal asks of any body.
fn goal_checks(aim: &Aim, assembly: &Figures) -> Vec<Check> {
    let offset = |promise| {
        Check::new(
            CheckKind::AxisOffset,
            promise,
            assembly.axis_offset_mm,
            Limit::at_most(AXIS_OFFSET_LIMIT_MM, "mm"),
        )
    };
    match aim.kind {
        GoalKind::Top => [
            vec![offset("the centre of mass lies on the spin axis")],
            spinning_checks(assembly),
        ]
        .concat(),
        GoalKind::Yoyo => [
            vec![offset("the centre of mass lies in the spin point")],
            spinning_checks(assembly),
        ]
        .concat(),
        GoalKind::Stand => vec![Check::new(
            CheckKind::Standing,
            "it stands, and topples when tilted by",
            assembly.topples_deg,
            Limit::above(STANDING_LIMIT_DEG, "°"),
        )],
        GoalKind::Float => aim
            .water
            .iter()
            .flat_map(|order| floating_checks(order, assembly))
            .collect(),
        GoalKind::Balance => aim
            .rotor
            .iter()
            .map(|order| grade_check(order, assembly))
            .collect(),
    }
}

/// Whether it floats where it should, upright, and comes back when it is heeled; the outer surface
/// is held to be tight.
fn floating_checks(order: &WaterOrder, assembly: &Figures) -> Vec<Check> {
    let found = |value: fn(&Afloat) -> f64| assembly.afloat.as_ref().map(value);
    let aside = found(|afloat| afloat.waterline_mm).map(|mm| (mm - order.waterline_mm).abs());
    let depth = format!("it floats {:.2} mm deep, within", order.waterline_mm);
    let check = |kind, promise: &str, value, limit| Check::new(kind, promise, value, limit);
    vec![
        check(
            CheckKind::Waterline,
            &depth,
            aside,
            Limit::at_most(WATERLINE_LIMIT_MM, "mm"),
        ),
        check(
            CheckKind::Upright,
            "its centre of mass is over its centre of buoyancy",
            found(|afloat| afloat.offset_mm),
            Limit::at_most(AXIS_OFFSET_LIMIT_MM, "mm"),
        ),
        check(
            CheckKind::Stability,
            "its metacentre is above its centre of mass by",
            found(|afloat| afloat.metacentric_height_mm),
            Limit::above(METACENTRIC_LIMIT_MM, "mm"),
        ),
        check(
            CheckKind::Righting,
            "it rights itself whichever way it is heeled, at least from",
            found(|afloat| afloat.rights_from_deg),
            Limit::at_least(RIGHTING_LIMIT_DEG, "°"),
        ),
    ]
}

/// Whether a rotor runs as true as it was ordered to.
fn grade_check(order: &RotorOrder, assembly: &Figures) -> Check {
    let promise = format!(
        "at {} rpm its balance quality grade (ISO 21940-11) is G",
        order.speed_rpm
    );
    let grade = assembly.value_of(FigureName::BalanceGradeMmS);
    Check::new(
        CheckKind::BalanceQuality,
        &promise,
        grade,
        Limit::at_most(order.grade_mm_s, "mm/s"),
    )
}

/// What tops and yo-yos share: the axis is principal, and the stable one.
fn spinning_checks(assembly: &Figures) -> Vec<Check> {
    let tilt = Limit::at_most(AXIS_TILT_LIMIT_DEG, "°");
    let dominance = Limit::below(DOMINANCE_LIMIT_RATIO, "");
    vec![
        Check::new(
            CheckKind::AxisTilt,
            "the spin axis is a principal axis",
            assembly.axis_tilt_deg,
            tilt,
        ),
        Check::new(
            CheckKind::Dominance,
            "the moment of inertia is largest about the spin axis (I_b/I_c)",
            assembly.dominance_ratio,
            dominance,
        ),
    ]
}

/// Whether the written assembly reaches the figure that was promised.
fn figure_check(figure: FigureName, promised: f64, assembly: &Figures) -> Check {
    let slack = promised.abs() * FIGURE_SLACK_RATIO;
    let limit = match figure {
        _ if figure.more_is_better() => Limit::at_least(promised - slack, figure.unit()),
        _ => Limit::at_most(promised + slack, figure.unit()),
    };
    Check::new(
        CheckKind::PromisedFigure { figure },
        figure.promise(),
        assembly.value_of(figure),
        limit,
    )
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

/// Whether the hardware goes in, and holds a yo-yo's halves apart.
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
    std::iter::once(room).chain(gap).collect()
}

/// Whether the surfaces of all files can be printed.
fn surface_checks(found: &Judgement) -> Vec<Check> {
    let uncut = std::iter::once(("hollowed.stl", &found.surface));
    let surfaces: Vec<_> = uncut
        .chain(found.parts.iter().map(|p| (p.id.as_str(), &p.surface)))
        .collect();
    let broken = surfaces
        .iter()
        .filter_map(|(id, s)| s.defect.as_ref().map(|why| format!("{id}: {why}")));
    let crossed = surfaces.iter().filter(|(_, s)| s.crossings > 0);
    let crossings = surfaces.iter().map(|(_, s)| s.crossings).sum();
    let sealed = found.parts.iter().filter(|p| p.cavities > 0);
    let cavities = found.parts.iter().map(|p| p.cavities).sum();
    vec![
        none(
            CheckKind::BrokenSurfaces,
            "every file is closed, 2-manifold and turned outward",
            broken.clone().count(),
        )
        .at(listed(broken)),
        none(
            CheckKind::SelfIntersections,
            "no surface passes through itself",
            crossings,
        )
        .at(listed(
            crossed.map(|(id, s)| format!("{id}: {}", s.crossings)),
        )),
        none(
            CheckKind::ClosedCavities,
            "every void is opened by a cut",
            cavities,
        )
        .at(listed(sealed.map(|p| format!("{}: {}", p.id, p.cavities)))),
    ]
}

/// Whether every part lies on the plate as its pose says.
fn plate_checks(parts: &[PartFacts]) -> Vec<Check> {
    let (resting, resting_at) = worst(parts, |part| part.lowest_mm.abs());
    let (pose, pose_at) = worst(parts, |part| part.pose_error);
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

/// Whether every part fits the printer: the least room left along any axis.
fn room_check(parts: &[PartFacts], room_mm: [f64; 3]) -> Check {
    let excess = |part: &PartFacts| {
        let over = [0, 1, 2].map(|axis| part.size_mm[axis] - room_mm[axis]);
        over.into_iter().fold(f64::NEG_INFINITY, f64::max)
    };
    let (excess_mm, at) = worst(parts, excess);
    let left_mm = excess_mm.map(|excess| -excess);
    Check::new(
        CheckKind::BuildVolume,
        "every part fits, with room to spare of",
        left_mm,
        Limit::at_least(0.0, "mm"),
    )
    .at(at)
}

/// Whether the parts are the uncut body, plus the pins, less the sockets.
fn volume_check(promise: &Promise, found: &Judgement) -> Check {
    let sum = |pegs: &[Peg]| pegs.iter().map(|peg| peg.volume_mm3).sum::<f64>();
    let marks = |part: &PromisedPart| part.marks.iter().map(|mark| mark.volume_mm3).sum::<f64>();
    let joints: f64 = promise
        .parts
        .iter()
        .map(|part| sum(&part.pins) - sum(&part.sockets) - marks(part))
        .sum();
    let whole = found.hollowed.volume_mm3;
    let error = (found.assembly.volume_mm3 - whole - joints).abs() / whole;
    Check::new(
        CheckKind::Volumes,
        "the parts add up to the uncut body, its pins, sockets and engraved ids",
        Some(error),
        Limit::at_most(VOLUME_SUM_LIMIT_RATIO, ""),
    )
}

/// Whether the pins are in the files, fit their sockets, and leave the wall; and the parts leave
/// each other room.
fn joint_checks(promise: &Promise, found: &Judgement) -> Vec<Check> {
    let apart = none(
        CheckKind::Overlap,
        "no part reaches into another",
        found.overlaps,
    );
    if found.pegs.is_empty() {
        return vec![apart];
    }
    let (deviation_mm, off_at) = worst_of(&found.pegs, |peg| Some(peg.deviation_mm));
    let (lack_mm, tight_at) = worst_of(&found.pegs, |peg| Some(peg.ordered_gap_mm - peg.gap_mm?));
    let (bulge_mm, thin_at) = worst_of(&found.pegs, |peg| Some(-peg.wall_mm));
    let wall_mm = bulge_mm.map(|bulge_mm| -bulge_mm);
    vec![
        Check::new(
            CheckKind::Pins,
            "every pin and socket has its size, within",
            deviation_mm,
            Limit::at_most(PIN_LIMIT_MM, "mm"),
        )
        .at(off_at),
        Check::new(
            CheckKind::Clearance,
            "the gap of every pin on each side is the ordered one, short by",
            lack_mm,
            Limit::at_most(GAP_TOLERANCE_MM, "mm"),
        )
        .at(tight_at),
        wall_around_check(promise, wall_mm).at(thin_at),
        apart,
    ]
}

fn wall_around_check(promise: &Promise, wall_mm: Option<f64>) -> Check {
    let limit = Limit::at_least(promise.printer.minimum_wall_mm - WALL_TOLERANCE_MM, "mm");
    Check::new(
        CheckKind::SocketWall,
        "the wall around every socket is at least",
        wall_mm,
        limit,
    )
}

/// The largest value of any pin and which; not a number, so that the check fails, where one has
/// none.
fn worst_of(
    pegs: &[PegFacts],
    value: impl Fn(&PegFacts) -> Option<f64>,
) -> (Option<f64>, Option<String>) {
    let of = |peg: &PegFacts| value(peg).unwrap_or(f64::INFINITY);
    let worst = pegs.iter().max_by(|a, b| of(a).total_cmp(&of(b)));
    (worst.map(of), worst.map(|peg| peg.id.clone()))
}

/// A check that nothing of a kind was found.
fn none(kind: CheckKind, promise: &str, count: usize) -> Check {
    Check::new(kind, promise, Some(count as f64), Limit::at_most(0.0, ""))
}

/// The largest value of any part and whose it is; none without parts.
fn worst(parts: &[PartFacts], value: impl Fn(&PartFacts) -> f64) -> (Option<f64>, Option<String>) {
    let worst = parts
        .iter()
        .map(|part| (value(part), part))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    (
        worst.map(|(value, _)| value),
        worst.map(|(_, part)| part.id.clone()),
    )
}

/// All words, separated by semicolons; none if there are none.
fn listed(words: impl Iterator<Item = String>) -> Option<String> {
    let words: Vec<String> = words.collect();
    (!words.is_empty()).then(|| words.join("; "))
}
