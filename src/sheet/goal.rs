//! The goal as it was placed, and how the finished object behaves.

use serde::{Deserialize, Serialize};

use crate::verify::Aim;

/// The goal as it was placed on the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GoalRow {
    /// What it must do, and about which point and axis.
    #[serde(flatten)]
    pub aim: Aim,
    /// What was made as small or large as possible, such as `critical_speed`.
    pub objective: String,
    /// The weights γ_c of a low centre and γ_I of a flat tensor in Spin-It's functional (its eq.
    /// 7), where that was it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spin_it_weights: Option<[f64; 2]>,
    /// How far the contact point hangs below the surface, mm; zero when the surface is touched. A
    /// tip piece of this length is needed.
    pub contact_gap_mm: f64,
    /// How the axis was chosen, where the job left it open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
}

/// How a top stands on its contact when it does not spin; see [`crate::goal::Resting`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FootRow {
    /// The radius of curvature of the contact over a tilt of a degree, mm: larger than the height,
    /// so it stands.
    pub radius_mm: f64,
    /// The height of the centre of mass over the floor, mm.
    pub center_height_mm: f64,
    /// It rights itself up to this tilt, to a degree, degrees; 45 where it does so at least up to
    /// there.
    pub rights_to_deg: f64,
}

/// What becomes of a yo-yo whose half A is glued on its axle a degree off its turn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TurnRow {
    /// How far half A's own centre of mass is from the axis, mm: what the other half has to make up
    /// for.
    pub half_offset_mm: f64,
    /// How far a degree takes the centre of mass of the whole off the axis, mm.
    pub offset_mm_per_deg: f64,
    /// How far a degree leans the axis of the greatest moment, degrees.
    pub tilt_deg_per_deg: f64,
}
