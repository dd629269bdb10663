//! The checklist, the pictures and the view of a sound kit: the hollow box of the judge's tests.

use crate::base::dialect::Dialect;
use crate::base::watch::Watch;
use crate::geom::{Parting, Plane, Point, Vector};
use crate::page::{CutFace, Mouth, Picture, Region, Subject, View, draw_figures, render_pictures};
use crate::repair::{RepairOrder, weld};
use crate::sheet::part_picture_file;
use crate::sheet::*;
use crate::verify::judge_tests::{judge, sound_kit};
use crate::verify::{
    Cleaning, Evidence, FigureName, Hardware, HardwareKind, HeldBy, Judgement, PartFacts, Promise,
    PromisedCut, PromisedFigure, PromisedPart, PromisedVoid, Shells,
};

/// The cleaning rule of a water jet.
const CLEANING: Cleaning = Cleaning {
    rule: crate::verify::CleaningRule::InSight,
    sight_ratio: 0.95,
    reach_mm: Some(150.0),
    pair_opening_mm: None,
    overhang_deg: None,
};

/// Stated share of the void's wall in sight: less than is found, within the difference of two
/// samples.
const SIGHT_RATIO: f64 = 0.96;

/// Adds a cut at z = 16 mm and a void to clean to a promise.
fn order_cleaning(promise: &mut Promise) {
    promise.printer.minimum_opening_mm = Some(4.0);
    promise.printer.cleaning = Some(CLEANING);
    promise.cuts = vec![PromisedCut {
        point_mm: [0.0, 0.0, 16.0],
        normal: [0.0, 0.0, 1.0],
    }];
    let sight_ratio = Some(SIGHT_RATIO);
    promise.voids = vec![PromisedVoid {
        id: "V1".into(),
        sight_ratio,
        least_opening_mm: Some(4.0),
    }];
}

/// Returns a steel tip of 3 × 12 mm, half of it in its socket.
pub fn steel_tip() -> Hardware {
    Hardware {
        id: "H1".to_owned(),
        kind: HardwareKind::Tip,
        from_mm: [0.0, 0.0, 12.0],
        to_mm: [0.0; 3],
        diameter_mm: 3.0,
        hole_mm: 0.0,
        round_end: true,
        density_g_cm3: 7.85,
        mass_g: 0.6,
        depth_mm: 6.0,
        socket_mm: 3.4,
    }
}

/// Returns the checklist of a sound kit, and the evidence on which it was judged.
pub fn sample() -> (Checklist, Evidence) {
    let mut evidence = sound_kit();
    order_cleaning(&mut evidence.promise);
    let found = judge(&evidence);
    (checklist(&evidence, &found), evidence)
}

/// Returns the pictures and the 3D view of the sample.
pub fn sample_pictures(sheet: &Checklist, evidence: &Evidence) -> (Vec<Picture>, View) {
    let shells = Shells::of_mesh(&weld(&evidence.hollowed));
    let cuts = [Parting::everywhere(Plane::through(
        &Point::new(0.0, 0.0, 16.0),
        &Vector::z(),
    ))];
    let Promise {
        goal: aim,
        parts: promised,
        hardware,
        ballast,
        ..
    } = &evidence.promise;
    let subject = Subject {
        infill: None,
        jigs: &evidence.jigs,
        promised_jigs: &evidence.promise.jigs,
        shells: &shells,
        parts: &evidence.parts,
        promised,
        cuts: &cuts,
        aim: *aim,
        hardware,
        ballast,
    };
    let frame = |[x, y]: [f64; 2]| vec![[-x, -y], [x, -y], [x, y], [-x, y]];
    let face = CutFace {
        cut: "C1".into(),
        plane: cuts[0].plane,
        rings: vec![
            frame([30.0, 20.0]),
            frame([27.0, 17.0]).into_iter().rev().collect(),
        ],
        wall: Some([[27.0, 0.0], [30.0, 0.0]]),
        whole: vec![],
        regions: vec![Region {
            at: [28.5, 0.0],
            parts: ["P01".into(), "P02".into()],
        }],
        mouths: vec![Mouth {
            void: "V1".into(),
            at: [0.0, 0.0],
            diameter_mm: 34.0,
        }],
    };
    let mut pictures = render_pictures(&subject, &Watch::silent()).unwrap();
    pictures.extend(draw_figures(sheet, &subject, &[face], &Watch::silent()).unwrap());
    (pictures, View::of(&subject, &Watch::silent()).unwrap())
}

