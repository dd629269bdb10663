//! The voids, the cuts that open them, and the checks that they are clean.

use serde::{Deserialize, Serialize};

use crate::verify::Check;

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

/// Whether the checks of a void pass.
pub fn is_clean(checks: &[Check], void: &str) -> bool {
    checks_of_void(checks, void).all(|check| check.pass)
}

/// The checks that are about a void.
pub fn checks_of_void<'a>(checks: &'a [Check], void: &str) -> impl Iterator<Item = &'a Check> {
    checks
        .iter()
        .filter(move |check| check.kind.void() == Some(void))
}
