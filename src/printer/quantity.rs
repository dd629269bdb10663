//! The numbers that a profile may give: their keys and plausible ranges.

use std::{fmt, ops::RangeInclusive};

use serde::{Deserialize, Serialize};

/// The finest length, mm. Smaller values must be in metres, and columns at such a pitch would fill
/// any memory.
const FINEST_MM: f64 = 1e-3;
/// The coarsest pixel, line or layer, mm. Larger values must be in micrometres.
const COARSEST_STEP_MM: f64 = 2.0;
/// The largest wall, detail or hole, mm.
const LARGEST_DETAIL_MM: f64 = 20.0;
/// The largest clearance, chamfer or elephant foot, mm.
const LARGEST_GAP_MM: f64 = 5.0;
/// The largest extra depth or tolerance, mm.
const LARGEST_ERROR_MM: f64 = 10.0;
/// Reach of a tool, mm: from a pick to a lance. Larger values must be in micrometres.
const REACH_MM: RangeInclusive<f64> = 1.0..=2000.0;
/// Angles to the horizontal from which surfaces print without support, degrees. Smaller values
/// must be in radians.
const OVERHANG_DEG: RangeInclusive<f64> = 5.0..=89.0;
/// The thickest film of glue between flat faces, mm. Larger values must be in micrometres.
const THICKEST_FILM_MM: f64 = 1.0;
/// Densities of glues, g/cm³. Other values must be in kg/m³.
const GLUES_G_CM3: RangeInclusive<f64> = 0.5..=3.0;
/// Times for which glued parts are held, seconds: up to an hour.
const HOLD_S: RangeInclusive<f64> = 1.0..=3600.0;
/// Times after which glue has its whole strength, hours: up to two weeks.
const CURE_H: RangeInclusive<f64> = 0.01..=336.0;
/// Volumes that a machine prints in a second, mm³/s. Larger values must be in mm³/min.
const FLOWS_MM3_S: RangeInclusive<f64> = 0.01..=500.0;
/// Densities of infill over that of solid print. Larger values must be in per cent.
pub(super) const INFILL_RATIOS: RangeInclusive<f64> = 0.01..=1.0;
/// Densities of infill that carry solid print over them. At a tenth, lines of 0.45 mm are 4.5 mm
/// apart: solid print over them hangs no farther.
const CARRYING_RATIOS: RangeInclusive<f64> = 0.1..=1.0;
/// Numbers of lines along a wall and of solid layers. Larger ones must be lengths.
const COUNTS: RangeInclusive<f64> = 1.0..=50.0;
/// Overlaps of infill and walls over a line. Larger values must be in per cent.
const OVERLAP_RATIOS: RangeInclusive<f64> = 0.0..=1.0;
/// Tolerances and shrinkages over a length. Larger values must be in per cent.
const LENGTH_RATIOS: RangeInclusive<f64> = 1e-6..=0.1;

