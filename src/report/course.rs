//! How the answer came about: the numbers behind the plots of the proof.

use serde::{Deserialize, Serialize};

/// Value and bound by pass, and a top's speed by height, on coarse columns.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// The last ascent from nothing, in the certificate's figure.
    pub passes: Vec<PassRow>,
    /// Tops: what is best with the centre of mass at a height; heights ascending.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub speeds: Vec<SpeedRow>,
}

/// One pass over the columns.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PassRow {
    /// What the interior at hand reaches, in the certificate's figure; it meets the constraints at
    /// the end only.
    pub value: f64,
    /// What no interior beats.
    pub bound: f64,
}

/// The best top with its centre of mass at a height.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpeedRow {
    /// The height over the contact, mm.
    pub height_mm: f64,
    /// The least speed at which it could stay upright, rpm.
    pub critical_speed_rpm: f64,
}
