//! The judge of toolpaths on G-code written from known boxes, right and with one fault at a time.

mod hostile;

use std::fmt::Write as _;
use std::path::PathBuf;

use super::judge::judge_toolpaths;
use super::source::read_sources;
use super::*;
use crate::base::watch::Watch;
use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::verify::judge_tests::sound_kit;
use crate::verify::test_meshes::block;
use crate::verify::{Body, Evidence, Hardware, HardwareKind, PlateSpot, Pose, PromisedPlate};

/// Width of a line, mm.
const LINE_MM: f64 = 0.5;
/// Diameter of the filament, mm: a circle of 1 mm².
const FILAMENT_MM: f64 = std::f64::consts::FRAC_2_SQRT_PI;
/// The places of the parts on the plate, mm.
const LOWS_MM: [[f64; 2]; 2] = [[10.0, 10.0], [80.0, 10.0]];

/// A box: its low corner and its size, mm.
type Block = ([f64; 3], [f64; 3]);

/// The boxes of a tray of the sound kit: its bottom and its walls.
const TRAY: [Block; 5] = [
    ([0.0, 0.0, 0.0], [60.0, 40.0, 3.0]),
    ([0.0, 0.0, 3.0], [60.0, 3.0, 3.0]),
    ([0.0, 37.0, 3.0], [60.0, 3.0, 3.0]),
    ([0.0, 3.0, 3.0], [3.0, 34.0, 3.0]),
    ([57.0, 3.0, 3.0], [3.0, 34.0, 3.0]),
];
/// Three legs of three lengths: it is not its own mirror image.
const TRIPOD: [Block; 3] = [
    ([0.0, 0.0, 0.0], [39.0, 12.0, 12.0]),
    ([0.0, 12.0, 0.0], [12.0, 18.0, 12.0]),
    ([0.0, 0.0, 12.0], [12.0, 12.0, 12.0]),
];

/// A print that is as it should be, but for one fault.
#[derive(Clone, Copy)]
struct Print {
    layer_mm: f64,
    density_g_cm3: Option<f64>,
    /// Share of the material in all boxes after the first.
    fill_ratio: f64,
    scale_ratio: f64,
    is_mirrored: bool,
    shift_mm: [f64; 2],
}

const RIGHT: Print = Print {
    layer_mm: 0.2,
    density_g_cm3: Some(1.2),
    fill_ratio: 1.0,
    scale_ratio: 1.0,
    is_mirrored: false,
    shift_mm: [0.0, 0.0],
};

impl Print {
    /// Returns the G-code of objects with these labels and places; `None` for no labels.
    fn gcode(&self, objects: &[(Option<&str>, [f64; 2], &[Block])]) -> String {
        let mut text = format!(
            "G90\nM83\n; filament_diameter = {FILAMENT_MM}\n; fill_density = {}%\n",
            self.fill_ratio * 100.0
        );
        if let Some(density) = self.density_g_cm3 {
            let _ = writeln!(text, "; filament_density = {density}");
        }
        let top_mm = 24.0 * self.scale_ratio;
        for layer in 0..(top_mm / self.layer_mm).round() as usize {
            let z_mm = (layer as f64 + 1.0) * self.layer_mm;
            let _ = writeln!(text, ";LAYER_CHANGE\n;HEIGHT:{}", self.layer_mm);
            for (label, low_mm, blocks) in objects {
                if let Some(label) = label {
                    let _ = writeln!(text, "; printing object {label}");
                }
                for (index, block) in blocks.iter().enumerate() {
                    self.lay(&mut text, block, [low_mm[0], low_mm[1], z_mm], index > 0);
                }
                if let Some(label) = label {
                    let _ = writeln!(text, "; stop printing object {label}");
                }
            }
        }
        text
    }

