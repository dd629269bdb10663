//! The rows of voids and of the cuts that open them, and the checks of a void.

use serde::{Deserialize, Serialize};

use crate::verify::Check;

/// A void and how it is cleaned.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VoidRow {
    /// Name on the sheet, such as `V1`.
    pub id: String,
    /// Volume, mm³.
    pub volume_mm3: f64,
    /// Ids of the cuts that open it.
    pub opened_by: Vec<String>,
    /// Ids of the drain holes that open it; empty if cuts do.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drained_by: Vec<String>,
    /// Ids of the parts that hold a piece of it.
    #[serde(default)]
    pub parts: Vec<String>,
    /// Diameter of the largest disc that passes through the openings of all its pieces, mm.
    pub opening_mm: f64,
    /// Least opening it needs, mm.
    pub least_opening_mm: f64,
    /// Distance of its deepest point from the opening, mm.
    pub depth_mm: f64,
    /// Share of its wall in sight of the openings of its own piece and within reach of the tool;
    /// `None` if it was not measured.
    pub sight_ratio: Option<f64>,
    /// The printer's cleaning rule, in words.
    pub method: String,
    /// `true` if the judge found it open and clean by that rule in the written parts.
    pub is_clean: bool,
    /// Instruction to clean it, in a sentence.
    pub clean: String,
}

/// A cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutRow {
    /// Name on the sheet, such as `C1`.
    pub id: String,
    /// Point of its plane, model frame, mm.
    pub point_mm: [f64; 3],
    /// Unit normal of its plane, model frame.
    pub normal: [f64; 3],
    /// Sides of other cuts to which it is limited; empty if it is made everywhere.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub within: Vec<SideRow>,
}

/// A side of a cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SideRow {
    /// Name of the cut on the sheet.
    pub cut: String,
    /// `above` for the side to which its normal points, `below` for the other.
    pub side: String,
}

/// Returns whether all checks of a void pass.
pub fn is_clean(checks: &[Check], void: &str) -> bool {
    checks_of_void(checks, void).all(|check| check.pass)
}

/// Returns the checks of a void.
pub fn checks_of_void<'a>(checks: &'a [Check], void: &str) -> impl Iterator<Item = &'a Check> {
    checks
        .iter()
        .filter(move |check| check.kind.void() == Some(void))
}
