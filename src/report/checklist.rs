//! The checklist as data: everything a kit says about itself, key for key as in `checklist.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::cleaning::CleaningRow;
use super::course::Course;
use super::finished::TurnRow;
use super::grid::GridRow;
use super::joinery::{CutListRow, RoundRow};
use super::rows::{BallastRow, CutRow, JointRow, PartRow, VoidRow};
use super::timing::Timing;
use super::trials::FootRow;
use crate::verify::{
    Aim, Check, Cleaning, FigureName, Figures, FillOrder, Hardware, PromisedFigure, SCHEMA,
};

/// The job sheet of a kit, for machines; [`super::page`] renders the same for people.
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

/// The printer, as far as the shop and the judge need it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PrinterRow {
    /// The id of its profile.
    pub id: String,
    /// The SHA-256 of that profile and the ones it inherits from.
    #[serde(default)]
    pub profile_sha256: String,
    /// Its name.
    pub name: String,
    /// The process, such as `polyjet` or `fdm`.
    pub process: String,
    /// Pixels or line widths along x and y, mm.
    pub pixel_mm: [f64; 2],
    /// The height of a layer, mm.
    pub layer_mm: f64,
    /// The edges of the build volume, mm; unknown for some machines.
    pub build_volume_mm: Option<[f64; 3]>,
    /// What files are multiplied by along x, y and z so that shrunken parts have their nominal
    /// size; none where files are nominal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub print_scale_ratio: Option<[f64; 3]>,
    /// What holds overhangs and must come out of the voids: `soluble`, `breakaway`, `water-jet` or
    /// `none`.
    pub support: String,
    /// The least wall the process prints, mm.
    pub minimum_wall_mm: f64,
    /// The least opening through which a void can be cleaned, mm.
    pub minimum_opening_mm: f64,
    /// When a void counts as clean.
    pub cleaning: Cleaning,
    /// What each of these numbers rests on, in words: sources, and what is only assumed.
    pub sources: Vec<String>,
}

/// The material the masses rest on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MaterialRow {
    /// The id of its profile.
    pub id: String,
    /// Its name.
    pub name: String,
    /// g/cm³.
    pub density_g_cm3: f64,
    /// Where the density is from.
    pub density_source: String,
    /// How sure that source is, such as `read` or `recalled`.
    pub density_sure: String,
    /// How far the mass of a sound print may be from volume × density, as a share; no weighing
    /// window is printed where it is not known.
    pub density_spread_ratio: Option<f64>,
}

/// The goal as it was placed on the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GoalRow {
    /// What it must do, and about which point and axis.
    #[serde(flatten)]
    pub aim: Aim,
    /// What was made as small or large as possible, such as `critical_speed`.
    pub objective: String,
    /// The weights γ_c of a low centre and γ_I of a flat tensor in Spin-It's functional (its eq.
    /// 7), where that was it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spin_it_weights: Option<[f64; 2]>,
    /// How far the contact point hangs below the surface, mm; zero when the surface is touched. A
    /// tip piece of this length is needed.
    pub contact_gap_mm: f64,
    /// How the axis was chosen, where the job left it open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
}

/// How near to the best possible the result is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The figure that was optimised.
    pub figure: FigureName,
    /// Its value at the solver's optimum.
    pub value: f64,
    /// No hollowing of this model with this wall, in which `kept_solid_mm3` stay solid, can do
    /// better than this; for tops none whose centre of mass is as high.
    pub bound: f64,
    /// The volume of voids that could not have been cleaned: those places, and what lies a minimum
    /// opening around them, were taken out of what may be emptied, mm³.
    pub kept_solid_mm3: f64,
    /// The optimum before anything was kept solid for that; none in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_before_cleaning: Option<f64>,
    /// The rounds in which voids were made smaller because no plan let them be cleaned.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cleaning_rounds: Vec<CleaningRow>,
    /// The volume that could have been emptied, and stays solid in bosses around pins, mm³.
    #[serde(default)]
    pub bosses_mm3: f64,
    /// |value − bound| / |bound|.
    pub gap_ratio: f64,
    /// Tops: what is proved for every height of the centre of mass; none where that was not proved.
    pub over_heights: Option<HeightProof>,
    /// The value of the written assembly.
    pub written_value: Option<f64>,
    /// How value and bound came about; none where that was not recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub course: Option<Course>,
}

/// What is proved of tops with their centre of mass at any height: on the printer's own columns, or
/// on coarser ones where the lever is free too, or the voids are filled.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeightProof {
    /// The pitch of those columns, mm.
    pub pitch_mm: f64,
    /// The optimum on them, in the certificate's figure.
    pub value: f64,
    /// No hollowing on them, with its centre of mass at any height, can do better than this.
    pub bound: f64,
}

/// The wall that was ordered and the one that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WallRow {
    /// The least wall promised, mm: what was asked for, rounded up to what the printer makes.
    pub required_mm: f64,
    /// What was asked for, mm; none where the printer's least was taken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub asked_mm: Option<f64>,
    /// The least distance between a void and the outside on the written surfaces, mm; none without
    /// voids.
    pub measured_min_mm: Option<f64>,
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
