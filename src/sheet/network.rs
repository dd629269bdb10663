//! The checklist of several telescopes on junctures, for people and for machines.

use std::collections::BTreeMap;

use serde::Serialize;

use super::kind::kind_sheet;
use super::pose::PoseRow;
use super::telescope::{CurveRow, FootRow, TelescopeMaterial, TelescopePrinter, TelescopeSheet};
use super::{KindSheet, Verdict};
use crate::verify::{Check, JuncturePromise, NETWORK_SCHEMA};

/// The version of the keys.
pub const NETWORK_SHEET_SCHEMA: u32 = NETWORK_SCHEMA;

/// Everything the sheets of several telescopes say: `checklist.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NetworkSheet {
    /// The version of the keys.
    pub schema: u32,
    /// Always `network`.
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
    /// The skeleton or the model; its length is the longest side.
    pub input: CurveRow,
    /// Clearance of glued joints, mm.
    pub glue_mm: f64,
    /// Depth of the groove that lets the air out beside a root, mm.
    pub groove_mm: f64,
    /// The file of the model whose pieces the junctures are; `None` if they are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<&'static str>,
    /// The telescopes, each after the one that carries it.
    pub limbs: Vec<LimbRow>,
    /// The junctures. The first stands still.
    pub junctures: Vec<JuncturePromise>,
    /// Facts for the shop about each part of each juncture, in the same order.
    pub juncture_rows: Vec<JunctureRow>,
    /// The joints between parts of one juncture, in the order in which they are glued.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub juncture_joints: Vec<JunctureJointRow>,
    /// The names of the limbs in the order in which they open.
    pub order: Vec<String>,
    /// The limbs that stay solid, in words.
    pub solid: Vec<String>,
    /// The mass of all parts, g.
    pub mass_g: f64,
    /// The lean at which it topples at every key of the motion, degrees; none if it need not stand.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub toppling_deg: Vec<f64>,
    /// The least lean at which it topples over the whole motion, with all play taken up, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_toppling_deg: Option<f64>,
    /// The toppling angle that is promised, degrees; `None` if it need not stand.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_angle_deg: Option<f64>,
    /// The foot under the first juncture; `None` without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub foot: Option<FootRow>,
    /// The centre of mass at every key of the motion, mm, in the model's frame.
    pub centres_mm: Vec<[f64; 3]>,
    /// The box when all in, along the model's axes, mm.
    pub collapsed_mm: [f64; 3],
    /// The box when all out, along the model's axes, mm.
    pub extended_mm: [f64; 3],
    /// The poses.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<PoseRow>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Every promise with its verdict: of each kind the worst of all limbs.
    pub checks: Vec<Check>,
    /// The SHA-256 of every other file of the kit.
    pub files: BTreeMap<String, String>,
}

kind_sheet!(NetworkSheet);

/// A telescope between two junctures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimbRow {
    /// Its name, such as `A`.
    pub id: String,
    /// The juncture that holds its root, from 1.
    pub from: usize,
    /// The juncture that its last shell carries, from 1.
    pub to: usize,
    /// Its own checklist.
    pub sheet: TelescopeSheet,
}

/// A joint between two parts of a juncture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JunctureJointRow {
    /// The juncture.
    pub juncture: String,
    /// The cut in which they meet.
    pub cut: String,
    /// The parts below and above the cut.
    pub parts: [String; 2],
    /// The area that is glued, mm².
    pub area_mm2: f64,
    /// The number of pins between them.
    pub pins: usize,
    /// True if the pins let them together in one way only, and hold them.
    pub is_aligned: bool,
    /// The reason why they are not, with what to do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<&'static str>,
}

/// A part of a juncture as the shop handles it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JunctureRow {
    /// The name on the sheet.
    pub id: String,
    /// The way in which it lies on the plate, in words.
    pub lies: String,
    /// Extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// Mass, g.
    pub mass_g: f64,
    /// True if it prints without support.
    pub is_free_of_support: bool,
}

/// The checklist of one telescope, or of several on junctures.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum AnyTelescopeSheet {
    /// One along a curve.
    Curve(Box<TelescopeSheet>),
    /// Several along a skeleton.
    Network(Box<NetworkSheet>),
}

impl AnyTelescopeSheet {
    fn inner(&self) -> &dyn KindSheet {
        match self {
            Self::Curve(sheet) => &**sheet,
            Self::Network(sheet) => &**sheet,
        }
    }
}

impl KindSheet for AnyTelescopeSheet {
    fn verdict(&self) -> Verdict {
        self.inner().verdict()
    }

    fn checks(&self) -> &[Check] {
        self.inner().checks()
    }

    fn warnings(&self) -> &[String] {
        self.inner().warnings()
    }

    fn list_files(&mut self, files: BTreeMap<String, String>) {
        match self {
            Self::Curve(sheet) => sheet.list_files(files),
            Self::Network(sheet) => sheet.list_files(files),
        }
    }
}
