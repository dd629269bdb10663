//! The rows of the checklist's tables: voids, cuts, parts, pins and joints.

use serde::{Deserialize, Serialize};

use super::support::SupportRow;
use crate::verify::{BallastOrder, Fingerprint, GlueFilm, Mark, Peg, Pose};

/// One void and how it is cleaned.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VoidRow {
    /// Its name on the sheet, such as `V1`.
    pub id: String,
    /// mm³.
    pub volume_mm3: f64,
    /// The ids of the cuts that open it.
    pub opened_by: Vec<String>,
    /// The ids of the parts that hold a piece of it.
    #[serde(default)]
    pub parts: Vec<String>,
    /// The diameter of the largest disc that passes the opening of each of its pieces, mm.
    pub opening_mm: f64,
    /// The least opening it needs, mm.
    pub least_opening_mm: f64,
    /// How far its deepest point lies from the opening, mm.
    pub depth_mm: f64,
    /// The share of its wall in sight of the openings of its own piece and within the tool's reach;
    /// none where it was not measured.
    pub sight_ratio: Option<f64>,
    /// The printer's cleaning rule, in words.
    pub method: String,
    /// Whether it is open and clean by that rule, as the judge found in the written parts.
    pub is_clean: bool,
    /// How to clean it, in a sentence.
    pub clean: String,
}

/// One cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutRow {
    /// Its name on the sheet, such as `C1`.
    pub id: String,
    /// A point of its plane, model frame, mm.
    pub point_mm: [f64; 3],
    /// The unit normal of its plane, model frame.
    pub normal: [f64; 3],
    /// The sides of other cuts on which alone it is made; everywhere where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub within: Vec<SideRow>,
}

/// A side of a cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SideRow {
    /// The cut's name on the sheet.
    pub cut: String,
    /// `above` where its normal points to, `below` where it points away from.
    pub side: String,
}

/// One part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PartRow {
    /// Its name on the sheet, such as `P01`.
    pub id: String,
    /// Its file, relative to the kit.
    pub file: String,
    /// The SHA-256 of that file.
    pub sha256: String,
    /// What its shape is known by when the file comes back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<Fingerprint>,
    /// How many triangles it has.
    pub triangles: usize,
    /// mm³.
    pub volume_mm3: f64,
    /// What it should weigh, g.
    pub mass_g: f64,
    /// Its extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// How it lies on the plate, in words, such as `cut C1 down`.
    pub lies: String,
    /// Model coordinates to print coordinates, rows.
    pub print_from_model: Pose,
    /// The pins that stand out of it.
    pub pins: Vec<Peg>,
    /// The sockets sunk into it.
    pub sockets: Vec<Peg>,
    /// The ids sunk into its cut faces.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub marks: Vec<Mark>,
    /// Which half of a yo-yo it belongs to: `A` above the spin point, `B` below it; none where
    /// there are no halves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half: Option<String>,
    /// The volume of its open hollows whose only mouth lies flat on the plate, mm³: closed cups
    /// while it is printed.
    #[serde(default)]
    pub cup_mm3: f64,
    /// What of it hangs in the air as it lies; none where the printer does not say which surfaces
    /// print without support.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<SupportRow>,
    /// Its picture, relative to the kit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
}

/// One glue joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointRow {
    /// Its name on the sheet, such as `J1`.
    pub id: String,
    /// The cut it lies in.
    pub cut: String,
    /// The two parts it joins.
    pub parts: [String; 2],
    /// The area of glue, mm².
    pub area_mm2: f64,
    /// How many pins align it; zero where there was no room.
    pub pins: usize,
    /// The gap between pin and socket on each side, mm.
    pub clearance_mm: f64,
    /// The film of glue in it, which the figures of the assembly count; none where the printer's
    /// profile says nothing of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glue: Option<GlueFilm>,
    /// What to mind, such as where a joint has no room for pins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// One stock part that is laid into its pocket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallastRow {
    /// Its name on the sheet, its shape, mass and place.
    #[serde(flatten)]
    pub order: BallastOrder,
    /// What it is ordered by, such as `ball-4`.
    pub part: String,
    /// What it is called in a shop.
    pub name: String,
    /// The void that is its pocket.
    pub void: String,
    /// The ids of the cuts that open the pocket.
    pub opened_by: Vec<String>,
    /// The gap around it, mm.
    pub clearance_mm: f64,
    /// By how much of it the mass of a good part may differ.
    pub mass_spread_ratio: f64,
    /// Where its sizes and its mass are from.
    pub sources: [String; 2],
}