/// A number of a profile's `[numbers]` table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Quantity {
    /// Size of a pixel along x, or the width of a line.
    PixelXMm,
    /// Size of a pixel along y, or the width of a line.
    PixelYMm,
    /// Height of a layer.
    LayerMm,
    /// The thinnest layer the machine offers.
    LayerLeastMm,
    /// The thickest layer the machine offers.
    LayerMostMm,
    /// The thinnest wall with a free rim that prints and survives cleaning.
    MinWallMm,
    /// The thinnest wall held on two sides or more.
    SupportedWallMm,
    /// The thinnest wall that is printed lying flat.
    HorizontalWallMm,
    /// The smallest detail that prints.
    MinFeatureMm,
    /// The narrowest hole that stays open.
    MinHoleMm,
    /// The least density of infill that carries what is printed over it, over that of solid print.
    LeastInfillRatio,
    /// The number of lines along a wall that slicers lay.
    Perimeters,
    /// The number of solid layers that slicers lay over and under sparse infill.
    SolidLayers,
    /// The share of a line by which infill reaches into the walls, as PrusaSlicer reckons it.
    InfillOverlapRatio,
    /// The narrowest opening through which a void can be cleaned.
    MinOpeningMm,
    /// The narrowest of two or more openings through which powder escapes.
    PairOpeningMm,
    /// Depth below an opening that a tool or a jet reaches.
    CleaningReachMm,
    /// The least angle from the horizontal at which a downward surface prints without support.
    OverhangDeg,
    /// The thinnest pin that holds.
    PinMinDiameterMm,
    /// Length of a pin over its diameter.
    PinLengthRatio,
    /// The largest step at the rim of a seam that is accepted.
    SeamStepMm,
    /// Gap between pin and socket on each side, for a joint that is glued.
    ClearancePerSideMm,
    /// Gap on each side for a joint that is pressed together and holds.
    ClearancePressPerSideMm,
    /// Gap on each side for a joint that comes apart by itself.
    ClearanceLoosePerSideMm,
    /// Gap on each side for shells that slide in each other along their whole length.
    ClearanceSlidePerSideMm,
    /// Gap on each side of parts that are printed in each other and move afterwards.
    ClearanceInPlacePerSideMm,
    /// Depth of a socket beyond the end of its pin.
    SocketExtraDepthMm,
    /// Chamfer of pins and socket mouths.
    ChamferMm,
    /// Chamfer of sliding edges that lie on the plate, so that spread first layers do not rub.
    ChamferFirstLayerMm,
    /// Spread of the first layers beyond the drawing.
    ElephantFootMm,
    /// The least tolerance, that of short dimensions.
    ToleranceLeastMm,
    /// The constant part of a long dimension's tolerance.
    ToleranceBaseMm,
    /// The growing part of a long dimension's tolerance, over its length.
    ToleranceRatio,
    /// Shrinkage of a part along x and y, over its length.
    ShrinkageXyRatio,
    /// Shrinkage of a part along z, over its length.
    ShrinkageZRatio,
    /// Thickness of the film of glue between two cut faces.
    GlueFilmMm,
    /// Density of that glue once it has set.
    #[serde(rename = "glue_density_g_cm3")]
    GlueDensityGCm3,
    /// Seconds for which glued parts are held together.
    GlueHoldS,
    /// Hours after which the glue has its whole strength.
    GlueCureH,
    /// Volume of thin walls that are printed in a second.
    #[serde(rename = "wall_flow_mm3_s")]
    WallFlowMm3S,
    /// Volume of solid blocks that are printed in a second.
    #[serde(rename = "solid_flow_mm3_s")]
    SolidFlowMm3S,
}

impl Quantity {
    /// Every quantity, in order.
    pub const ALL: [Self; 41] = [
        Self::PixelXMm,
        Self::PixelYMm,
        Self::LayerMm,
        Self::LayerLeastMm,
        Self::LayerMostMm,
        Self::MinWallMm,
        Self::SupportedWallMm,
        Self::HorizontalWallMm,
        Self::MinFeatureMm,
        Self::MinHoleMm,
        Self::LeastInfillRatio,
        Self::Perimeters,
        Self::SolidLayers,
        Self::InfillOverlapRatio,
        Self::MinOpeningMm,
        Self::PairOpeningMm,
        Self::CleaningReachMm,
        Self::OverhangDeg,
        Self::PinMinDiameterMm,
        Self::PinLengthRatio,
        Self::SeamStepMm,
        Self::ClearancePerSideMm,
        Self::ClearancePressPerSideMm,
        Self::ClearanceLoosePerSideMm,
        Self::ClearanceSlidePerSideMm,
        Self::ClearanceInPlacePerSideMm,
        Self::SocketExtraDepthMm,
        Self::ChamferMm,
        Self::ChamferFirstLayerMm,
        Self::ElephantFootMm,
        Self::ToleranceLeastMm,
        Self::ToleranceBaseMm,
        Self::ToleranceRatio,
        Self::ShrinkageXyRatio,
        Self::ShrinkageZRatio,
        Self::GlueFilmMm,
        Self::GlueDensityGCm3,
        Self::GlueHoldS,
        Self::GlueCureH,
        Self::WallFlowMm3S,
        Self::SolidFlowMm3S,
    ];

