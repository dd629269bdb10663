//! Junctures as they were written: in one part, or divided by cuts for a small printer.

use serde::{Deserialize, Serialize};

use crate::mesh::TriMesh;
use crate::verify::{Mark, PartEvidence, Peg, Pose, PromisedCut};

/// A juncture as the kit names it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JuncturePromise {
    /// The name on the sheet, such as `N01`.
    pub id: String,
    /// Its parts: one, or those between its cuts.
    pub parts: Vec<JuncturePartPromise>,
    /// The cuts that divide it; `None` if it is one part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub divided: Option<DividedPromise>,
}

/// A part of a juncture as the kit names it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JuncturePartPromise {
    /// The name on the sheet, such as `N01`, or `N01-P02` of a divided one.
    pub id: String,
    /// Its file, relative to the kit.
    pub file: String,
    /// The SHA-256 of that file, in hex.
    pub sha256: String,
    /// Coordinates of the model, with all out, to print coordinates.
    pub print_from_model: Pose,
    /// The pins that stand out of its cuts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pins: Vec<Peg>,
    /// The sockets in its cuts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sockets: Vec<Peg>,
    /// The ids that are sunk into its cuts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub marks: Vec<Mark>,
}

/// The cuts of a juncture, and what its parts are together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DividedPromise {
    /// Its volume before it was cut, mm³.
    pub volume_mm3: f64,
    /// The gap between pin and socket on each side, mm.
    pub clearance_mm: f64,
    /// The cuts.
    pub cuts: Vec<PromisedCut>,
}

/// A joint between two parts of a juncture as the kit names it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct JunctureJointPromise {
    /// The juncture.
    pub juncture: String,
    /// The parts that meet.
    pub parts: [String; 2],
    /// The number of pins between them.
    pub pins: usize,
    /// True if the pins let them together in one way only, and hold them.
    pub is_aligned: bool,
}

/// A part of a juncture, where it is when all is out.
pub(super) struct Piece<'a> {
    /// The juncture, from 0.
    pub juncture: usize,
    pub promise: &'a JuncturePartPromise,
    pub mesh: TriMesh,
}

/// Returns a part in the model's frame.
pub(super) fn in_model(part: &PartEvidence) -> TriMesh {
    part.mesh.map_vertices(|p| part.pose.to_model(p))
}
