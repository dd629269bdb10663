//! The time and the filament of the plates, as a slicer states them.

use serde::{Deserialize, Serialize};

use crate::base::units::show_minutes;

/// What a slicer says that the plates take.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PrintTimeRow {
    /// The slicer's name and version, such as `PrusaSlicer 2.5.0`.
    pub slicer: String,
    /// True if the speeds are those of the shop's profile, and not the slicer's default.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub has_profile: bool,
    /// The plates.
    pub plates: Vec<PlateTimeRow>,
}

/// What a slicer says that a plate takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlateTimeRow {
    /// Its file, relative to the kit.
    pub file: String,
    /// Time of the print, min, rounded up to fives.
    pub minutes: u32,
    /// Filament with all supports, g, rounded to tenths; `None` if the slicer does not state it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filament_g: Option<f64>,
}

/// Steps of a stated time, min: no estimate is better, and two runs of a slicer may differ by less.
const STEP_MIN: f64 = 5.0;
/// Steps of a stated mass, g.
const STEP_G: f64 = 0.1;
/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;

impl PlateTimeRow {
    /// Returns the row of a plate that takes this many seconds and this much filament.
    pub fn new(file: &str, seconds: f64, filament_g: Option<f64>) -> Self {
        Self {
            file: file.to_owned(),
            minutes: ((seconds / S_PER_MIN / STEP_MIN).ceil() * STEP_MIN) as u32,
            filament_g: filament_g.map(|mass_g| (mass_g / STEP_G).round() / STEP_G.recip()),
        }
    }
}

impl PrintTimeRow {
    /// Names the slicer, and whose speeds it took.
    pub fn slicer_words(&self) -> String {
        let speeds = match self.has_profile {
            true => "the speeds of the shop's profile",
            false => "its default speeds",
        };
        format!("{} with {speeds}", self.slicer)
    }

    /// Words the time and the filament of all plates: `about 5 h 50 min and 63.2 g of filament`.
    pub fn words(&self) -> String {
        let minutes: u32 = self.plates.iter().map(|plate| plate.minutes).sum();
        let time = show_minutes(minutes);
        let filament_g: Option<f64> = self.plates.iter().map(|plate| plate.filament_g).sum();
        let filament = filament_g.map_or(String::new(), |mass_g| {
            format!(" and {mass_g:.1}\u{a0}g of filament, supports included")
        });
        format!("about {time}{filament}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rounded_up_and_summed_over_the_plates() {
        let plates = vec![
            PlateTimeRow::new("plate_1.3mf", 20_821.0, Some(63.16)),
            PlateTimeRow::new("plate_2.3mf", 60.0, Some(1.0)),
        ];
        assert_eq!(plates[0].minutes, 350);
        let row = PrintTimeRow {
            slicer: "PrusaSlicer 2.5.0".to_owned(),
            has_profile: true,
            plates,
        };
        assert!(
            row.slicer_words()
                .ends_with("the speeds of the shop's profile")
        );
        let words = row.words().replace('\u{a0}', " ");
        assert_eq!(
            words,
            "about 5 h 55 min and 64.2 g of filament, supports included"
        );
    }

    #[test]
    fn filament_that_is_not_stated_is_not_told() {
        let row = PrintTimeRow {
            slicer: String::new(),
            has_profile: false,
            plates: vec![PlateTimeRow::new("plate.3mf", 1500.0, None)],
        };
        assert_eq!(row.words().replace('\u{a0}', " "), "about 25 min");
    }
}
