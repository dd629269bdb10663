//! The poses of telescopes, for people and for machines.

use serde::Serialize;

use crate::verify::PoseTipPromise;

/// A pose that is part of a kit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PoseRow {
    /// Its name.
    pub name: String,
    /// Its file, to edit and give back.
    pub file: String,
    /// The ends of limbs, where they are, and where they were wanted.
    pub tips: Vec<PoseTipPromise>,
    /// The greatest distance of a tip from its place, mm; `None` if none was wanted.
    pub off_mm: Option<f64>,
    /// The joints in the order in which they move. The others stay all in.
    pub joints: Vec<PoseJointRow>,
    /// The least gap between shells of one limb that do not slide in each other, on the way there,
    /// mm; `None` if all are of one bend.
    pub least_gap_mm: Option<f64>,
}

/// A joint of a pose as the shop sets it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PoseJointRow {
    /// Its id.
    pub id: String,
    /// The stroke by which its shell is out, mm.
    pub stroke_mm: f64,
    /// The stroke when all out, mm.
    pub whole_mm: f64,
    /// Its turn, degrees.
    pub turn_deg: f64,
}
