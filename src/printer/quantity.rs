//! The numbers a profile may give: their names, and the range outside which a value is a slip of
//! the pen.

use std::{fmt, ops::RangeInclusive};

use serde::{Deserialize, Serialize};

/// The finest length a profile may state, mm. Below it metres were given for millimetres, and
/// columns at such a pitch would fill any memory.
const FINEST_MM: f64 = 1e-3;
/// The coarsest pixel, line or layer, mm. Above it micrometres were given.
const COARSEST_STEP_MM: f64 = 2.0;
/// The largest wall, detail or hole, mm.
const LARGEST_DETAIL_MM: f64 = 20.0;
/// The largest clearance, chamfer or elephant foot, mm.
const LARGEST_GAP_MM: f64 = 5.0;
/// The largest extra depth or tolerance, mm.
const LARGEST_ERROR_MM: f64 = 10.0;
/// How far a tool can reach, mm: from a pick to a lance; above it micrometres were given.
const REACH_MM: RangeInclusive<f64> = 1.0..=2000.0;
/// Leans from the level at which something prints without support, degrees; below it radians were
/// given.
const OVERHANG_DEG: RangeInclusive<f64> = 5.0..=89.0;
/// The thickest film of glue between flat faces, mm: above it micrometres were given.
const THICKEST_FILM_MM: f64 = 1.0;
/// Densities of glues, g/cm³: outside kg/m³ were given.
const GLUES_G_CM3: RangeInclusive<f64> = 0.5..=3.0;
/// Shares of a length that tolerances and shrinkages can be; above it per cent were given.
const SHARES: RangeInclusive<f64> = 1e-6..=0.1;

/// A number of a profile's `[numbers]` table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
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
    /// The thinnest wall that lies flat while it is printed.
    HorizontalWallMm,
    /// The smallest detail that prints.
    MinFeatureMm,
    /// The narrowest hole that stays open.
    MinHoleMm,
    /// The narrowest opening through which a void can be cleaned.
    MinOpeningMm,
    /// The narrowest of two or more openings through which powder escapes.
    PairOpeningMm,
    /// How far into an opening a tool or a jet reaches.
    CleaningReachMm,
    /// The least lean from the level at which a surface that looks down prints without support.
    OverhangDeg,
    /// The thinnest pin that holds.
    PinMinDiameterMm,
    /// A pin's length over its diameter.
    PinLengthRatio,
    /// Gap between pin and socket on each side, for a joint that is glued.
    ClearancePerSideMm,
    /// Gap on each side for a joint that is pressed together and holds.
    ClearancePressPerSideMm,
    /// Gap on each side for a joint that comes apart by itself.
    ClearanceLoosePerSideMm,
    /// How much deeper than its pin a socket is.
    SocketExtraDepthMm,
    /// Chamfer of pins and of the mouths of sockets.
    ChamferMm,
    /// How far the first layers spread beyond the drawing.
    ElephantFootMm,
    /// The tolerance of a short dimension.
    ToleranceLeastMm,
    /// The part of a long dimension's tolerance that does not grow.
    ToleranceBaseMm,
    /// The part of a long dimension's tolerance that grows, over its length.
    ToleranceRatio,
    /// By how much a part comes out shorter along x and y, over its length.
    ShrinkageXyRatio,
    /// By how much a part comes out shorter along z, over its length.
    ShrinkageZRatio,
    /// How thick the film of glue between two cut faces is.
    GlueFilmMm,
    /// The density of that glue when it has set.
    #[serde(rename = "glue_density_g_cm3")]
    GlueDensityGCm3,
}

impl Quantity {
    /// Every quantity, in order.
    pub const ALL: [Self; 29] = [
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
        Self::MinOpeningMm,
        Self::PairOpeningMm,
        Self::CleaningReachMm,
        Self::OverhangDeg,
        Self::PinMinDiameterMm,
        Self::PinLengthRatio,
        Self::ClearancePerSideMm,
        Self::ClearancePressPerSideMm,
        Self::ClearanceLoosePerSideMm,
        Self::SocketExtraDepthMm,
        Self::ChamferMm,
        Self::ElephantFootMm,
        Self::ToleranceLeastMm,
        Self::ToleranceBaseMm,
        Self::ToleranceRatio,
        Self::ShrinkageXyRatio,
        Self::ShrinkageZRatio,
        Self::GlueFilmMm,
        Self::GlueDensityGCm3,
    ];

