//! The checklist: everything a kit says about itself.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::certificate::Certificate;
use super::goal::{FootRow, GoalRow, TurnRow};
use super::joints::{BallastRow, CutListRow, JigRow, JointRow, RoundRow};
use super::parts::PartRow;
use super::print_time::PrintTimeRow;
use super::printer::{GridRow, MaterialRow, PrinterRow, WallRow};
use super::timing::Timing;
use super::toolpaths::ToolpathsRow;
use super::voids::{CutRow, VoidRow};
use crate::printer::Plate;
use crate::repair::RepairOrder;
use crate::verify::{
    CellsOrder, Check, Figures, FillOrder, Hardware, InfillOrder, LaidOrder, PromisedFigure,
    PromisedHole, PromisedPlate, PromisedPlug, SCHEMA,
};

/// The job sheet of a kit, for machines; the room `page` renders the same for people.
///
/// Lengths are in mm, masses in g, angles in degrees, as the keys say. Every number must be finite:
/// [`Checklist::to_json`] refuses others. Equal runs give equal bytes without `timing_s`, which
/// [`Checklist::without_timing`] leaves out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checklist {
    /// Version of the keys: 1.
    pub schema: u32,
    /// The program that wrote it.
    pub tool: Tool,
    /// Name of the job, used in file names.
    pub job: String,
    /// Model.
    pub model: ModelRow,
    /// Printer.
    pub printer: PrinterRow,
    /// Material.
    pub material: MaterialRow,
    /// Goal as it was placed on the model.
    pub goal: GoalRow,
    /// Figure the buyer may rely on, if the goal has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub promise: Option<PromisedFigure>,
    /// Figures of the model filled solid.
    pub solid: Figures,
    /// Figures of the uncut result.
    pub hollowed: Figures,
    /// Figures of the written parts put together.
    pub assembly: Figures,
    /// Proof of how near the result is to the best possible.
    pub certificate: Certificate,
    /// Wall as ordered and as measured.
    pub wall: WallRow,
    /// Voids.
    pub voids: Vec<VoidRow>,
    /// Drain holes of an uncut piece; empty for others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drains: Vec<PromisedHole>,
    /// Cells inside of an uncut piece; `None` for others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cells: Option<CellsOrder>,
    /// Cuts.
    pub cuts: Vec<CutRow>,
    /// Parts.
    pub parts: Vec<PartRow>,
    /// Glue joints, in the order they are made.
    pub joints: Vec<JointRow>,
    /// Jigs that hold parts while their glue sets: tools, not counted in any mass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub jigs: Vec<JigRow>,
    /// Plates, and what lies where on them; empty in kits without 3MF files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub plates: Vec<PromisedPlate>,
    /// Time and filament of the plates by a slicer; `None` if none was ordered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub print_time: Option<PrintTimeRow>,
    /// Lengths of walls, pins and cut faces as the machine's pixels, lines and layers make them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grid: Vec<GridRow>,
    /// Hardware, which is put in and not printed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hardware: Vec<Hardware>,
    /// Dowels in the joints, each in its place.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dowels: Vec<Hardware>,
    /// Dowels to cut.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut_list: Vec<CutListRow>,
    /// Gap between the halves of a yo-yo, mm; `None` for a single body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub string_gap_mm: Option<f64>,
    /// Extent of the finished object with its hardware, along the model's own axes, mm; `None` in
    /// kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub finished_size_mm: Option<[f64; 3]>,
    /// Tolerance of that extent by the printer's profile, ± mm; `None` in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_tolerance_mm: Option<f64>,
    /// Effect of turning one half of a yo-yo against the other; `None` for a single body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn: Option<TurnRow>,
    /// Stand of a top that does not spin; `None` if it falls over, as tops do, or is no top.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foot: Option<FootRow>,
    /// Stock parts that are laid in before gluing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ballast: Vec<BallastRow>,
    /// Filling of the voids; `None` for air.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fill: Option<FillOrder>,
    /// Regions of sparse infill in one piece; `None` for a print that is solid but for its voids.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub infill: Option<InfillOrder>,
    /// What a slicer lays beyond the written parts; `None` if nobody sliced a hollow kit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub laid: Option<LaidOrder>,
    /// Toolpaths of the kit, weighed when it was made; `None` if nobody sliced it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub toolpaths: Option<ToolpathsRow>,
    /// Rounds in which material was kept solid around pins.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rounds: Vec<RoundRow>,
    /// Checks of all promises.
    pub checks: Vec<Check>,
    /// Verdict over all checks.
    pub verdict: Verdict,
    /// Warnings that a person must read before printing.
    pub warnings: Vec<String>,
    /// Other plans that a person may prefer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub offers: Vec<String>,
    /// Notes that a person may want to read.
    pub notes: Vec<String>,
    /// SHA-256 of the other files of the kit, by path relative to its folder.
    pub files: BTreeMap<String, String>,
    /// Duration of each stage, s; left out of a kit, so that equal runs write equal bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing_s: Option<Timing>,
    /// Steps of the solver.
    pub log: Vec<LogRow>,
}

/// The program that wrote a checklist.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tool {
    /// Name.
    pub name: String,
    /// Version.
    pub version: String,
}

