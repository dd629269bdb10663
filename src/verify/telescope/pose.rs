//! Poses as a kit writes and promises them.

use serde::{Deserialize, Serialize};

use crate::verify::Pose;

/// Slide (mm) and turn (rad) of every joint of every telescope. A single one is the first.
pub type PoseState = Vec<Vec<[f64; 2]>>;

/// The distance up to which a tip is in its place, mm.
pub const REACH_LIMIT_MM: f64 = 1.0;

/// A pose in `motion.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PoseMotion {
    /// Its name.
    pub name: String,
    /// The states between moves, from all in to the pose.
    pub keys: Vec<PoseState>,
    /// The frame of every shell of every telescope in the pose, in the model frame, by rows.
    pub shells: Vec<Vec<Pose>>,
}

/// A pose as the kit promises it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PosePromise {
    /// Its name.
    pub name: String,
    /// Its file, relative to the kit.
    pub file: String,
    /// The ends of telescopes.
    pub tips: Vec<PoseTipPromise>,
}

/// A pose file as the judge reads it: joints that it does not name are all out.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PoseText {
    /// Always `pose`.
    pub kind: String,
    /// The name of the pose.
    pub name: String,
    /// The joints.
    #[serde(default)]
    pub joint: Vec<PoseTextJoint>,
}

/// A joint in a pose file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PoseTextJoint {
    /// Its id.
    pub id: String,
    /// The stroke by which its shell is out, mm.
    pub stroke_mm: f64,
    /// Its turn, degrees.
    #[serde(default)]
    pub turn_deg: f64,
}

/// The end of a telescope in a pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PoseTipPromise {
    /// Its name on the sheet.
    pub id: String,
    /// The telescope that ends there, from 1.
    pub limb: usize,
    /// The place that was wanted, mm; `None` if none was.
    pub wanted_mm: Option<[f64; 3]>,
    /// The place where it is, mm.
    pub reached_mm: [f64; 3],
}

/// The facts about the poses of a kit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PosesFacts {
    /// The greatest distance of a tip from its wanted place, mm; `None` if none is wanted.
    pub off_mm: Option<f64>,
    /// That tip, and its pose.
    pub farthest: Option<String>,
    /// Faults, in words.
    pub faults: Vec<String>,
}
