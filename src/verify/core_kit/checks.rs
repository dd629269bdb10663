//! The checks of an object on a base: facts against promises.

use super::facts::CoreFacts;
use super::promise::CorePromise;
use crate::geom::Point;
use crate::verify::{Check, CheckKind, Limit};

/// By how much rounding may make the distance of the base less than promised, mm.
const PARTED_SLACK_MM: f64 = 1e-6;
/// The same at sampled points, mm.
const SAMPLED_SLACK_MM: f64 = 1e-3;
/// The greatest volume of the base outside of the model, mm³: rounding of large bodies.
const OUTSIDE_LIMIT_MM3: f64 = 1e-3;
/// The greatest volume that two panels share, mm³.
const PANEL_OVERLAP_LIMIT_MM3: f64 = 1e-3;
/// The greatest height of a panel's corner over a plane of the base, mm.
const PANEL_OUT_LIMIT_MM: f64 = 1e-6;
/// By how much the beam's path may be off, mm.
const PATH_LIMIT_MM: f64 = 1e-3;
/// By how much spacing and margin on a sheet may be less than promised, mm.
const NEST_SLACK_MM: f64 = 1e-3;
/// The greatest sine of a panel's turn against the grain: rounding.
const GRAIN_LIMIT: f64 = 1e-9;
/// By how much a part may be above or below the plate, mm.
const PLATE_LIMIT_MM: f64 = 1e-3;
/// The greatest deviation of a pose from a rigid motion.
const POSE_LIMIT: f64 = 1e-9;
/// The greatest distance of the model's surface from the parts, mm.
const COVER_LIMIT_MM: f64 = 5e-3;
/// The greatest volume of parts in the room of the base, mm³.
const IN_BASE_LIMIT_MM3: f64 = 1e-2;
/// The greatest volume of brackets in panels or outside of the base, mm³: rounding in files.
const BRACKET_LIMIT_MM3: f64 = 1.0;
/// The greatest volume of screws' heads in anything else, mm³: their seats touch, rounded in files.
const HEADS_LIMIT_MM3: f64 = 0.05;
/// By how much a wall may be below the one ordered, mm.
const WALL_SLACK_MM: f64 = 0.01;
/// By how much the sum of all volumes may differ from the model's, as a share.
const VOLUME_LIMIT_RATIO: f64 = 1e-6;
/// The greatest volume that a unit shares with others on its way, mm³.
const WAY_LIMIT_MM3: f64 = 1e-2;
/// The greatest volume that two things share where they stand, mm³: faces that touch, rounded in
/// files.
const STANDING_LIMIT_MM3: f64 = 2.0;
/// By how much the mass may differ from the one promised, as a share.
const MASS_LIMIT_RATIO: f64 = 1e-6;
/// By how much the centre may be off, mm.
const CENTRE_LIMIT_MM: f64 = 1e-3;
/// By how much a toppling angle may differ from the one promised, degrees.
const TOPPLING_LIMIT_DEG: f64 = 1e-3;

/// Holds the facts against the promises.
pub fn core_checks(promise: &CorePromise, facts: &CoreFacts) -> Vec<Check> {
    let mut checks = of_base(facts, promise);
    checks.extend(of_sheets(promise, facts));
    checks.extend(of_stock(facts));
    checks.extend(of_surfaces(facts));
    checks.extend(of_shell(promise, facts));
    checks.extend(of_pins(promise, facts));
    checks.extend(of_ways(facts));
    checks.extend(of_balance(promise, facts));
    checks
}

/// Returns a check that a list of faults is empty.
fn none(kind: CheckKind, promise: &str, faults: &[String]) -> Check {
    let count = Some(faults.len() as f64);
    let check = Check::new(kind, promise, count, Limit::at_most(0.0, ""));
    check.at((!faults.is_empty()).then(|| faults.join("; ")))
}