    /// Lays a layer of a box, a line each half millimetre.
    fn lay(&self, text: &mut String, block: &Block, at: [f64; 3], is_inside: bool) {
        let scaled = |values: [f64; 3]| values.map(|value| value * self.scale_ratio);
        let (low, size) = (scaled(block.0), scaled(block.1));
        let middle_mm = at[2] - 0.5 * self.layer_mm;
        if middle_mm < low[2] || middle_mm > low[2] + size[2] {
            return;
        }
        let is_sparse = is_inside && self.fill_ratio < 1.0;
        let feature = if is_sparse {
            "Internal infill"
        } else {
            "External perimeter"
        };
        let ratio = if is_sparse { self.fill_ratio } else { 1.0 };
        let lines = (size[1] / LINE_MM).round();
        let pitch_mm = size[1] / lines;
        let feed = size[0] * pitch_mm * self.layer_mm * ratio;
        let _ = writeln!(text, ";TYPE:{feature}");
        for line in 0..lines as usize {
            let y_mm = at[1] + low[1] + (line as f64 + 0.5) * pitch_mm + self.shift_mm[1];
            let ends = [low[0] + 0.5 * LINE_MM, low[0] + size[0] - 0.5 * LINE_MM];
            let mirror_mm = if self.is_mirrored { 39.0 } else { 0.0 };
            let x = |mm: f64| at[0] + self.shift_mm[0] + (mirror_mm - mm).abs();
            let _ = writeln!(
                text,
                "G1 X{} Y{y_mm} Z{}\nG1 X{} Y{y_mm} E{feed}",
                x(ends[0]),
                at[2],
                x(ends[1])
            );
        }
    }

    /// Returns the plate with both trays of the sound kit.
    fn trays(&self, labels: [Option<&str>; 2]) -> String {
        let object = |i: usize| (labels[i], LOWS_MM[i], TRAY.as_slice());
        self.gcode(&[object(0), object(1)])
    }
}

/// Returns the sound kit on a filament printer, with its plate.
fn kit() -> Evidence {
    let mut evidence = sound_kit();
    let printer = &mut evidence.promise.printer;
    printer.process = Some("fdm".into());
    printer.layer_mm = Some(0.2);
    printer.pixel_mm = Some([LINE_MM; 2]);
    let spot = |i: usize| PlateSpot {
        id: format!("P0{}", i + 1),
        low_mm: LOWS_MM[i],
        size_mm: [60.0, 40.0],
        is_turned: false,
    };
    evidence.promise.plates = vec![PromisedPlate {
        file: "plate.3mf".into(),
        size_mm: Some([200.0, 100.0]),
        holds: vec![spot(0), spot(1)],
    }];
    evidence
}

/// Returns a kit of the tripod alone, which lies as in the model.
fn tripod_kit() -> Evidence {
    let mut evidence = kit();
    let meshes = TRIPOD
        .iter()
        .map(|(low, size)| block(Point::from(*low), *size));
    let empty = TriMesh::new(Vec::new(), Vec::new()).unwrap();
    let mesh = meshes.fold(empty, |all, mesh| all.joined(&mesh));
    evidence.hollowed = mesh.clone();
    evidence.parts.truncate(1);
    evidence.parts[0].mesh = mesh;
    evidence.parts[0].pose = Pose::identity();
    evidence.promise.parts.truncate(1);
    evidence.promise.plates[0].holds.truncate(1);
    evidence.promise.plates[0].holds[0].size_mm = [39.0, 30.0];
    evidence
}

/// Judges files of these texts.
fn judge(evidence: &Evidence, texts: &[String]) -> Result<PrintedJudgement, PrintedError> {
    let folder = tempfile::tempdir().unwrap();
    let file = |(index, text): (usize, &String)| {
        let path = folder.path().join(format!("{index}.gcode"));
        std::fs::write(&path, text).unwrap();
        path
    };
    let files: Vec<PathBuf> = texts.iter().enumerate().map(file).collect();
    let sources = read_sources(&files, &Watch::silent())?;
    let body = Body::of(&evidence.hollowed);
    judge_toolpaths(evidence, &body, &sources, &Watch::silent())
}

/// Judges one file that can be judged.
fn judged(evidence: &Evidence, text: String) -> PrintedJudgement {
    judge(evidence, &[text]).unwrap()
}

