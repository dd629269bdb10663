//! The judge on a sound kit, and on the same kit with one fault at a time.

use super::*;
use crate::base::watch::Watch;
use crate::geom::{Matrix, Point, Vector};
use crate::goal::GoalKind;
use crate::mass::{Lump, LumpShape};
use crate::mesh::TriMesh;
use test_meshes::{block, tray};

mod goals;
mod infill;

const SIZE: [f64; 3] = [60.0, 40.0, 12.0];
const WALL: f64 = 3.0;
/// The seat of a pin, in the middle of a side of the box of [`sound_kit`]. Its halves meet at
/// z = 16.
pub(crate) const SEAT: [f64; 3] = [28.5, 0.0, 16.0];

/// Returns a hollow box top of 60 × 40 × 12 mm, 10 mm over its contact.
///
/// It is cut through the middle into two equal trays. The lower lies as in the model, the upper is
/// turned over.
pub(crate) fn sound_kit() -> Evidence {
    let half = [SIZE[0], SIZE[1], SIZE[2] / 2.0];
    let corner = Vector::new(-30.0, -20.0, 10.0);
    let turned = Matrix::from_diagonal(&Vector::new(1.0, -1.0, -1.0));
    let poses = [
        Pose::new(&Matrix::identity(), &-corner),
        Pose::new(&turned, &Vector::new(30.0, 20.0, 22.0)),
    ];
    let part = |i: usize| PartEvidence {
        id: format!("P0{}", i + 1),
        mesh: tray(half, WALL),
        inner: Vec::new(),
        pose: poses[i],
    };
    let cavity = block(Point::new(-27.0, -17.0, 13.0), [54.0, 34.0, 6.0]);
    let hollowed = block(Point::from(corner), SIZE).joined(&cavity.reversed());
    Evidence {
        promise: promise(&poses),
        hollowed,
        parts: vec![part(0), part(1)],
        jigs: Vec::new(),
    }
}

fn promise(poses: &[Pose]) -> Promise {
    let part = |(i, pose): (usize, &Pose)| PromisedPart {
        id: format!("P0{}", i + 1),
        file: format!("parts/box_P0{}of02.stl", i + 1),
        sha256: String::new(),
        fingerprint: None,
        print_from_model: *pose,
        pins: vec![],
        sockets: vec![],
        marks: vec![],
    };
    Promise {
        drains: Vec::new(),
        cells: None,
        certificate: None,
        schema: SCHEMA,
        printer: PrinterLimits {
            dialect: Default::default(),
            process: Some("polyjet".into()),
            build_volume_mm: Some([100.0, 100.0, 6.0]),
            print_scale_ratio: None,
            minimum_wall_mm: 1.0,
            minimum_opening_mm: None,
            cleaning: None,
            seam_step_mm: Some(0.3),
            layer_mm: Some(0.016),
            pixel_mm: Some([0.0423; 2]),
        },
        material: Density { density_g_cm3: 1.2 },
        goal: Aim::new(GoalKind::Top, [0.0; 3], [0.0, 0.0, 1.0]),
        promise: None,
        wall: WallOrder { required_mm: WALL },
        cuts: vec![PromisedCut {
            point_mm: [0.0, 0.0, SEAT[2]],
            normal: [0.0, 0.0, 1.0],
        }],
        voids: Vec::new(),
        parts: poses.iter().enumerate().map(part).collect(),
        hardware: Vec::new(),
        dowels: Vec::new(),
        string_gap_mm: None,
        ballast: Vec::new(),
        fill: None,
        infill: None,
        laid: None,
        joints: vec![],
        jigs: Vec::new(),
        plates: Vec::new(),
        files: Default::default(),
    }
}

/// Returns a pin or socket of this diameter and length at the seat.
pub(crate) fn peg(diameter_mm: f64, length_mm: f64, volume_mm3: f64) -> Peg {
    let (id, joint) = ("N1".to_owned(), "J1".to_owned());
    Peg {
        id,
        joint,
        center_mm: SEAT,
        axis: [0.0, 0.0, 1.0],
        diameter_mm,
        length_mm,
        volume_mm3,
    }
}

/// Returns the sound kit with two pins on the list, at both ends of the box, with 0.1 mm of room.
pub(crate) fn kit_with_two_pins() -> Evidence {
    let mut evidence = sound_kit();
    let at = |id: &str, x: f64, diameter_mm: f64| Peg {
        id: id.to_owned(),
        center_mm: [x, SEAT[1], SEAT[2]],
        ..peg(diameter_mm, 1.0, 0.0)
    };
    let both = |diameter_mm| {
        vec![
            at("N1", SEAT[0], diameter_mm),
            at("N2", -SEAT[0], diameter_mm),
        ]
    };
    evidence.promise.parts[0].pins = both(0.6);
    evidence.promise.parts[1].sockets = both(0.8);
    evidence.promise.joints = vec![PromisedJoint {
        id: "J1".to_owned(),
        parts: ["P01".to_owned(), "P02".to_owned()],
        clearance_mm: 0.1,
        held_by: Some(HeldBy::Pins),
        glue: None,
    }];
    evidence
}

/// Judges a kit without a watch.
pub(crate) fn judge(evidence: &Evidence) -> Judgement {
    super::judge(evidence, &Watch::silent()).unwrap()
}

/// Returns the names of the checks that a kit fails.
pub(crate) fn failures(evidence: &Evidence) -> Vec<String> {
    judge(evidence)
        .checks
        .into_iter()
        .filter(|check| !check.pass)
        .map(|check| check.kind.to_string())
        .collect()
}