    /// The key in the file.
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
            Self::MinOpeningMm => "min_opening_mm",
            Self::PairOpeningMm => "pair_opening_mm",
            Self::CleaningReachMm => "cleaning_reach_mm",
            Self::OverhangDeg => "overhang_deg",
            Self::PinMinDiameterMm => "pin_min_diameter_mm",
            Self::PinLengthRatio => "pin_length_ratio",
            Self::ClearancePerSideMm => "clearance_per_side_mm",
            Self::ClearancePressPerSideMm => "clearance_press_per_side_mm",
            Self::ClearanceLoosePerSideMm => "clearance_loose_per_side_mm",
            Self::SocketExtraDepthMm => "socket_extra_depth_mm",
            Self::ChamferMm => "chamfer_mm",
            Self::ElephantFootMm => "elephant_foot_mm",
            Self::ToleranceLeastMm => "tolerance_least_mm",
            Self::ToleranceBaseMm => "tolerance_base_mm",
            Self::ToleranceRatio => "tolerance_ratio",
            Self::ShrinkageXyRatio => "shrinkage_xy_ratio",
            Self::ShrinkageZRatio => "shrinkage_z_ratio",
            Self::GlueFilmMm => "glue_film_mm",
            Self::GlueDensityGCm3 => "glue_density_g_cm3",
        }
    }

    /// Whether every printer needs it, from its own profile or from what that inherits; the others
    /// may stay unknown.
    pub fn is_needed(self) -> bool {
        !matches!(
            self,
            Self::LayerLeastMm
                | Self::LayerMostMm
                | Self::SupportedWallMm
                | Self::HorizontalWallMm
                | Self::MinHoleMm
                | Self::PairOpeningMm
                | Self::CleaningReachMm
                | Self::OverhangDeg
                | Self::ClearancePressPerSideMm
                | Self::ClearanceLoosePerSideMm
                | Self::ElephantFootMm
                | Self::ToleranceBaseMm
                | Self::ToleranceRatio
                | Self::ShrinkageXyRatio
                | Self::ShrinkageZRatio
                | Self::GlueFilmMm
                | Self::GlueDensityGCm3
        )
    }

    /// The values that can be meant. Above it micrometres were given for millimetres or per cent
    /// for a ratio.
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
            Self::MinOpeningMm | Self::PairOpeningMm => FINEST_MM..=100.0,
            Self::CleaningReachMm => REACH_MM,
            Self::OverhangDeg => OVERHANG_DEG,
            Self::PinMinDiameterMm => FINEST_MM..=50.0,
            Self::PinLengthRatio => 0.1..=10.0,
            Self::ClearancePerSideMm
            | Self::ClearancePressPerSideMm
            | Self::ClearanceLoosePerSideMm
            | Self::ElephantFootMm
            | Self::ChamferMm => FINEST_MM..=LARGEST_GAP_MM,
            Self::SocketExtraDepthMm | Self::ToleranceLeastMm | Self::ToleranceBaseMm => {
                FINEST_MM..=LARGEST_ERROR_MM
            }
            Self::ToleranceRatio | Self::ShrinkageXyRatio | Self::ShrinkageZRatio => SHARES,
            Self::GlueFilmMm => FINEST_MM..=THICKEST_FILM_MM,
            Self::GlueDensityGCm3 => GLUES_G_CM3,
        }
    }

    /// Whether the number is a step of the machine's grid, which may be given as `dpi`.
    pub fn is_grid_step(self) -> bool {
        matches!(self, Self::PixelXMm | Self::PixelYMm | Self::LayerMm)
    }

    /// Whether the number is an angle, not a length.
    pub fn is_angle(self) -> bool {
        self.key().ends_with("_deg")
    }

    /// Whether the number is a share, not a length.
    pub fn is_ratio(self) -> bool {
        self.key().ends_with("_ratio")
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}