fn broken(found: &PrintedJudgement) -> Vec<String> {
    let broken = found.checks.iter().filter(|check| !check.pass);
    broken.map(|check| check.kind.to_string()).collect()
}

fn kinds(found: &PrintedJudgement) -> Vec<CauseKind> {
    found.causes.iter().map(|cause| cause.kind).collect()
}

/// Asserts that toolpaths are right and agree with the written parts.
fn assert_right(found: &PrintedJudgement) {
    assert_eq!(broken(found), Vec::<String>::new(), "{found:?}");
    assert_eq!(kinds(found), []);
    let toolpaths = found.toolpaths.as_ref().unwrap();
    assert!((toolpaths.mass_g / found.written.mass_g - 1.0).abs() < 1e-9);
    for part in &found.parts {
        assert!(part.center_off_mm < 1e-9, "{part:?}");
        assert!(part.mass_off_ratio().abs() < 1e-9, "{part:?}");
    }
}

const LABELS: [Option<&str>; 2] = [Some("P01.stl id:0 copy 0"), Some("p02_1 id:1 copy 0")];

#[test]
fn right_toolpaths_weigh_what_the_kit_does() {
    let found = judged(&kit(), RIGHT.trays(LABELS));
    assert_right(&found);
    assert!(
        found
            .parts
            .iter()
            .all(|part| part.found_by == MatchedBy::Label)
    );
    assert_eq!(found.notes, Vec::<String>::new());
}

#[test]
fn plates_of_a_file_each_are_put_together() {
    let one = |i: usize| RIGHT.gcode(&[(LABELS[i], LOWS_MM[0], &TRAY)]);
    let found = judge(&kit(), &[one(1), one(0)]).unwrap();
    assert_right(&found);
    // The second part lies where the first should.
    assert!(found.parts[1].is_moved && found.notes[0].contains("placed by its box: P02"));
}

#[test]
fn parts_without_labels_are_found_by_their_places() {
    let moved = Print {
        shift_mm: [-3.0, 14.0],
        ..RIGHT
    };
    for print in [RIGHT, moved] {
        let found = judged(&kit(), print.trays([None, None]));
        assert_right(&found);
        assert!(
            found
                .parts
                .iter()
                .all(|part| part.found_by == MatchedBy::Place)
        );
    }
}

#[test]
fn a_part_may_be_turned_on_the_plate() {
    let turned = TRAY.map(|(low, size)| {
        let low = [40.0 - low[1] - size[1], low[0], low[2]];
        (low, [size[1], size[0], size[2]])
    });
    let text = RIGHT.gcode(&[
        (LABELS[0], [20.0, 15.0], turned.as_slice()),
        (LABELS[1], LOWS_MM[1], &TRAY),
    ]);
    let found = judged(&kit(), text);
    assert_right(&found);
    assert!(found.parts[0].is_turned && !found.parts[0].is_mirrored);
}

#[test]
fn equal_parts_are_not_told_apart_without_label_and_place() {
    let text = RIGHT.gcode(&[(None, [45.0, 50.0], &TRAY)]);
    let error = judge(&kit(), &[text]).unwrap_err().to_string();
    assert!(error.contains("fits P01 and P02"), "{error}");
    // In the place of one it is that one.
    let text = RIGHT.gcode(&[(None, LOWS_MM[1], &TRAY)]);
    assert_eq!(judged(&kit(), text).missing, ["P01"]);
}

