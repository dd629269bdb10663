//! The promises of a telescope: the judge's own narrow view of `checklist.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::pose::PosePromise;
use crate::mass::Lump;
use crate::verify::{Density, Pose, PrinterLimits};

/// The promises of a telescope's kit, and the data needed to judge its files by them.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct TelescopePromise {
    /// The version of the keys.
    pub schema: u32,
    /// The limits of the printer.
    pub printer: PrinterLimits,
    /// The material of the parts.
    pub material: Density,
    /// The wall that was ordered, mm.
    pub wall_mm: f64,
    /// The clearance with which shells slide, mm.
    pub clearance_mm: f64,
    /// True if all shells are printed in each other.
    #[serde(default)]
    pub in_place: bool,
    /// The parts.
    pub parts: Vec<TelescopePartPromise>,
    /// The joints.
    pub joints: Vec<JointPromise>,
    /// The deviation from the curve.
    pub deviation: DeviationPromise,
    /// The balance at every key of the motion.
    pub balance: Vec<BalancePromise>,
    /// The mass of all parts, g.
    pub mass_g: f64,
    /// The toppling angle that is promised at every key, degrees; `None` if it need not stand.
    pub least_angle_deg: Option<f64>,
    /// The box of all parts when all in, along the root's tangent, normal and binormal, mm.
    pub collapsed_mm: [f64; 3],
    /// The same when all out, mm.
    pub extended_mm: [f64; 3],
    /// The ballast in its foot.
    #[serde(default)]
    pub ballast: Vec<TelescopeBallast>,
    /// The poses.
    #[serde(default)]
    pub poses: Vec<PosePromise>,
    /// The SHA-256 of every other file of the kit.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
}

/// A part as the kit names it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TelescopePartPromise {
    /// The name on the sheet, such as `S01`.
    pub id: String,
    /// The shell in whose frame it lies, from 1.
    pub shell: usize,
    /// True for the tube, false for its cap.
    pub is_tube: bool,
    /// Radius of a tube's body, mm.
    pub body_mm: f64,
    /// Its file, relative to the kit.
    pub file: String,
    /// The SHA-256 of that file, in hex.
    pub sha256: String,
    /// Coordinates of the shell's frame to print coordinates.
    pub print_from_shell: Pose,
    /// The hole along the binormal through which powder leaves a tube: its arc and radius, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vent_mm: Option<[f64; 2]>,
}

/// A piece of ballast in the foot, in the root's frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TelescopeBallast {
    /// The id under which it is ordered.
    pub id: String,
    /// Its name in a shop.
    pub name: String,
    /// The piece in its place.
    #[serde(flatten)]
    pub lump: Lump,
}

/// A joint as the kit promises it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointPromise {
    /// The name on the sheet, such as `J01`.
    pub id: String,
    /// The slide at which the stop holds, without a turn, mm.
    pub stop_mm: f64,
    /// The slide up to which the whole clearance is free, mm.
    pub free_to_mm: f64,
    /// The slide below which the shell before holds the inner one from behind, mm.
    pub back_mm: f64,
    /// The play of the twist stop, rad.
    pub play_rad: f64,
}

/// The deviation from the curve, at equal shares of the length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DeviationPromise {
    /// The greatest distance, mm.
    pub max_mm: f64,
    /// The root of the mean square, mm.
    pub rms_mm: f64,
}

/// The balance at a key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BalancePromise {
    /// The centre of mass in the model frame, mm.
    pub centre_mm: [f64; 3],
    /// The lean at which it topples, degrees; `None` if it reaches below its root's tail, so it
    /// cannot stand there.
    pub toppling_deg: Option<f64>,
}