fn of_base(facts: &CoreFacts, promise: &CorePromise) -> Vec<Check> {
    let distance_mm = promise.distance_mm;
    let mut checks = vec![
        Check::new(
            CheckKind::Separation,
            "every piece of the model's surface is parted from the base by a plane of it",
            facts.base.parted_mm,
            Limit::at_least(distance_mm - PARTED_SLACK_MM, "mm"),
        ),
        Check::new(
            CheckKind::BaseDistance,
            "the base keeps its distance from the model's surface, at sampled points",
            Some(facts.base.sampled_mm),
            Limit::at_least(distance_mm - SAMPLED_SLACK_MM, "mm"),
        ),
        Check::new(
            CheckKind::BaseInside,
            "no part of the base is outside of the model",
            Some(facts.base.outside_mm3),
            Limit::at_most(OUTSIDE_LIMIT_MM3, "mm³"),
        ),
        Check::new(
            CheckKind::PanelOverlap,
            "panels do not reach into each other",
            Some(facts.panels.overlap_mm3),
            Limit::at_most(PANEL_OVERLAP_LIMIT_MM3, "mm³"),
        ),
        Check::new(
            CheckKind::PanelsInBase,
            "every panel lies on its plane and reaches out of no other",
            Some(facts.panels.out_mm),
            Limit::at_most(PANEL_OUT_LIMIT_MM, "mm"),
        ),
        none(
            CheckKind::Hardware,
            "every screw passes a hole of its panel, and every insert has its bore",
            &[facts.panels.unscrewed.as_slice(), &facts.shell.unbored].concat(),
        ),
    ];
    if !promise.joins.is_empty() || facts.base.apart_mm != Some(f64::INFINITY) {
        checks.push(Check::new(
            CheckKind::Polyhedra,
            "a plane parts every two polyhedra of the base",
            facts.base.apart_mm,
            Limit::at_least(0.0, "mm"),
        ));
    }
    checks
}

