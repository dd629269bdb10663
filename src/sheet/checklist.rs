//! The checklist as data: everything a kit says about itself, key for key as in `checklist.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::certificate::Certificate;
use super::goal::{FootRow, GoalRow, TurnRow};
use super::joints::{BallastRow, CutListRow, JointRow, RoundRow};
use super::parts::PartRow;
use super::printer::{GridRow, MaterialRow, PrinterRow, WallRow};
use super::timing::Timing;
use super::voids::{CutRow, VoidRow};
use crate::verify::{Check, Figures, FillOrder, Hardware, PromisedFigure, SCHEMA};

/// The job sheet of a kit, for machines; the room `page` renders the same for people.
///
/// Lengths in mm, masses in g, angles in degrees, as the keys say. Every number must be finite:
/// [`Checklist::to_json`] refuses the rest. Equal runs give equal bytes as long as `timing_s` is
/// left out, which the kit writer does; `--json` prints it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checklist {
    /// The version of the keys: 1.
    pub schema: u32,
    /// The program that wrote it.
    pub tool: Tool,
    /// The name of the job, used in file names.
    pub job: String,
    /// What went in.
    pub model: ModelRow,
    /// What it will be printed on.
    pub printer: PrinterRow,
    /// What it will be printed of.
    pub material: MaterialRow,
    /// What it must do.
    pub goal: GoalRow,
    /// The figure the buyer may rely on, if the goal has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub promise: Option<PromisedFigure>,
    /// The model filled solid.
    pub solid: Figures,
    /// The uncut result.
    pub hollowed: Figures,
    /// The parts put together, as written.
    pub assembly: Figures,
    /// How near to the best possible the result is.
    pub certificate: Certificate,
    /// The wall.
    pub wall: WallRow,
    /// The voids.
    pub voids: Vec<VoidRow>,
    /// The cuts.
    pub cuts: Vec<CutRow>,
    /// The parts.
    pub parts: Vec<PartRow>,
    /// The glue joints, in the order they are made.
    pub joints: Vec<JointRow>,
    /// What the machine's pixels, lines and layers make of walls, pins and cut faces.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grid: Vec<GridRow>,
    /// What is put in that is not printed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hardware: Vec<Hardware>,
    /// The dowels in its joints, each in its place.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dowels: Vec<Hardware>,
    /// What dowels are to be cut.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut_list: Vec<CutListRow>,
    /// How far the halves of a yo-yo are apart, mm; none where there is one body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub string_gap_mm: Option<f64>,
    /// The extent of the finished object with its hardware, along the model's own axes, mm; none in
    /// kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub finished_size_mm: Option<[f64; 3]>,
    /// What becomes of a yo-yo whose halves are not turned true against each other; none where
    /// there is one body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn: Option<TurnRow>,
    /// How a top stands when it does not spin; none where it falls over, as a top does, and where
    /// it is no top.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foot: Option<FootRow>,
    /// The stock parts that are laid in before gluing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ballast: Vec<BallastRow>,
    /// What the voids are filled with; none for air.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fill: Option<FillOrder>,
    /// The rounds in which material was kept solid around pins.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rounds: Vec<RoundRow>,
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// Whether every promise is kept.
    pub verdict: Verdict,
    /// What a person must know before printing.
    pub warnings: Vec<String>,
    /// What a person may like to know.
    pub notes: Vec<String>,
    /// The SHA-256 of the other files of the kit, by path relative to its folder.
    pub files: BTreeMap<String, String>,
    /// How long each stage took, s; left out of a kit, so that equal runs write equal bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing_s: Option<Timing>,
    /// What the solver did, one row a step.
    pub log: Vec<LogRow>,
}

/// The program that wrote a checklist.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tool {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
}

/// The model as it was used: scaled to mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelRow {
    /// The name of its file, without the folder.
    pub file: String,
    /// The SHA-256 of that file.
    pub sha256: String,
    /// How many triangles it has after repair.
    pub triangles: usize,
    /// Its extent along the axes, mm.
    pub size_mm: [f64; 3],
    /// Its volume filled solid, mm³.
    pub volume_mm3: f64,
    /// What it was multiplied by.
    pub scale_ratio: f64,
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
    /// The verdict over these checks: pass if every one passes.
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
    /// What it was doing.
    pub phase: String,
    /// Its numbers, by name with unit.
    #[serde(flatten)]
    pub figures: BTreeMap<String, f64>,
}

/// Why a checklist cannot be written.
#[derive(Debug, thiserror::Error)]
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
    /// The version of the keys this program writes.
    pub const SCHEMA: u32 = SCHEMA;

    /// The checklist as indented JSON that ends in a newline, with keys in the order of the struct;
    /// reading it back gives an equal checklist. Fails on the first number that is not finite.
    pub fn to_json(&self) -> Result<String, ChecklistError> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        match serde_json::from_str::<Self>(&text) {
            Ok(back) if back == *self => Ok(text),
            // JSON has no NaN: serde writes null, which is either refused on reading or read as a
            // missing value.
            _ => Err(ChecklistError::NotFinite {
                key: first_unfinite_key(&format!("{self:#?}")),
            }),
        }
    }

    /// The same checklist as it goes into a kit: without the timings, which differ from run to run.
    #[must_use]
    pub fn without_timing(&self) -> Self {
        Self {
            timing_s: None,
            ..self.clone()
        }
    }
}

/// The key of the first number in an indented debug print that is NaN or infinite.
fn first_unfinite_key(debug: &str) -> String {
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