#[test]
fn a_sound_kit_keeps_every_promise() {
    assert_eq!(failures(&sound_kit()), Vec::<String>::new());
    assert!(judge(&sound_kit()).passes());
}

#[test]
fn the_assembly_has_the_figures_of_the_uncut_body() {
    let judgement = judge(&sound_kit());
    let (whole, parts) = (&judgement.hollowed, &judgement.assembly);
    // Ten sums of products of numbers below 1e5: relative rounding stays below 1e-12.
    assert!((whole.mass_g - parts.mass_g).abs() < 1e-12 * whole.mass_g);
    assert!((whole.critical_speed_rpm.unwrap() - parts.critical_speed_rpm.unwrap()).abs() < 1e-9);
    let volume = 60.0 * 40.0 * 12.0 - 54.0 * 34.0 * 6.0;
    assert!((parts.volume_mm3 - volume).abs() < 1e-9);
    assert!(judgement.solid.mass_g > whole.mass_g);
}

#[test]
fn a_part_glued_a_fiftieth_of_a_millimetre_aside_puts_the_centre_off_the_axis() {
    let mut evidence = sound_kit();
    evidence.parts[0].pose.rows[0][3] += 0.02;
    // Where the halves meet, its wall and the other's void are nearer by as much.
    let broken = ["axis offset", "wall", "part surfaces"];
    assert_eq!(failures(&evidence), broken);
}

#[test]
fn a_mirrored_pose_is_refused() {
    let mut evidence = sound_kit();
    evidence.parts[0].pose.rows[0] = [-1.0, 0.0, 0.0, 30.0];
    assert!(failures(&evidence).contains(&"pose".to_owned()));
}

#[test]
fn a_part_that_hovers_is_found() {
    let mut evidence = sound_kit();
    evidence.parts[1].mesh = evidence.parts[1]
        .mesh
        .map_vertices(|p| p + Vector::z() * 0.001);
    assert_eq!(failures(&evidence), ["resting"]);
}

#[test]
fn an_uncut_body_is_a_closed_cavity() {
    let mut evidence = sound_kit();
    let shift = Vector::new(30.0, 20.0, -10.0);
    let mesh = evidence.hollowed.map_vertices(|p| p + shift);
    evidence.parts = vec![PartEvidence {
        id: "P01".into(),
        mesh,
        inner: Vec::new(),
        pose: Pose::new(&Matrix::identity(), &shift),
    }];
    evidence.promise.printer.build_volume_mm = None;
    assert_eq!(failures(&evidence), ["closed cavities"]);
}

#[test]
fn a_wall_thinner_than_ordered_is_found() {
    let mut evidence = sound_kit();
    evidence.promise.wall.required_mm = WALL + 0.011;
    assert_eq!(failures(&evidence), ["wall"]);
    evidence.promise.wall.required_mm = WALL + 0.009;
    assert_eq!(failures(&evidence), Vec::<String>::new());
}

#[test]
fn a_part_too_large_for_the_printer_is_found() {
    let mut evidence = sound_kit();
    evidence.promise.printer.build_volume_mm = Some([100.0, 39.0, 100.0]);
    let judgement = judge(&evidence);
    let room = judgement
        .checks
        .iter()
        .find(|check| check.kind == CheckKind::BuildVolume)
        .unwrap();
    assert_eq!((room.pass, room.value), (false, Some(-1.0)));
}

#[test]
fn a_socket_that_was_never_sunk_is_found() {
    let mut evidence = sound_kit();
    evidence.promise.parts[0].sockets = vec![peg(0.4, 0.8, 0.1)];
    assert_eq!(failures(&evidence), ["part surfaces", "volumes"]);
}

#[test]
fn a_promise_better_than_the_truth_is_broken_and_one_within_the_slack_is_kept() {
    let mut evidence = sound_kit();
    let speed = judge(&evidence).assembly.critical_speed_rpm.unwrap();
    let figure = FigureName::CriticalSpeedRpm;
    evidence.promise.promise = Some(PromisedFigure {
        figure,
        value: speed * 0.99,
    });
    assert_eq!(failures(&evidence), ["critical speed"]);
    evidence.promise.promise = Some(PromisedFigure {
        figure,
        value: speed * 0.9995,
    });
    assert_eq!(failures(&evidence), Vec::<String>::new());
}

#[test]
fn a_hole_in_a_part_is_found() {
    let mut evidence = sound_kit();
    let mesh = &evidence.parts[0].mesh;
    let open = TriMesh::new(mesh.vertices().to_vec(), mesh.triangles()[1..].to_vec()).unwrap();
    evidence.parts[0].mesh = open;
    assert!(failures(&evidence).contains(&"broken surfaces".to_owned()));
}

#[test]
fn a_body_turned_about_its_longest_axis_cannot_spin() {
    let mut evidence = sound_kit();
    evidence.promise.goal = Aim::new(GoalKind::Yoyo, [0.0, 0.0, 16.0], [1.0, 0.0, 0.0]);
    assert_eq!(failures(&evidence), ["dominance"]);
}

#[test]
fn the_same_box_stands_until_its_centre_is_over_its_edge() {
    let mut evidence = sound_kit();
    evidence.promise.goal.kind = GoalKind::Stand;
    assert_eq!(failures(&evidence), Vec::<String>::new());
    let angle = judge(&evidence).assembly.topples_deg.unwrap();
    assert!((angle - (20.0_f64 / 6.0).atan().to_degrees()).abs() < 1e-9);
}

#[test]
fn the_judgement_is_the_same_on_one_thread_and_on_four() {
    let on = |threads| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap()
            .install(|| judge(&sound_kit()))
    };
    assert_eq!(on(1), on(4));
}