/// The model as it was used, scaled to mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelRow {
    /// Name of its file, without the folder.
    pub file: String,
    /// SHA-256 of that file.
    pub sha256: String,
    /// The repairs that were asked for, as in `job.toml`.
    #[serde(default, skip_serializing_if = "RepairOrder::is_auto")]
    pub repair: RepairOrder,
    /// The new surface that was drawn for it; `None` if it kept its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub redrawn: Option<RedrawnRow>,
    /// Number of triangles after repair.
    pub triangles: usize,
    /// Extent along the axes, mm.
    pub size_mm: [f64; 3],
    /// Volume filled solid, mm³.
    pub volume_mm3: f64,
    /// Factor it was scaled by.
    pub scale_ratio: f64,
    /// The thickening of its thin features; `None` if they were left as they are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickened: Option<ThickenedRow>,
}

/// The new surface of a model that could not be mended.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RedrawnRow {
    /// Its tolerance, mm.
    pub within_mm: f64,
    /// The greatest distance that was measured between it and the old surface, mm.
    pub moved_mm: f64,
}

/// The thickening of thin features.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ThickenedRow {
    /// The wall up to which they were thickened, mm.
    pub wall_mm: f64,
    /// The greatest distance by which the surface moved outward, mm.
    pub moved_mm: f64,
    /// The volume that was added, mm³.
    pub added_mm3: f64,
}

/// The verdict over all checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Every promise is kept.
    Pass,
    /// At least one is not.
    Fail,
}

impl Verdict {
    /// Returns the verdict over these checks: pass if all pass.
    pub fn of(checks: &[Check]) -> Self {
        if checks.iter().all(|check| check.pass) {
            Self::Pass
        } else {
            Self::Fail
        }
    }
}

/// One step of the solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LogRow {
    /// Phase of the solver.
    pub phase: String,
    /// Numbers of the step, by name with unit.
    #[serde(flatten)]
    pub figures: BTreeMap<String, f64>,
}

/// The reason why a checklist cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChecklistError {
    /// A number is infinite or not a number.
    #[error(
        "`{key}` of the checklist is not a finite number; this is a fault of the program, please report it"
    )]
    NotFinite {
        /// The first key whose number is not finite.
        key: String,
    },
    /// The data cannot be put into JSON.
    #[error("the checklist cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

impl Checklist {
    /// Returns the drain hole that a part closes; `None` for a part that is no plug.
    pub fn hole_of_plug(&self, part: &str) -> Option<&PromisedHole> {
        let mut plugs = self.plugs();
        let own = plugs.find(|(_, plug)| plug.part == part);
        own.map(|(hole, _)| hole)
    }

    /// Returns the drain holes that are closed by plugs, with their plugs.
    pub fn plugs(&self) -> impl Iterator<Item = (&PromisedHole, &PromisedPlug)> {
        let drains = self.drains.iter();
        drains.filter_map(|hole| Some((hole, hole.plug.as_ref()?)))
    }

    /// Version of the keys that this program writes.
    pub const SCHEMA: u32 = SCHEMA;

    /// Returns the checklist as indented JSON that ends in a newline, with keys in the order of the
    /// struct. Reading it back gives an equal checklist. Fails on the first number that is not
    /// finite.
    pub fn to_json(&self) -> Result<String, ChecklistError> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        match serde_json::from_str::<Self>(&text) {
            Ok(back) if back == *self => Ok(text),
            // JSON has no NaN: serde writes null, which is refused on reading or read as a missing
            // value.
            _ => Err(ChecklistError::NotFinite {
                key: first_non_finite_key(&format!("{self:#?}")),
            }),
        }
    }

    /// Returns the tolerance of the finished extent, ± mm: the printer's, and the largest step that
    /// a joint may leave. Steps of several joints hardly ever add up. `None` in kits of older
    /// versions.
    pub fn size_within_mm(&self) -> Option<f64> {
        let steps_mm = self.joints.iter().filter_map(|joint| joint.play);
        let step_mm = steps_mm.map(|play| play.step_mm).fold(0.0, f64::max);
        self.size_tolerance_mm
            .map(|printed_mm| printed_mm + step_mm)
    }

    /// Returns the names of the kit's plates: the files that hold all parts of a print.
    pub fn plate_files(&self) -> impl Iterator<Item = &str> {
        let files = self.files.keys().map(String::as_str);
        files.filter(|file| Plate::is_file_name(file))
    }

    /// Returns the checklist as it goes into a kit: without the timings, which differ from run to
    /// run.
    #[must_use]
    pub fn without_timing(&self) -> Self {
        Self {
            timing_s: None,
            ..self.clone()
        }
    }
}

/// Returns the key of the first number in an indented debug print that is NaN or infinite.
fn first_non_finite_key(debug: &str) -> String {
    let mut key = "";
    for line in debug.lines().map(str::trim) {
        let (name, value) = line.split_once(": ").unwrap_or((key, line));
        if matches!(value.trim_end_matches(','), "NaN" | "inf" | "-inf") {
            return name.to_owned();
        }
        key = if line.contains(": ") { name } else { key };
    }
    "a number".to_owned()
}