#[test]
fn files_of_other_kits_and_files_given_twice_are_named() {
    let said = |texts: &[String]| judge(&kit(), texts).unwrap_err().to_string();
    let other = RIGHT.gcode(&[(LABELS[0], LOWS_MM[0], TRIPOD.as_slice())]);
    assert!(said(&[other]).contains("its P01 has another shape"));
    let stranger = RIGHT.gcode(&[(Some("cube"), LOWS_MM[0], TRIPOD.as_slice())]);
    assert!(said(&[stranger]).contains("fits no part of this kit: it prints cube of"));
    let unlabelled = RIGHT.gcode(&[(None, LOWS_MM[0], TRIPOD.as_slice())]);
    assert!(said(&[unlabelled]).contains("the size of no part or plate"));
    let both = RIGHT.gcode(&[(Some("P01+P02"), LOWS_MM[0], &TRAY)]);
    assert!(said(&[both]).contains("fits P01 and P02"));
    let text = RIGHT.trays(LABELS);
    let twice = said(&[text.clone(), text]);
    assert!(twice.contains("P01 is printed in") && twice.contains("give one of them only"));
    for empty in ["", "; nothing\n", "G28\n"] {
        assert!(judge(&kit(), &[empty.to_owned()]).is_err());
    }
    assert!(judge(&kit(), &[]).is_err());
}

#[test]
fn a_stranger_beside_the_parts_is_left_out() {
    let text = RIGHT.gcode(&[
        (LABELS[0], LOWS_MM[0], &TRAY),
        (LABELS[1], LOWS_MM[1], &TRAY),
        (Some("tower"), [150.0, 10.0], TRIPOD.as_slice()),
    ]);
    let found = judged(&kit(), text);
    assert_right(&found);
    assert!(found.notes[0].starts_with("not of this kit, and left out: tower"));
}

#[test]
fn a_missing_half_is_named_with_its_plate() {
    let found = judged(&kit(), RIGHT.gcode(&[(LABELS[0], LOWS_MM[0], &TRAY)]));
    assert_eq!(
        (broken(&found), found.toolpaths),
        (vec!["printed parts".to_owned()], None)
    );
    assert_eq!(found.causes[0].parts, ["P02"]);
    assert!(found.causes[0].remedy.contains("plate.3mf"));
}

/// Judges a print of both trays with a fault; returns its only cause.
fn only_cause(print: Print) -> Cause {
    let found = judged(&kit(), print.trays(LABELS));
    assert!(!found.passes());
    assert_eq!(found.causes.len(), 1, "{:?}", found.causes);
    found.causes.into_iter().next().unwrap()
}

#[test]
fn sparse_infill_is_named() {
    let cause = only_cause(Print {
        fill_ratio: 0.15,
        ..RIGHT
    });
    assert_eq!(cause.kind, CauseKind::Infill);
    assert!(cause.finding.contains("15 %") && cause.remedy.contains("fill_density to 100 %"));
}

#[test]
fn a_scaled_plate_is_named() {
    let cause = only_cause(Print {
        scale_ratio: 1.01,
        ..RIGHT
    });
    assert_eq!(cause.kind, CauseKind::Scale);
    assert!(
        cause.finding.contains("P01 has 101.0 × 101.0"),
        "{}",
        cause.finding
    );
}

#[test]
fn a_thin_tip_that_is_left_out_is_no_scale() {
    // Fins of the width of a line reach 1 mm beyond two walls; slicers leave them out.
    let fins = [
        block(Point::new(60.0, 19.75, 0.0), [1.0, 0.5, 6.0]),
        block(Point::new(29.75, 40.0, 0.0), [0.5, 1.0, 6.0]),
    ];
    let mut evidence = kit();
    let tray = evidence.parts[0].mesh.clone();
    evidence.parts[0].mesh = fins.iter().fold(tray, |mesh, fin| mesh.joined(fin));
    let spot = &mut evidence.promise.plates[0].holds[0];
    spot.size_mm = spot.size_mm.map(|mm| mm + 1.0);
    let found = judged(&evidence, RIGHT.trays(LABELS));
    for (ratio, mm) in found.parts[0].size_ratio.iter().zip([60.0, 40.0]) {
        assert!((ratio - mm / (mm + 1.0)).abs() < 1e-3, "{ratio}");
    }
    assert_eq!(kinds(&found), [], "{:?}", found.causes);
    // A plate of 99 % is shorter too, and its material is as well.
    let small = Print {
        scale_ratio: 0.99,
        ..RIGHT
    };
    assert_eq!(only_cause(small).kind, CauseKind::Scale);
}