fn checklist(evidence: &Evidence, found: &Judgement) -> Checklist {
    let speed = found.assembly.critical_speed_rpm.unwrap();
    Checklist {
        drains: Vec::new(),
        schema: Checklist::SCHEMA,
        tool: Tool {
            name: "equipoise".into(),
            version: "0.1.0".into(),
        },
        job: "box".into(),
        model: model(found),
        printer: printer(),
        material: material(),
        goal: GoalRow {
            aim: evidence.promise.goal,
            objective: ObjectiveName::CriticalSpeed,
            spin_it_weights: None,
            contact_gap_mm: 0.0,
            turns_on: Vec::new(),
            spins_on: found.spin,
            choice: None,
            off_natural_deg: None,
        },
        promise: Some(PromisedFigure {
            figure: FigureName::CriticalSpeedRpm,
            value: speed,
        }),
        solid: found.solid.clone(),
        hollowed: found.hollowed.clone(),
        assembly: found.assembly.clone(),
        certificate: certificate(speed),
        wall: WallRow {
            required_mm: 3.0,
            asked_mm: None,
            measured_min_mm: found.wall_min_mm,
        },
        voids: vec![the_void()],
        cuts: vec![cut()],
        parts: parts(evidence, found),
        joints: vec![joint()],
        jigs: Vec::new(),
        plates: Vec::new(),
        print_time: None,
        grid: vec![grid_row()],
        hardware: vec![],
        dowels: vec![],
        cut_list: vec![],
        string_gap_mm: None,
        finished_size_mm: Some(finished_size_mm(&evidence.parts, &[])),
        size_tolerance_mm: Some(0.2),
        turn: None,
        foot: None,
        ballast: Vec::new(),
        fill: None,
        cells: None,
        infill: None,
        laid: None,
        toolpaths: None,
        rounds: Vec::new(),
        checks: found.checks.clone(),
        verdict: Verdict::of(&found.checks),
        offers: Vec::new(),
        warnings: vec![
            "the contact point hangs 10 mm below the surface: glue on a tip of that length".into(),
        ],
        notes: vec![],
        files: Default::default(),
        timing_s: Some(Timing(vec![("load".into(), 0.25), ("judge".into(), 0.5)])),
        log: vec![LogRow {
            phase: "newton".into(),
            figures: [("gap_ratio".to_owned(), 1e-9)].into(),
        }],
    }
}

fn model(found: &Judgement) -> ModelRow {
    ModelRow {
        file: "box <&> lid.stl".into(),
        sha256: "ab".repeat(32),
        triangles: 12,
        size_mm: [60.0, 40.0, 12.0],
        volume_mm3: found.solid.volume_mm3,
        scale_ratio: 1.0,
        repair: RepairOrder::default(),
        redrawn: None,
        thickened: None,
    }
}

fn certificate(speed: f64) -> Certificate {
    Certificate {
        figure: FigureName::CriticalSpeedRpm,
        value: speed,
        bound: speed,
        gap_ratio: 1e-9,
        kept_solid_mm3: 0.0,
        value_before_cleaning: Some(speed),
        proof: None,
        cleaning_rounds: vec![],
        bosses_mm3: 0.0,
        over_heights: Some(HeightProof {
            pitch_mm: 0.5,
            value: speed,
            bound: 0.998 * speed,
        }),
        written_value: Some(speed),
        course: Some(course(speed)),
    }
}

/// Returns three passes to a speed, and the speeds around its height.
fn course(speed: f64) -> Course {
    let pass = |share: f64| PassRow {
        value: speed * (1.0 + share),
        bound: speed * (1.0 - share),
    };
    let at = |height_mm: f64| SpeedRow {
        height_mm,
        critical_speed_rpm: speed + (height_mm - 16.0).powi(2),
    };
    Course {
        passes: [0.5, 0.1, 0.0].map(pass).into(),
        speeds: [12.0, 16.0, 20.0].map(at).into(),
        trade: None,
    }
}

