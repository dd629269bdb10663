//! The certificate: the distance of the result from the best possible, and how it was found.

use serde::{Deserialize, Serialize};

use crate::verify::{BoundProof, FigureName};

/// The proof of how near the result is to the best possible.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The figure that was optimised.
    pub figure: FigureName,
    /// Value at the solver's optimum.
    pub value: f64,
    /// Proved bound: no hollowing of this model does better with this wall and `kept_solid_mm3`
    /// left solid. For tops it holds for hollowings whose centre of mass is as high.
    pub bound: f64,
    /// Volume that stays solid because voids there could not be cleaned, mm³. A minimum opening
    /// around those voids counts too.
    pub kept_solid_mm3: f64,
    /// Optimum before anything was kept solid for cleaning; `None` in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_before_cleaning: Option<f64>,
    /// Rounds in which voids were made smaller, most often because no plan let them be cleaned.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cleaning_rounds: Vec<CleaningRow>,
    /// Volume that could have been emptied but stays solid in bosses around pins, mm³.
    #[serde(default)]
    pub bosses_mm3: f64,
    /// Relative distance of value and bound, |value − bound| / |bound|.
    pub gap_ratio: f64,
    /// Tops: the proof for all heights of the centre of mass; `None` if there is none.
    pub over_heights: Option<HeightProof>,
    /// Value of the written assembly.
    pub written_value: Option<f64>,
    /// The proof that no hollowing with the wall is better, before anything was kept solid for
    /// cleaning. `None` if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proof: Option<BoundProof>,
    /// Values and bounds during the search; `None` if they were not recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub course: Option<Course>,
}

impl Certificate {
    /// Returns a value as a share of the best possible, 1 at the bound.
    pub fn share_of_bound(&self, value: f64) -> f64 {
        match self.figure.more_is_better() {
            true => value / self.bound,
            false => self.bound / value,
        }
    }

    /// Returns the best figure that is known to be possible with the wall: the bound, or the value
    /// before cleaning if that is better. Ends that cannot be cleaned are kept solid after it.
    pub fn possible(&self) -> f64 {
        let before = self.value_before_cleaning.unwrap_or(self.bound);
        if self.figure.more_is_better() {
            before.max(self.bound)
        } else {
            before.min(self.bound)
        }
    }
}

/// A proof about tops with their centre of mass at any height. It holds on the printer's own
/// columns, or on coarser ones if the lever is free too or the voids are filled.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeightProof {
    /// Pitch of those columns, mm.
    pub pitch_mm: f64,
    /// Optimum on them, in the certificate's figure.
    pub value: f64,
    /// Proved bound on them: no hollowing does better at any height of the centre of mass.
    pub bound: f64,
}

/// A round in which ends of voids were kept solid, most often because they could not be cleaned,
/// and the hollowing was solved again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CleaningRow {
    /// The voids, with their names in that round, and the reasons.
    pub voids: Vec<KeptRow>,
    /// Volume that was kept solid, without the margin around it, mm³.
    pub volume_mm3: f64,
    /// The certificate's figure before the round.
    pub value_before: f64,
    /// The certificate's figure after the round; `None` if the goal could not be met any more, so
    /// that the round was undone.
    pub value_after: Option<f64>,
    /// `true` if the plan, not cleaning, asked for the round. A plan keeps solid what lies beyond
    /// joints without room for pins, and what a person ordered to stay solid.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub by_plan: bool,
}

/// A void that was partly kept solid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptRow {
    /// Name in that round, such as `V1`.
    pub void: String,
    /// Reason, in words with numbers.
    pub why: String,
}

/// The course of the search on coarse columns: value and bound by pass, and a top's speed by
/// height.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// Passes of the last ascent from an empty start, in the certificate's figure.
    pub passes: Vec<PassRow>,
    /// Tops: the best speed for a height of the centre of mass, by ascending heights.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub speeds: Vec<SpeedRow>,
    /// Prints near a wished infill: how much of it must change to keep how much of a figure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trade: Option<TradeRow>,
}

/// The least change of a wished infill for each of some figures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TradeRow {
    /// The figure.
    pub figure: FigureName,
    /// The root mean square of the change, as a share of solid print, and the figure, by ascending
    /// change.
    pub points: Vec<[f64; 2]>,
    /// The figure of the best print, on coarse columns.
    pub best: f64,
}

/// A pass of the solver over the columns.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PassRow {
    /// Value of the current interior, in the certificate's figure. It meets the constraints only at
    /// the end.
    pub value: f64,
    /// Proved bound: no interior does better.
    pub bound: f64,
}

/// The best top with its centre of mass at this height.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpeedRow {
    /// Height of the centre of mass over the contact point, mm.
    pub height_mm: f64,
    /// Least speed at which it could stay upright, rpm.
    pub critical_speed_rpm: f64,
}

#[cfg(test)]
mod tests {
    use crate::testing::sample;
    use crate::verify::FigureName;

    #[test]
    fn what_cleaning_kept_solid_does_not_lower_what_is_possible() {
        let (mut sheet, _) = sample();
        let proof = &mut sheet.certificate;
        let mut possible = |figure, bound, before| {
            (proof.figure, proof.bound, proof.value_before_cleaning) = (figure, bound, before);
            proof.possible()
        };
        assert_eq!(possible(FigureName::TopplesDeg, 2.0, Some(14.4)), 14.4);
        // Nothing was kept solid: the bound holds, and the value is a little below it.
        assert_eq!(possible(FigureName::TopplesDeg, 5.05, Some(5.0)), 5.05);
        assert_eq!(possible(FigureName::TopplesDeg, 2.0, None), 2.0);
        assert_eq!(
            possible(FigureName::CriticalSpeedRpm, 879.0, Some(850.0)),
            850.0
        );
    }
}
