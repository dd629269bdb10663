//! The checklist of a telescope, for people and for machines.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Verdict;
use super::kind::kind_sheet;
use super::pose::PoseRow;
use crate::verify::{
    BalancePromise, Check, DeviationPromise, JointPromise, PrinterLimits, TelescopeBallast,
    TelescopePartPromise,
};

/// The version of the keys.
pub const TELESCOPE_SHEET_SCHEMA: u32 = 1;

/// Everything the sheets of a telescope say: `checklist.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TelescopeSheet {
    /// The version of the keys.
    pub schema: u32,
    /// Always `telescope`.
    pub kind: &'static str,
    /// The name of the job.
    pub job: String,
    /// The version of the program.
    pub version: &'static str,
    /// The verdict over all checks.
    pub verdict: Verdict,
    /// The printer.
    pub printer: TelescopePrinter,
    /// The material.
    pub material: TelescopeMaterial,
    /// The curve.
    pub curve: CurveRow,
    /// The measures of the joints.
    pub joint_sizes: JointSizesRow,
    /// The wall that was ordered, mm.
    pub wall_mm: f64,
    /// The clearance with which shells slide, mm.
    pub clearance_mm: f64,
    /// The source of that clearance.
    pub clearance_source: String,
    /// True if the shop measured that clearance on a coupon.
    pub is_clearance_proved: bool,
    /// True if a ring holds the open telescope.
    pub is_pressed: bool,
    /// True if all shells are printed in each other.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub in_place: bool,
    /// The shells, the root first.
    pub shells: Vec<ShellRow>,
    /// The parts in the order in which they are printed.
    pub parts: Vec<TelescopePartPromise>,
    /// What the shop needs to know of each part, in the same order.
    pub part_rows: Vec<TelescopePartRow>,
    /// The joints as promised.
    pub joints: Vec<JointPromise>,
    /// What the shop needs to know of each joint, in the same order.
    pub joint_rows: Vec<JointRow>,
    /// The ids of the joints in the order in which they open.
    pub order: Vec<Vec<String>>,
    /// The order in words, such as `root first`.
    pub order_words: String,
    /// The least gap between shells that do not slide in each other, over the motion, mm; `None` if
    /// all are of one bend.
    pub least_gap_mm: Option<f64>,
    /// The deviation from the curve.
    pub deviation: DeviationPromise,
    /// The deviation of the tubes' centre lines in any order, mm: Fréchet and Hausdorff.
    pub frechet_mm: f64,
    /// The greatest distance of a point from the other line, mm.
    pub hausdorff_mm: f64,
    /// The deviation that was near enough, mm.
    pub within_mm: f64,
    /// The rms deviation of the method of Yu, Crane and Coros with as many shells, mm.
    pub paper_rms_mm: f64,
    /// The tip's greatest play when all out, mm: all joints tilted the same way.
    pub tip_play_mm: f64,
    /// The mass of all parts, g.
    pub mass_g: f64,
    /// The balance at every key of the motion.
    pub balance: Vec<BalancePromise>,
    /// The least lean at which it topples over the whole motion, with all play taken up, degrees;
    /// `None` if it reaches below its root: it cannot stand there.
    pub worst_toppling_deg: Option<f64>,
    /// The toppling angle that is promised, degrees; `None` if it need not stand.
    pub least_angle_deg: Option<f64>,
    /// The foot; `None` without one.
    pub foot: Option<FootRow>,
    /// The ballast in its foot; empty without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ballast: Vec<TelescopeBallast>,
    /// The box when all in, along the root's axes, mm.
    pub collapsed_mm: [f64; 3],
    /// The box when all out, along the root's axes, mm.
    pub extended_mm: [f64; 3],
    /// Length along the curve over the length of the collapsed telescope.
    pub ratio: f64,
    /// The numbers of shells that were tried.
    pub trade: Vec<TradeRow>,
    /// The poses.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<PoseRow>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// The SHA-256 of every other file of the kit.
    pub files: BTreeMap<String, String>,
}

kind_sheet!(TelescopeSheet);

/// The printer of a telescope.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TelescopePrinter {
    /// Its id.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Height of a layer, mm.
    pub layer_mm: f64,
    /// True if its process lays down filament, which slicers fill sparsely.
    pub is_filament: bool,
    /// The glue for its materials.
    pub glue: Option<String>,
    /// The dangers of that glue.
    pub glue_safety: Option<String>,
    /// Seconds for which glued parts are held.
    pub glue_hold_s: Option<f64>,
    /// Hours after which the glue has its strength.
    pub glue_cure_h: Option<f64>,
    /// The limits by which its parts are judged.
    #[serde(flatten)]
    pub limits: PrinterLimits,
}

/// The material of a telescope.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TelescopeMaterial {
    /// Its id.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Its density, g/cm³.
    pub density_g_cm3: f64,
}

/// The curve of a telescope.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CurveRow {
    /// The file, or its measures.
    pub source: String,
    /// SHA-256 of the file; `None` for measures.
    pub sha256: Option<String>,
    /// Its length, mm.
    pub length_mm: f64,
}

/// The measures of the joints, mm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointSizesRow {
    /// Clearance of the seat.
    pub seat_mm: f64,
    /// Engagement of flange and lip.
    pub engagement_mm: f64,
    /// Length of the flange.
    pub flange_mm: f64,
    /// Length of the lip.
    pub lip_mm: f64,
    /// What stays inside of a shell that is all out.
    pub overlap_mm: f64,
    /// Clearance of the caps' spigots.
    pub glue_mm: f64,
    /// Chamfer of sliding edges.
    pub chamfer_mm: f64,
}

/// A shell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShellRow {
    /// Its id.
    pub id: String,
    /// Curvature, 1/mm.
    pub curvature: f64,
    /// Torsion, 1/mm.
    pub torsion: f64,
    /// Visible length, mm.
    pub visible_mm: f64,
    /// Radius of the body, mm.
    pub body_mm: f64,
    /// Radius of the bore, mm.
    pub bore_mm: f64,
}

/// A part as the shop handles it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TelescopePartRow {
    /// The name on the sheet.
    pub id: String,
    /// How it lies on the plate.
    pub lies: String,
    /// Extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// Mass, g.
    pub mass_g: f64,
    /// True if it prints without support.
    pub is_free_of_support: bool,
    /// The place of support, in words.
    pub support: &'static str,
}

/// A joint as the shop tries it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointRow {
    /// The name on the sheet.
    pub id: String,
    /// The outer and the inner shell.
    pub shells: [String; 2],
    /// How far the inner shell comes out, mm.
    pub stroke_mm: f64,
    /// Tolerance of that, mm either way.
    pub tolerance_mm: f64,
    /// The turn when all out, degrees.
    pub turn_deg: f64,
    /// Play of the turn, degrees either way.
    pub play_deg: f64,
    /// Tilt that the seat allows, degrees.
    pub tilt_deg: f64,
}

/// A foot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FootRow {
    /// Its radius, mm.
    pub radius_mm: f64,
    /// Its height, mm.
    pub height_mm: f64,
}

/// A number of shells that was tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TradeRow {
    /// Number of shells.
    pub shells: usize,
    /// Greatest deviation, mm; `None` if there is no design.
    pub deviation_mm: Option<f64>,
    /// Body radius of the root, mm.
    pub root_mm: Option<f64>,
    /// Length of the collapsed telescope, mm.
    pub collapsed_mm: Option<f64>,
    /// The reason why there is no design.
    pub why: Option<String>,
}