fn printer() -> PrinterRow {
    PrinterRow {
        id: "objet-connex350".into(),
        profile_sha256: "ef".repeat(32),
        name: "Objet Connex350".into(),
        process: Process::Polyjet,
        pixel_mm: [0.0423, 0.0423],
        layer_mm: 0.016,
        dialect: Dialect::Prusa,
        build_volume_mm: Some([100.0, 100.0, 6.0]),
        print_scale_ratio: None,
        support: SupportMethod::WaterJet,
        minimum_wall_mm: 1.0,
        minimum_opening_mm: 4.0,
        cleaning: CLEANING,
        least_pin_mm: Some(2.0),
        seam_step_mm: Some(0.3),
        glue: Some(GlueRow {
            name: "thin cyanoacrylate (super glue)".into(),
            hold_s: Some(60.0),
            cure_h: Some(24.0),
            safety: Some("The glue bonds skin and eyes in seconds.".into()),
        }),
        sources: vec!["layer: read: user guide".into()],
    }
}

fn material() -> MaterialRow {
    MaterialRow {
        id: "vero".into(),
        name: "VeroWhite".into(),
        density_g_cm3: 1.2,
        density_source: "datasheet".into(),
        density_sure: "recalled".into(),
        density_spread_ratio: Some(0.02),
        typical_spread_ratio: Some(0.02),
    }
}

fn grid_row() -> GridRow {
    GridRow {
        what: "wall".into(),
        along: Direction::X,
        asked_mm: 3.0,
        drawn_mm: 3.0033,
        steps_of: "pixels".into(),
        step_mm: 0.0423,
        steps: 71,
        given_mm: 71.0 * 0.0423,
        is_whole: true,
    }
}

fn the_void() -> VoidRow {
    VoidRow {
        id: "V1".into(),
        volume_mm3: 54.0 * 34.0 * 6.0,
        opened_by: vec!["C1".into()],
        drained_by: Vec::new(),
        parts: vec!["P01".into(), "P02".into()],
        opening_mm: 34.0,
        least_opening_mm: 4.0,
        depth_mm: 3.0,
        sight_ratio: Some(SIGHT_RATIO),
        method: CLEANING.rule.description().into(),
        is_clean: true,
        clean: "Flush with the water jet.".into(),
    }
}

fn cut() -> CutRow {
    CutRow {
        id: "C1".into(),
        point_mm: [0.0, 0.0, 16.0],
        normal: [0.0, 0.0, 1.0],
        within: Vec::new(),
    }
}

fn joint() -> JointRow {
    JointRow {
        id: "J1".into(),
        cut: "C1".into(),
        parts: ["P01".into(), "P02".into()],
        area_mm2: 60.0 * 40.0 - 54.0 * 34.0,
        pins: 0,
        clearance_mm: 0.2,
        held_by: HeldBy::Eye,
        play: None,
        unbalance_g_mm: None,
        glue: None,
        note: None,
    }
}

fn parts(evidence: &Evidence, found: &Judgement) -> Vec<PartRow> {
    let promised = evidence.promise.parts.iter();
    let pairs = promised.zip(&found.parts);
    pairs
        .map(|(promised, facts)| part(promised, facts))
        .collect()
}

fn part(promised: &PromisedPart, facts: &PartFacts) -> PartRow {
    PartRow {
        id: promised.id.clone(),
        file: promised.file.clone(),
        sha256: "cd".repeat(32),
        fingerprint: None,
        triangles: facts.surface.triangles,
        volume_mm3: facts.surface.volume_mm3,
        mass_g: facts.surface.volume_mm3 * 1.2e-3,
        size_mm: facts.size_mm,
        lies: "open side up".into(),
        print_from_model: promised.print_from_model,
        pins: vec![],
        sockets: vec![],
        marks: vec![],
        half: None,
        cup_mm3: 0.0,
        drains_over: Vec::new(),
        support: None,
        picture: Some(part_picture_file(&promised.id)),
    }
}
