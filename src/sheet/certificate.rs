//! How near to the best possible a result is, and how the answer came about.

use serde::{Deserialize, Serialize};

use crate::verify::FigureName;

/// How near to the best possible the result is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The figure that was optimised.
    pub figure: FigureName,
    /// Its value at the solver's optimum.
    pub value: f64,
    /// No hollowing of this model with this wall, in which `kept_solid_mm3` stay solid, can do
    /// better than this; for tops none whose centre of mass is as high.
    pub bound: f64,
    /// The volume of voids that could not have been cleaned: those places, and what lies a minimum
    /// opening around them, were taken out of what may be emptied, mm³.
    pub kept_solid_mm3: f64,
    /// The optimum before anything was kept solid for that; none in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_before_cleaning: Option<f64>,
    /// The rounds in which voids were made smaller because no plan let them be cleaned.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cleaning_rounds: Vec<CleaningRow>,
    /// The volume that could have been emptied, and stays solid in bosses around pins, mm³.
    #[serde(default)]
    pub bosses_mm3: f64,
    /// |value − bound| / |bound|.
    pub gap_ratio: f64,
    /// Tops: what is proved for every height of the centre of mass; none where that was not proved.
    pub over_heights: Option<HeightProof>,
    /// The value of the written assembly.
    pub written_value: Option<f64>,
    /// How value and bound came about; none where that was not recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub course: Option<Course>,
}

/// What is proved of tops with their centre of mass at any height: on the printer's own columns, or
/// on coarser ones where the lever is free too, or the voids are filled.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeightProof {
    /// The pitch of those columns, mm.
    pub pitch_mm: f64,
    /// The optimum on them, in the certificate's figure.
    pub value: f64,
    /// No hollowing on them, with its centre of mass at any height, can do better than this.
    pub bound: f64,
}

/// One round in which ends of voids were kept solid, most often because they could not be cleaned,
/// and the rest solved for again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CleaningRow {
    /// The voids, as they were numbered then, and why.
    pub voids: Vec<KeptRow>,
    /// The volume that was kept solid, without the room about it, mm³.
    pub volume_mm3: f64,
    /// The certificate's figure before the round.
    pub value_before: f64,
    /// And after it; none where the goal could not have been met any more, so that the round was
    /// taken back.
    pub value_after: Option<f64>,
    /// Whether it is not cleaning that asked for it but the plan, which keeps solid what lies
    /// beyond joints without room for pins, or what a person wrote into it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub by_plan: bool,
}

/// A void of which something was kept solid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptRow {
    /// Its name in that round, such as `V1`.
    pub void: String,
    /// Why, in words with numbers.
    pub why: String,
}

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