    /// Returns its key in a profile.
    pub fn key(self) -> &'static str {
        match self {
            Self::PixelXMm => "pixel_x_mm",
            Self::PixelYMm => "pixel_y_mm",
            Self::LayerMm => "layer_mm",
            Self::LayerLeastMm => "layer_least_mm",
            Self::LayerMostMm => "layer_most_mm",
            Self::MinWallMm => "min_wall_mm",
            Self::SupportedWallMm => "supported_wall_mm",
            Self::HorizontalWallMm => "horizontal_wall_mm",
            Self::MinFeatureMm => "min_feature_mm",
            Self::MinHoleMm => "min_hole_mm",
            Self::LeastInfillRatio => "least_infill_ratio",
            Self::Perimeters => "perimeters",
            Self::SolidLayers => "solid_layers",
            Self::InfillOverlapRatio => "infill_overlap_ratio",
            Self::MinOpeningMm => "min_opening_mm",
            Self::PairOpeningMm => "pair_opening_mm",
            Self::CleaningReachMm => "cleaning_reach_mm",
            Self::OverhangDeg => "overhang_deg",
            Self::PinMinDiameterMm => "pin_min_diameter_mm",
            Self::PinLengthRatio => "pin_length_ratio",
            Self::SeamStepMm => "seam_step_mm",
            Self::ClearancePerSideMm => "clearance_per_side_mm",
            Self::ClearancePressPerSideMm => "clearance_press_per_side_mm",
            Self::ClearanceLoosePerSideMm => "clearance_loose_per_side_mm",
            Self::ClearanceSlidePerSideMm => "clearance_slide_per_side_mm",
            Self::ClearanceInPlacePerSideMm => "clearance_in_place_per_side_mm",
            Self::SocketExtraDepthMm => "socket_extra_depth_mm",
            Self::ChamferMm => "chamfer_mm",
            Self::ChamferFirstLayerMm => "chamfer_first_layer_mm",
            Self::ElephantFootMm => "elephant_foot_mm",
            Self::ToleranceLeastMm => "tolerance_least_mm",
            Self::ToleranceBaseMm => "tolerance_base_mm",
            Self::ToleranceRatio => "tolerance_ratio",
            Self::ShrinkageXyRatio => "shrinkage_xy_ratio",
            Self::ShrinkageZRatio => "shrinkage_z_ratio",
            Self::GlueFilmMm => "glue_film_mm",
            Self::GlueDensityGCm3 => "glue_density_g_cm3",
            Self::GlueHoldS => "glue_hold_s",
            Self::GlueCureH => "glue_cure_h",
            Self::WallFlowMm3S => "wall_flow_mm3_s",
            Self::SolidFlowMm3S => "solid_flow_mm3_s",
        }
    }

    /// True if every printer needs the number, from its own profile or from a parent. The others
    /// may stay unknown.
    pub fn is_needed(self) -> bool {
        !matches!(
            self,
            Self::LayerLeastMm
                | Self::LayerMostMm
                | Self::SupportedWallMm
                | Self::HorizontalWallMm
                | Self::MinHoleMm
                | Self::LeastInfillRatio
                | Self::Perimeters
                | Self::SolidLayers
                | Self::InfillOverlapRatio
                | Self::PairOpeningMm
                | Self::CleaningReachMm
                | Self::OverhangDeg
                | Self::SeamStepMm
                | Self::ClearancePressPerSideMm
                | Self::ClearanceLoosePerSideMm
                | Self::ClearanceSlidePerSideMm
                | Self::ClearanceInPlacePerSideMm
                | Self::ChamferFirstLayerMm
                | Self::ElephantFootMm
                | Self::ToleranceBaseMm
                | Self::ToleranceRatio
                | Self::ShrinkageXyRatio
                | Self::ShrinkageZRatio
                | Self::GlueFilmMm
                | Self::GlueDensityGCm3
                | Self::GlueHoldS
                | Self::GlueCureH
                | Self::WallFlowMm3S
                | Self::SolidFlowMm3S
        )
    }

    /// Returns the plausible values. Larger ones must be in micrometres instead of millimetres, or
    /// in per cent instead of a ratio.
    pub fn plausible(self) -> RangeInclusive<f64> {
        match self {
            Self::PixelXMm
            | Self::PixelYMm
            | Self::LayerMm
            | Self::LayerLeastMm
            | Self::LayerMostMm => FINEST_MM..=COARSEST_STEP_MM,
            Self::MinWallMm
            | Self::SupportedWallMm
            | Self::HorizontalWallMm
            | Self::MinFeatureMm
            | Self::MinHoleMm => FINEST_MM..=LARGEST_DETAIL_MM,
            Self::LeastInfillRatio => CARRYING_RATIOS,
            Self::Perimeters | Self::SolidLayers => COUNTS,
            Self::InfillOverlapRatio => OVERLAP_RATIOS,
            Self::MinOpeningMm | Self::PairOpeningMm => FINEST_MM..=100.0,
            Self::CleaningReachMm => REACH_MM,
            Self::OverhangDeg => OVERHANG_DEG,
            Self::PinMinDiameterMm => FINEST_MM..=50.0,
            Self::PinLengthRatio => 0.1..=10.0,
            Self::SeamStepMm
            | Self::ClearancePerSideMm
            | Self::ClearancePressPerSideMm
            | Self::ClearanceLoosePerSideMm
            | Self::ClearanceSlidePerSideMm
            | Self::ClearanceInPlacePerSideMm
            | Self::ChamferFirstLayerMm
            | Self::ElephantFootMm
            | Self::ChamferMm => FINEST_MM..=LARGEST_GAP_MM,
            Self::SocketExtraDepthMm | Self::ToleranceLeastMm | Self::ToleranceBaseMm => {
                FINEST_MM..=LARGEST_ERROR_MM
            }
            Self::ToleranceRatio | Self::ShrinkageXyRatio | Self::ShrinkageZRatio => LENGTH_RATIOS,
            Self::GlueFilmMm => FINEST_MM..=THICKEST_FILM_MM,
            Self::GlueDensityGCm3 => GLUES_G_CM3,
            Self::GlueHoldS => HOLD_S,
            Self::GlueCureH => CURE_H,
            Self::WallFlowMm3S | Self::SolidFlowMm3S => FLOWS_MM3_S,
        }
    }

    /// True for a number that only estimates times: nobody misses it.
    pub fn is_for_estimates(self) -> bool {
        matches!(self, Self::WallFlowMm3S | Self::SolidFlowMm3S)
    }

    /// True for a step of the machine's grid, which may be given as `dpi`.
    pub fn is_grid_step(self) -> bool {
        matches!(self, Self::PixelXMm | Self::PixelYMm | Self::LayerMm)
    }

    /// True for an angle.
    pub fn is_angle(self) -> bool {
        matches!(self, Self::OverhangDeg)
    }

    /// True for a ratio.
    pub fn is_ratio(self) -> bool {
        matches!(
            self,
            Self::PinLengthRatio
                | Self::LeastInfillRatio
                | Self::InfillOverlapRatio
                | Self::ToleranceRatio
                | Self::ShrinkageXyRatio
                | Self::ShrinkageZRatio
        )
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_and_ratios_are_those_whose_keys_end_so() {
        for quantity in Quantity::ALL {
            let key = quantity.key();
            assert_eq!(quantity.is_angle(), key.ends_with("_deg"), "{key}");
            assert_eq!(quantity.is_ratio(), key.ends_with("_ratio"), "{key}");
        }
    }
}
