//! The proof of a bound as the checklist has it.

use serde::{Deserialize, Serialize};

/// The claim that no hollowing of the model with this wall is better, and its proof.
///
/// Lengths are in mm and the goal's frame, but for the kept places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoundProof {
    /// The value that no hollowing can beat, in the unit of the certificate's figure.
    pub bound: f64,
    /// The wall, mm.
    pub wall_mm: f64,
    /// The other places that stay solid.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub keeps: Vec<KeptPlace>,
    /// The points of the dual: one, or for a top one for each of several heights.
    pub points: Vec<BoundPoint>,
    /// Tops: the multipliers that prove the least and the greatest height of the centre.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends: Option<[Vec<f64>; 2]>,
    /// Toppling angle: the edges of the support that the weights are for. Each is an inward unit
    /// normal and the offset along it, mm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edges: Vec<[f64; 3]>,
}

/// A place that stays solid besides the wall: the points near a segment, model frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct KeptPlace {
    /// One end of the segment, mm.
    pub from_mm: [f64; 3],
    /// The other end, mm.
    pub to_mm: [f64; 3],
    /// The distance from it, mm.
    pub radius_mm: f64,
}

/// A point of the dual.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoundPoint {
    /// Tops: the height at which the tensor is linear, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_mm: Option<f64>,
    /// The weights of the convex part of the goal.
    pub weights: Vec<f64>,
    /// A multiplier for each constraint.
    pub multipliers: Vec<f64>,
}
