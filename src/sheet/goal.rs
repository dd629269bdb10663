//! The goal as it was placed, and the behaviour of the finished object.

use serde::{Deserialize, Serialize};

use crate::goal::Objective;
use crate::verify::{Aim, SpinFacts};

/// The goal as it was placed on the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GoalRow {
    /// Kind of the goal, and the point and axis it is about.
    #[serde(flatten)]
    pub aim: Aim,
    /// Objective that was made as small or as large as possible.
    pub objective: ObjectiveName,
    /// Weights γ_c of a low centre and γ_I of a flat tensor in Spin-It's functional (its eq. 7), if
    /// that was the objective.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spin_it_weights: Option<[f64; 2]>,
    /// Depth of the contact point below the surface, mm; zero if the surface touches it. A tip of
    /// this length is needed.
    pub contact_gap_mm: f64,
    /// Top: the part that touches the floor; `None` for other goals, and in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spins_on: Option<SpinFacts>,
    /// Rotor: the round surfaces that it turns on, the largest first; empty for other goals, and in
    /// kits of older versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub turns_on: Vec<ShaftRow>,
    /// Reason for the choice of the axis, if the job left it open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
    /// Angle between the axis and the natural up, on which the goal is not possible, degrees.
    /// `None` if the axis is the natural up or was ordered, and in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub off_natural_deg: Option<f64>,
}

/// A round surface that a rotor turns on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShaftRow {
    /// Kind.
    pub kind: ShaftKind,
    /// Diameter, mm.
    pub diameter_mm: f64,
}

/// The kind of a round surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShaftKind {
    /// A bore of the model.
    Bore,
    /// An end of the model that is a shaft.
    ShaftEnd,
    /// A bore that will be made along the axis.
    BoreToMake,
}

/// An [`Objective`] without its weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ObjectiveName {
    /// Top: the least speed at which it stays upright.
    CriticalSpeed,
    /// Top and yo-yo: the least value of Spin-It's functional.
    SpinIt,
    /// Yo-yo: the most dominant axis.
    Dominance,
    /// Stand: the largest tilt before it topples.
    TopplingAngle,
    /// Stand: the lowest centre of mass.
    LowestCenter,
    /// Float: the greatest metacentric height.
    MetacentricHeight,
    /// Balance: the least material removed.
    LeastRemoved,
    /// Balance: the least unbalance.
    LeastUnbalance,
    /// Match: the least change of infill.
    LeastChange,
}

impl From<Objective> for ObjectiveName {
    fn from(objective: Objective) -> Self {
        match objective {
            Objective::CriticalSpeed => Self::CriticalSpeed,
            Objective::SpinIt { .. } => Self::SpinIt,
            Objective::Dominance => Self::Dominance,
            Objective::TopplingAngle => Self::TopplingAngle,
            Objective::LowestCenter => Self::LowestCenter,
            Objective::MetacentricHeight => Self::MetacentricHeight,
            Objective::LeastRemoved => Self::LeastRemoved,
            Objective::LeastUnbalance => Self::LeastUnbalance,
            Objective::LeastChange => Self::LeastChange,
        }
    }
}

/// The stand of a top that does not spin; see [`crate::goal::FootStability`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FootRow {
    /// Radius of curvature of the contact over a tilt of a degree, mm. It is larger than the height
    /// of the centre of mass, so the top stands.
    pub radius_mm: f64,
    /// Height of the centre of mass over the floor, mm.
    pub center_height_mm: f64,
    /// Tilt from which it still rights itself, to a degree, degrees; 45 if it does so from at least
    /// 45°.
    pub rights_to_deg: f64,
}

/// The effect on a yo-yo if half A is glued on the axle one degree off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TurnRow {
    /// Distance of half A's own centre of mass from the axis, mm: the other half balances it.
    pub half_offset_mm: f64,
    /// Distance by which one degree moves the centre of mass of the whole off the axis, mm.
    pub offset_mm_per_deg: f64,
    /// Angle by which one degree tilts the axis of the greatest moment, degrees.
    pub tilt_deg_per_deg: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objectives_keep_their_words_with_underscores() {
        for word in Objective::WORDS {
            let objective: Objective = word.parse().unwrap();
            let name = serde_json::to_value(ObjectiveName::from(objective)).unwrap();
            assert_eq!(name, word.replace('-', "_"));
        }
    }
}
