//! The toolpaths of a kit, as its slicer laid them when it was made.

use serde::{Deserialize, Serialize};

use crate::base::units::show_minutes;

/// The toolpaths of a kit, weighed when it was made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ToolpathsRow {
    /// The slicer's name and version, such as `PrusaSlicer 2.5.0`.
    pub slicer: String,
    /// The SHA-256 of the slicer's profile over which it was sliced; `None` for its defaults.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile_sha256: Option<String>,
    /// The mass of the object that they lay, with all that the kit adds to its parts, g.
    pub mass_g: f64,
    /// The distance between its centre and the promised one, mm.
    pub miss_mm: f64,
    /// The tilt of its principal axis beyond the promised one, degrees; `None` for goals without.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_deg: Option<f64>,
    /// The plates, in the order of their names.
    pub plates: Vec<ToolpathPlate>,
    /// The parts, in the order of the checklist.
    pub parts: Vec<ToolpathPart>,
}

/// The toolpaths of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ToolpathPlate {
    /// Its file, relative to the kit.
    pub file: String,
    /// Time of the print by the slicer, min, rounded up.
    pub minutes: u32,
    /// Mass of the parts and jigs, g.
    pub parts_g: f64,
    /// Mass of support, brim and skirt, g.
    pub support_g: f64,
    /// Filament by the slicer, purging included, g; `None` if it states none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filament_g: Option<f64>,
}

/// A part as its toolpaths lay it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ToolpathPart {
    /// Its name on the sheet.
    pub id: String,
    /// Mass of its toolpaths, without support and the like, g.
    pub mass_g: f64,
}

impl ToolpathsRow {
    /// Words the time of all plates: `3 h 5 min`.
    pub fn time(&self) -> String {
        show_minutes(self.plates.iter().map(|plate| plate.minutes).sum())
    }

    /// Returns the mass of support, brim and skirt on all plates, g.
    pub fn support_g(&self) -> f64 {
        self.plates.iter().map(|plate| plate.support_g).sum()
    }

    /// Returns the mass of a part; `None` if it is not among them.
    pub fn mass_of(&self, id: &str) -> Option<f64> {
        let part = self.parts.iter().find(|part| part.id == id);
        part.map(|part| part.mass_g)
    }
}
