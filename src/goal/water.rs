//! Liquids, waterlines and the hydrostatics of a solid.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::base::units::Length;
use crate::base::words::{ChoiceError, as_text};
use crate::geom::{Frame, Point};
use crate::mass::clip_below;
use crate::mesh::{Solid, TriMesh};

/// Fresh water at 20 °C, g/cm³ (IAPWS-95 at 101.325 kPa).
const WATER_G_CM3: f64 = 0.9982;
/// Sea water of 35 g/kg at 20 °C, g/cm³ (TEOS-10 at 101.325 kPa).
const SEAWATER_G_CM3: f64 = 1.0248;
/// The liquid that an object floats in.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Liquid {
    /// Fresh water at 20 °C.
    Water,
    /// Sea water at 20 °C.
    Seawater,
    /// A liquid of this density, g/cm³.
    Density(f64),
}

/// The line up to which an object is under water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Waterline {
    /// The line at which it floats most stably.
    Auto,
    /// At this height above its lowest point.
    At(Length),
}

/// The liquid and the waterline of a floating object.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Water {
    /// The liquid.
    pub liquid: Liquid,
    /// The waterline.
    pub waterline: Waterline,
}

impl Default for Water {
    fn default() -> Self {
        Self {
            liquid: Liquid::Water,
            waterline: Waterline::Auto,
        }
    }
}

impl Liquid {
    /// Returns the density, g/cm³.
    pub fn density_g_cm3(self) -> f64 {
        match self {
            Self::Water => WATER_G_CM3,
            Self::Seawater => SEAWATER_G_CM3,
            Self::Density(density) => density,
        }
    }
}

impl FromStr for Liquid {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        match (text, text.trim().parse::<f64>()) {
            ("water", _) => Ok(Self::Water),
            ("seawater", _) => Ok(Self::Seawater),
            (_, Ok(density)) if density.is_finite() && density > 0.0 => Ok(Self::Density(density)),
            _ => Err(ChoiceError::unknown(
                "liquid",
                text,
                &["water", "seawater", "a density in g/cm³"],
            )),
        }
    }
}

impl fmt::Display for Liquid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Water => f.write_str("water"),
            Self::Seawater => f.write_str("seawater"),
            Self::Density(density) => write!(f, "{density}"),
        }
    }
}

impl FromStr for Waterline {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        match text.trim() {
            "auto" => Ok(Self::Auto),
            length => length.parse().map(Self::At).map_err(|_| {
                ChoiceError::unknown(
                    "waterline",
                    text,
                    &["auto", "a length above the lowest point"],
                )
            }),
        }
    }
}

impl fmt::Display for Waterline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::At(length) => write!(f, "{length}"),
        }
    }
}

as_text!(Liquid Waterline);

/// The conditions for a body to float upright at one waterline (Wu et al. eq. 3 to 5).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FloatConditions {
    /// The waterline above the lowest point, mm.
    pub waterline_mm: f64,
    /// The centre of buoyancy, goal frame, mm: the centroid of the volume under water.
    pub buoyancy: Point,
    /// The volume of material that weighs as much as the displaced liquid, mm³.
    pub material_mm3: f64,
    /// The height of the lower transverse metacentre above the origin, c_b + I_w/V_b, mm. The
    /// centre of mass must lie below it.
    pub metacenter_mm: f64,
}

/// The hydrostatics of a solid's outside, level by level.
#[derive(Debug, Clone, PartialEq)]
pub struct Hydrostatics {
    outside: TriMesh,
    height_mm: f64,
    /// The liquid's density over the material's.
    liquid_ratio: f64,
}

impl Hydrostatics {
    /// Prepares `solid` in a goal frame whose origin is as high as its lowest point.
    pub fn new(solid: &Solid, frame: &Frame, liquid_ratio: f64) -> Self {
        let outside = solid.mesh().map_vertices(|vertex| frame.to_local(vertex));
        let height_mm = outside.aabb().max.z;
        Self {
            outside,
            height_mm,
            liquid_ratio,
        }
    }

    /// Returns the height of the model, mm.
    pub fn height_mm(&self) -> f64 {
        self.height_mm
    }

    /// Returns the conditions for floating at a line this far above the lowest point. Exact for the
    /// mesh; costs one pass over the triangles.
    pub fn at(&self, waterline_mm: f64) -> FloatConditions {
        let wet = clip_below(&self.outside, waterline_mm);
        let volume = wet.below.volume();
        let buoyancy = wet.below.centroid();
        FloatConditions {
            waterline_mm,
            buoyancy,
            material_mm3: volume * self.liquid_ratio,
            metacenter_mm: buoyancy.z + wet.section.principal_mm4()[0] / volume,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn liquids_and_lines_read_and_print_as_themselves() {
        for text in ["water", "seawater", "1.26"] {
            assert_eq!(text.parse::<Liquid>().unwrap().to_string(), text);
        }
        for text in ["auto", "12.5mm"] {
            assert_eq!(text.parse::<Waterline>().unwrap().to_string(), text);
        }
        for text in ["oil", "-1", "nan", "0"] {
            assert!(text.parse::<Liquid>().is_err(), "{text}");
        }
        assert!(
            "deep"
                .parse::<Waterline>()
                .unwrap_err()
                .to_string()
                .contains("auto")
        );
    }
}