#[test]
fn glue_hardware_and_ballast_are_those_of_the_promise() {
    let mut evidence = kit();
    let plain_g = judged(&evidence, RIGHT.trays(LABELS)).written.mass_g;
    evidence.promise.hardware.push(Hardware {
        id: "H1".into(),
        kind: HardwareKind::Tip,
        from_mm: [0.0, 0.0, 8.0],
        to_mm: [0.0, 0.0, 4.0],
        diameter_mm: 4.0,
        hole_mm: 0.0,
        round_end: false,
        density_g_cm3: 7.8,
        mass_g: 0.4,
        depth_mm: 2.0,
        socket_mm: 0.0,
    });
    let found = judged(&evidence, RIGHT.trays(LABELS));
    let toolpaths = found.toolpaths.unwrap();
    assert!(found.written.mass_g > plain_g + 0.3);
    assert!((toolpaths.mass_g - found.written.mass_g).abs() < 1e-9);
    for axis in 0..3 {
        let apart_mm = toolpaths.center_mm[axis] - found.written.center_mm[axis];
        assert!(apart_mm.abs() < 1e-9, "{apart_mm}");
    }
    let printed_g: f64 = found.parts.iter().map(|part| part.mass_g).sum();
    assert!((printed_g - plain_g).abs() < 1e-9);
}

#[test]
fn thick_layers_are_named() {
    let cause = only_cause(Print {
        layer_mm: 0.3,
        ..RIGHT
    });
    assert_eq!(cause.kind, CauseKind::LayerHeight);
    assert!(cause.finding.contains("0.30 mm") && cause.remedy.contains("layer_height to 0.2 mm"));
}

#[test]
fn another_density_is_named_and_weighed() {
    let heavy = Print {
        density_g_cm3: Some(1.5),
        ..RIGHT
    };
    assert_eq!(only_cause(heavy).kind, CauseKind::Density);
    let found = judged(&kit(), heavy.trays(LABELS));
    let ratio = found.toolpaths.unwrap().mass_g / found.written.mass_g;
    assert!((ratio - 1.25).abs() < 1e-9, "{ratio}");
    // Without a density, and with one of no filament, the kit's is taken, and that is said.
    for density_g_cm3 in [None, Some(1240.0)] {
        let unknown = Print {
            density_g_cm3,
            ..RIGHT
        };
        let found = judged(&kit(), unknown.trays(LABELS));
        assert_right(&found);
        assert!(found.notes[0].contains("the kit's 1.2 g/cm³ is taken"));
    }
}

#[test]
fn a_mirror_image_is_named() {
    let print = |print: Print| {
        judged(
            &tripod_kit(),
            print.gcode(&[(LABELS[0], LOWS_MM[0], &TRIPOD)]),
        )
    };
    let found = print(RIGHT);
    assert_eq!(kinds(&found), []);
    assert!(found.parts[0].center_off_mm < 1e-9);
    let found = print(Print {
        is_mirrored: true,
        ..RIGHT
    });
    assert_eq!(kinds(&found), [CauseKind::Mirror]);
    assert!(found.parts[0].center_off_mm > 1.0 && !found.passes());
}

#[test]
fn support_in_a_void_is_told_with_its_mass() {
    let mut text = RIGHT.trays(LABELS);
    text += ";LAYER_CHANGE\n;HEIGHT:0.2\n; printing object P01.stl id:0 copy 0\n\
        ;TYPE:Support material\nG1 X20 Y30 Z4.5\nG1 X50 Y30 E100\n\
        G1 X5 Y5 Z4.5\nG1 X5 Y8 E7\n";
    let found = judged(&kit(), text);
    assert_eq!(kinds(&found), [CauseKind::SupportInVoid]);
    assert!(found.passes(), "{:?}", broken(&found));
    assert!((found.parts[0].support_in_voids_mm3 - 100.0).abs() < 1e-6);
    assert!((found.parts[0].support_mm3 - 107.0).abs() < 1e-6);
    assert!(found.causes[0].finding.contains("0.12 g in P01"));
}