fn of_sheets(promise: &CorePromise, facts: &CoreFacts) -> Vec<Check> {
    vec![
        none(
            CheckKind::Drawings,
            "both drawings of every sheet hold its panels and holes, each once",
            &facts.drawings.faults,
        ),
        Check::new(
            CheckKind::BeamPaths,
            "the beam runs half of its width beside every outline",
            Some(facts.drawings.off_mm),
            Limit::at_most(PATH_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::SheetSpacing,
            "panels on a sheet keep their distance",
            // Sheets with one panel each have no pair.
            Some(facts.drawings.spacing_mm.min(1e6)),
            Limit::at_least(promise.sheet.spacing_mm - NEST_SLACK_MM, "mm"),
        ),
        Check::new(
            CheckKind::SheetMargin,
            "panels keep clear of the edges of their sheet",
            Some(facts.drawings.margin_mm),
            Limit::at_least(promise.sheet.margin_mm - NEST_SLACK_MM, "mm"),
        ),
    ]
}

fn of_stock(facts: &CoreFacts) -> Vec<Check> {
    let stock = none(
        CheckKind::Stock,
        "every sheet is one of those at hand, and lies on the cutter's bed",
        &facts.stock.faults,
    );
    let grain = facts.stock.turn_sine.map(|sine| {
        Check::new(
            CheckKind::Grain,
            "panels follow the grain of their sheet",
            Some(sine),
            Limit::at_most(GRAIN_LIMIT, ""),
        )
    });
    [stock].into_iter().chain(grain).collect()
}

fn of_surfaces(facts: &CoreFacts) -> Vec<Check> {
    let surfaces = &facts.surfaces;
    vec![
        none(
            CheckKind::BrokenSurfaces,
            "every part is a closed solid",
            &surfaces.broken,
        ),
        Check::new(
            CheckKind::SelfIntersections,
            "no part passes through itself",
            Some(surfaces.crossings as f64),
            Limit::at_most(0.0, ""),
        ),
        none(
            CheckKind::OneBody,
            "every part is one body",
            &surfaces.in_pieces,
        ),
        none(
            CheckKind::ClosedCavities,
            "no part encloses a void",
            &surfaces.closed,
        ),
        Check::new(
            CheckKind::Resting,
            "every part rests on the plate",
            Some(surfaces.above_plate_mm),
            Limit::at_most(PLATE_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::Pose,
            "every pose of a part and every frame of a panel is a rigid motion",
            Some(surfaces.pose_error.max(facts.panels.frame_error)),
            Limit::at_most(POSE_LIMIT, ""),
        ),
        none(
            CheckKind::BuildVolume,
            "every part fits into the printer",
            &surfaces.too_large,
        ),
    ]
}

fn of_shell(promise: &CorePromise, facts: &CoreFacts) -> Vec<Check> {
    let shell = &facts.shell;
    let off = (shell.parts_mm3 + facts.base.grown_mm3) / facts.model_mm3 - 1.0;
    let mut checks = vec![
        Check::new(
            CheckKind::Model,
            "parts lie wherever the model has its surface, and nowhere beyond it",
            Some(shell.uncovered_mm.max(shell.beyond_mm)),
            Limit::at_most(COVER_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::Volumes,
            "parts less their pins, voids, bores, and the base with its gap add up to the model",
            Some(off.abs()),
            Limit::at_most(VOLUME_LIMIT_RATIO, ""),
        ),
        Check::new(
            CheckKind::Clearance,
            "parts keep the gap to the panels",
            Some(shell.in_base_mm3),
            Limit::at_most(IN_BASE_LIMIT_MM3, "mm³"),
        ),
        Check::new(
            CheckKind::Brackets,
            "brackets lie in the base, and in no panel",
            Some(shell.brackets_mm3),
            Limit::at_most(BRACKET_LIMIT_MM3, "mm³"),
        ),
    ];
    checks.push(Check::new(
        CheckKind::ScrewHeads,
        "the heads of screws lie in no part, panel or bracket",
        Some(shell.heads_mm3),
        Limit::at_most(HEADS_LIMIT_MM3, "mm³"),
    ));
    if shell.thinnest.is_some() {
        let wall = Check::new(
            CheckKind::Wall,
            "the walls of hollow parts are as thick as ordered",
            Some(shell.wall_mm),
            Limit::at_least(promise.wall_mm - WALL_SLACK_MM, "mm"),
        );
        checks.push(wall.at(shell.thinnest.clone()));
    }
    checks
}

fn of_pins(promise: &CorePromise, facts: &CoreFacts) -> Vec<Check> {
    let pins = &facts.pins;
    let held = none(
        CheckKind::Held,
        "every part is on a panel, or joined to a part that is held",
        &pins.unheld,
    );
    if promise.pins.is_empty() && pins.faults.is_empty() {
        return vec![held];
    }
    let wall_mm = promise.printer.minimum_wall_mm;
    vec![
        held,
        none(
            CheckKind::Pins,
            "every pin stands in its socket with its room, along the way of its unit",
            &pins.faults,
        ),
        Check::new(
            CheckKind::SocketWall,
            "sockets keep the printer's least wall",
            Some(pins.wall_mm.min(2.0 * wall_mm)),
            Limit::at_least(wall_mm - WALL_SLACK_MM, "mm"),
        ),
    ]
}

fn of_ways(facts: &CoreFacts) -> Vec<Check> {
    let ways = &facts.ways;
    let barred = [ways.barred.as_slice(), &ways.strays].concat();
    vec![
        Check::new(
            CheckKind::Overlap,
            "things that touch do not reach into each other",
            Some(ways.standing_mm3),
            Limit::at_most(STANDING_LIMIT_MM3, "mm³"),
        ),
        Check::new(
            CheckKind::WayOut,
            "taken apart in its order, every unit passes what still stands",
            Some(ways.overlap_mm3),
            Limit::at_most(WAY_LIMIT_MM3, "mm³"),
        )
        .at(ways.worst.clone()),
        none(
            CheckKind::WaysFree,
            "no point of a unit meets what still stands, all the way",
            &barred,
        ),
    ]
}

fn of_balance(promise: &CorePromise, facts: &CoreFacts) -> Vec<Check> {
    let stand = &facts.stand;
    let off_mm = (stand.centre - Point::from(promise.centre_mm)).norm();
    let mut checks = vec![
        Check::new(
            CheckKind::Mass,
            "the whole weighs what is promised",
            Some((stand.mass_g / promise.mass_g - 1.0).abs()),
            Limit::at_most(MASS_LIMIT_RATIO, ""),
        ),
        Check::new(
            CheckKind::Centres,
            "the centre of mass is where it is promised",
            Some(off_mm),
            Limit::at_most(CENTRE_LIMIT_MM, "mm"),
        ),
    ];
    checks.extend(facts.rods.as_ref().map(|faults| {
        none(
            CheckKind::Rods,
            "rods reach through holes of both panels, in solid material, and are bought",
            faults,
        )
    }));
    checks.extend(facts.ballast.as_ref().map(|faults| {
        none(
            CheckKind::BallastRoom,
            "ballast lies flat on its panel, within the base and in nothing else, and is of the catalogue",
            faults,
        )
    }));
    if let (Some(least), Some(told)) = (promise.least_angle_deg, promise.toppling_deg) {
        checks.push(Check::new(
            CheckKind::Standing,
            "it stands until leaned as far as promised",
            Some(stand.toppling_deg),
            Limit::at_least(least, "°"),
        ));
        checks.push(Check::new(
            CheckKind::Toppling,
            "the toppling angle is the one that is told",
            Some((stand.toppling_deg - told).abs()),
            Limit::at_most(TOPPLING_LIMIT_DEG, "°"),
        ));
    }
    checks
}
