//! Prints of known boxes as G-code, the kits they belong to, and their judgement.

use std::fmt::Write as _;
use std::path::PathBuf;

use super::super::judge::judge_toolpaths;
use super::super::source::read_sources;
use super::super::*;
use crate::base::watch::Watch;
use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::verify::judge_tests::sound_kit;
use crate::verify::test_meshes::block;
use crate::verify::{Body, Evidence, PlateSpot, Pose, PromisedPlate};

/// Width of a line, mm.
pub(super) const LINE_MM: f64 = 0.5;
/// Diameter of the filament, mm: a circle of 1 mm².
pub(super) const FILAMENT_MM: f64 = std::f64::consts::FRAC_2_SQRT_PI;
/// The places of the parts on the plate, mm.
pub(super) const LOWS_MM: [[f64; 2]; 2] = [[10.0, 10.0], [80.0, 10.0]];

/// A box: its low corner and its size, mm.
pub(super) type Block = ([f64; 3], [f64; 3]);

/// The boxes of a tray of the sound kit: its bottom and its walls.
pub(super) const TRAY: [Block; 5] = [
    ([0.0, 0.0, 0.0], [60.0, 40.0, 3.0]),
    ([0.0, 0.0, 3.0], [60.0, 3.0, 3.0]),
    ([0.0, 37.0, 3.0], [60.0, 3.0, 3.0]),
    ([0.0, 3.0, 3.0], [3.0, 34.0, 3.0]),
    ([57.0, 3.0, 3.0], [3.0, 34.0, 3.0]),
];
/// Three legs of three lengths: it is not its own mirror image.
pub(super) const TRIPOD: [Block; 3] = [
    ([0.0, 0.0, 0.0], [39.0, 12.0, 12.0]),
    ([0.0, 12.0, 0.0], [12.0, 18.0, 12.0]),
    ([0.0, 0.0, 12.0], [12.0, 12.0, 12.0]),
];

/// A print that is as it should be, but for one fault.
#[derive(Clone, Copy)]
pub(super) struct Print {
    pub(super) layer_mm: f64,
    pub(super) density_g_cm3: Option<f64>,
    /// Share of the material in all boxes after the first.
    pub(super) fill_ratio: f64,
    /// The infill that the file states; the share above if it is `None`.
    pub(super) stated_fill_ratio: Option<f64>,
    /// Share of the material in all boxes.
    pub(super) flow_ratio: f64,
    pub(super) scale_ratio: f64,
    pub(super) is_mirrored: bool,
    pub(super) shift_mm: [f64; 2],
}

pub(super) const RIGHT: Print = Print {
    layer_mm: 0.2,
    density_g_cm3: Some(1.2),
    fill_ratio: 1.0,
    stated_fill_ratio: None,
    flow_ratio: 1.0,
    scale_ratio: 1.0,
    is_mirrored: false,
    shift_mm: [0.0, 0.0],
};

impl Print {
    /// Returns the G-code of objects with these labels and places; `None` for no labels.
    pub(super) fn gcode(&self, objects: &[(Option<&str>, [f64; 2], &[Block])]) -> String {
        let mut text = format!(
            "G90\nM83\n; filament_diameter = {FILAMENT_MM}\n; fill_density = {}%\n",
            self.stated_fill_ratio.unwrap_or(self.fill_ratio) * 100.0
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
        let feed = size[0] * pitch_mm * self.layer_mm * ratio * self.flow_ratio;
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
    pub(super) fn trays(&self, labels: [Option<&str>; 2]) -> String {
        let object = |i: usize| (labels[i], LOWS_MM[i], TRAY.as_slice());
        self.gcode(&[object(0), object(1)])
    }
}

/// Returns the sound kit on a filament printer, with its plate.
pub(super) fn kit() -> Evidence {
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
pub(super) fn tripod_kit() -> Evidence {
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
pub(super) fn judge(
    evidence: &Evidence,
    texts: &[String],
) -> Result<PrintedJudgement, PrintedError> {
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
pub(super) fn judged(evidence: &Evidence, text: String) -> PrintedJudgement {
    judge(evidence, &[text]).unwrap()
}

pub(super) fn broken(found: &PrintedJudgement) -> Vec<String> {
    let broken = found.checks.iter().filter(|check| !check.pass);
    broken.map(|check| check.kind.to_string()).collect()
}

pub(super) fn kinds(found: &PrintedJudgement) -> Vec<CauseKind> {
    found.causes.iter().map(|cause| cause.kind).collect()
}

/// Asserts that toolpaths are right and agree with the written parts.
pub(super) fn assert_right(found: &PrintedJudgement) {
    assert_eq!(broken(found), Vec::<String>::new(), "{found:?}");
    assert_eq!(kinds(found), []);
    let toolpaths = found.toolpaths.as_ref().unwrap();
    assert!((toolpaths.mass_g / found.written.mass_g - 1.0).abs() < 1e-9);
    for part in &found.parts {
        assert!(part.center_off_mm < 1e-9, "{part:?}");
        assert!(part.mass_off_ratio().abs() < 1e-9, "{part:?}");
    }
}

pub(super) const LABELS: [Option<&str>; 2] =
    [Some("P01.stl id:0 copy 0"), Some("p02_1 id:1 copy 0")];
