//! The rounds in which a kit was sliced and its toolpaths weighed, and the toolpaths of its last.

use serde::{Deserialize, Serialize};

/// A round in which a kit was sliced.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlicedRound {
    /// The distance between the centre of its toolpaths and the promised one, mm.
    pub miss_mm: f64,
    /// The sparse infill that its slicer lays, over what the profile's table says of it. Kits after
    /// it count with so much; `None` if the table is near enough.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub infill_ratio: Option<f64>,
    /// The moments of what its toolpaths lay beyond the written parts, in the model frame, mm³ to
    /// mm⁵. They are those of 1, x, y, z, xy, yz, xz, x², y² and z².
    pub beyond: [f64; 10],
}

/// The toolpaths of the kit itself, as they were weighed when it was made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlicedKit {
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
    pub plates: Vec<SlicedPlate>,
    /// The parts, in the order of the checklist.
    pub parts: Vec<SlicedPart>,
}

/// The toolpaths of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlicedPlate {
    /// The plate's file in the kit.
    pub file: String,
    /// The SHA-256 of that file.
    pub sha256: String,
    /// The time of the print by the slicer, min.
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
#[serde(deny_unknown_fields)]
pub struct SlicedPart {
    /// The name on the sheet.
    pub id: String,
    /// The mass of its toolpaths, g.
    pub mass_g: f64,
}

impl SlicedKit {
    /// Returns whether every figure is one that toolpaths can have.
    pub fn is_sound(&self) -> bool {
        let plates = self.plates.iter();
        let plates = plates.flat_map(|plate| {
            let filament_g = plate.filament_g.unwrap_or_default();
            [plate.parts_g, plate.support_g, filament_g]
        });
        let parts = self.parts.iter().map(|part| part.mass_g);
        let own = [self.mass_g, self.miss_mm];
        let mut all = plates.chain(parts).chain(own);
        all.all(|figure| figure.is_finite() && figure >= 0.0)
            && self.tilt_deg.is_none_or(f64::is_finite)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_that_no_toolpaths_have_are_not_sound() {
        let kit = SlicedKit {
            slicer: "PrusaSlicer 2.5.0".to_owned(),
            profile_sha256: None,
            mass_g: 81.5,
            miss_mm: 0.003,
            tilt_deg: Some(-0.01),
            plates: Vec::new(),
            parts: vec![SlicedPart {
                id: "P01".to_owned(),
                mass_g: 40.0,
            }],
        };
        assert!(kit.is_sound());
        for wrong in [f64::NAN, f64::INFINITY, -1.0] {
            let mut other = kit.clone();
            other.parts[0].mass_g = wrong;
            assert!(!other.is_sound(), "{wrong}");
        }
        let turned = SlicedKit {
            tilt_deg: Some(f64::NAN),
            ..kit
        };
        assert!(!turned.is_sound());
    }
}
