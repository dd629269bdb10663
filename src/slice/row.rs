//! What was sliced, as `slices.json` says it.

use serde::{Deserialize, Serialize};

use crate::base::units::show_minutes;

/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;

/// The toolpaths of a kit, by plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slices {
    /// The version of this file.
    pub schema: u32,
    /// The job of the kit.
    pub job: String,
    /// The slicer's name and version, such as `PrusaSlicer 2.5.0`.
    pub slicer: String,
    /// Whether this program was never tried with this slicer.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_untried: bool,
    /// The SHA-256 of the slicer's profile that was loaded first; `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile_sha256: Option<String>,
    /// The plates, in the order of their names.
    pub plates: Vec<PlateSlice>,
}

/// The toolpaths of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlateSlice {
    /// The plate's file in the kit.
    pub plate: String,
    /// The file of its toolpaths.
    pub toolpaths: String,
    /// Its time by the slicer, min, rounded up.
    pub minutes: u32,
    /// Mass of the parts and jigs, g.
    pub parts_g: f64,
    /// Mass of support, brim and skirt, g.
    pub support_g: f64,
    /// Filament by the slicer, purging included, g; `None` if it states none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filament_g: Option<f64>,
    /// Number of layers.
    pub layers: u64,
}

impl PlateSlice {
    /// Returns a time in minutes, rounded up.
    pub(super) fn minutes_of(seconds: f64) -> u32 {
        (seconds / S_PER_MIN).ceil() as u32
    }

    /// Words its time: `3 h 5 min`.
    pub fn time(&self) -> String {
        show_minutes(self.minutes)
    }
}

impl Slices {
    /// The version of `slices.json` that this program writes.
    pub const SCHEMA: u32 = 1;

    /// Words the time of all plates: `3 h 5 min`.
    pub fn time(&self) -> String {
        show_minutes(self.plates.iter().map(|plate| plate.minutes).sum())
    }

    /// Returns the mass of the parts and jigs on all plates, g.
    pub fn parts_g(&self) -> f64 {
        self.plates.iter().map(|plate| plate.parts_g).sum()
    }

    /// Returns the mass of support, brim and skirt on all plates, g.
    pub fn support_g(&self) -> f64 {
        self.plates.iter().map(|plate| plate.support_g).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rounded_up_to_minutes() {
        assert_eq!(PlateSlice::minutes_of(60.0), 1);
        assert_eq!(PlateSlice::minutes_of(60.1), 2);
    }
}
