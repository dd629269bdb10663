//! What floats: it lies in a liquid up to a given line, upright, and rights itself.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Placement;
use super::place::{GoalError, Site};
use crate::base::units::Length;
use crate::base::words::{ChoiceError, as_text};
use crate::geom::{Frame, Point};
use crate::mass::submerged;
use crate::mesh::{Solid, TriMesh};

/// Fresh water at 20 °C, g/cm³ (IAPWS-95 at 101.325 kPa).
const WATER_G_CM3: f64 = 0.9982;
/// Sea water of 35 g/kg at 20 °C, g/cm³ (TEOS-10 at 101.325 kPa).
const SEAWATER_G_CM3: f64 = 1.0248;
/// Where the waterline is free, the share of the height a search starts from.
const PROVISIONAL_RATIO: f64 = 0.5;

/// What an object floats in.
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

/// Up to where it is under water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Waterline {
    /// Wherever it floats most stably.
    Auto,
    /// So far above its lowest point.
    At(Length),
}

/// How an object is to float.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Water {
    /// In what.
    pub liquid: Liquid,
    /// Up to where.
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
    /// The density, g/cm³.
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

/// What a body must be to float upright at one waterline (Wu et al. eq. 3 to 5).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Afloat {
    /// The waterline above the lowest point, mm.
    pub waterline_mm: f64,
    /// The centre of buoyancy, goal frame: the centroid of what is under water, mm.
    pub buoyancy: Point,
    /// The volume of material that weighs as much as the displaced liquid, mm³.
    pub material_mm3: f64,
    /// The lower of the two transverse metacentres above the origin, c_b + I_w/V_b, mm: below it
    /// the centre of mass has to lie.
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
    /// Of `solid` in a goal frame whose origin is as high as its lowest point.
    pub fn new(solid: &Solid, frame: &Frame, liquid_ratio: f64) -> Self {
        let outside = solid.mesh().map_vertices(|vertex| frame.to_local(vertex));
        let height_mm = outside.aabb().max.z;
        Self {
            outside,
            height_mm,
            liquid_ratio,
        }
    }

    /// The height of the model, mm.
    pub fn height_mm(&self) -> f64 {
        self.height_mm
    }

    /// What floats up to a line so far above the lowest point; exact for the mesh. One pass over
    /// the triangles.
    pub fn at(&self, waterline_mm: f64) -> Afloat {
        let wet = submerged(&self.outside, waterline_mm);
        let volume = wet.below.volume();
        let buoyancy = wet.below.centroid();
        Afloat {
            waterline_mm,
            buoyancy,
            material_mm3: volume * self.liquid_ratio,
            metacenter_mm: buoyancy.z + wet.section.principal_mm4()[0] / volume,
        }
    }
}

pub(super) fn place(site: &Site, density_g_cm3: f64, water: Water) -> Result<Placement, GoalError> {
    let center = site.upright_center();
    let mut goal = site.goal_at(&Point::new(center.x, center.y, site.lowest_mm), Vec::new());
    let liquid_ratio = water.liquid.density_g_cm3() / density_g_cm3;
    let hydrostatics = Hydrostatics::new(site.solid, &goal.frame, liquid_ratio);
    let height_mm = site.height_mm();
    let waterline_mm = match water.waterline {
        Waterline::Auto => PROVISIONAL_RATIO * height_mm,
        Waterline::At(length) if length.mm() < height_mm => length.mm(),
        Waterline::At(length) => {
            return Err(GoalError::UnderWater {
                waterline_mm: length.mm(),
                height_mm,
            });
        }
    };
    goal.afloat = Some(hydrostatics.at(waterline_mm));
    Ok(Placement {
        goal,
        keeps: Vec::new(),
        warnings: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::{GoalKind, Request, Stock, place_made_of, testing::*};
    use super::*;

    fn block_in_water(waterline: &str, density_g_cm3: f64) -> Result<Placement, GoalError> {
        let water = Water {
            liquid: Liquid::Density(1.0),
            waterline: waterline.parse().unwrap(),
        };
        let wish = Request {
            water: Some(water),
            ..Request::new(GoalKind::Float)
        };
        place_made_of(
            &block([1., 2., 3.], [7., 12., 8.]),
            &Stock {
                wall_mm: 0.5,
                density_g_cm3,
            },
            &wish,
        )
    }

    #[test]
    fn a_block_has_the_metacentre_of_the_textbook() {
        // 6 × 10 × 5 under water to 2: V = 120, KB = 1, BM = (10·6³/12)/120 = 1.5.
        let afloat = block_in_water("2mm", 1.25).unwrap().goal.afloat.unwrap();
        assert!((afloat.metacenter_mm - 2.5).abs() < 1e-12);
        assert!((afloat.material_mm3 - 120.0 / 1.25).abs() < 1e-12);
        assert!((afloat.buoyancy - Point::new(0.0, 0.0, 1.0)).norm() < 1e-12);
    }

    #[test]
    fn a_line_above_the_whole_model_is_refused() {
        let refused = block_in_water("5mm", 1.0);
        assert!(
            matches!(refused, Err(GoalError::UnderWater { height_mm, .. }) if (height_mm - 5.0).abs() < 1e-12)
        );
    }

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
