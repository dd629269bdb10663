//! The numbers a profile may give: their names, and the range outside which a value is a slip of the pen.

use std::{fmt, ops::RangeInclusive};

use serde::{Deserialize, Serialize};

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
    /// The thinnest wall that prints and survives cleaning.
    MinWallMm,
    /// The smallest detail that prints.
    MinFeatureMm,
    /// The narrowest opening through which a void can be cleaned.
    MinOpeningMm,
    /// The thinnest pin that holds.
    PinMinDiameterMm,
    /// A pin's length over its diameter.
    PinLengthRatio,
    /// Gap between pin and socket on each side.
    ClearancePerSideMm,
    /// How much deeper than its pin a socket is.
    SocketExtraDepthMm,
    /// Chamfer of pins and of the mouths of sockets.
    ChamferMm,
    /// The tolerance of a short dimension.
    ToleranceLeastMm,
    /// The tolerance of a long dimension over its length.
    ToleranceRatio,
}

/// The finest length a profile may state, mm. Below it metres were given for millimetres, and columns at such a pitch would fill any memory.
const FINEST_MM: f64 = 1e-3;

impl Quantity {
    /// The key in the file.
    pub fn key(self) -> &'static str {
        match self {
            Self::PixelXMm => "pixel_x_mm",
            Self::PixelYMm => "pixel_y_mm",
            Self::LayerMm => "layer_mm",
            Self::MinWallMm => "min_wall_mm",
            Self::MinFeatureMm => "min_feature_mm",
            Self::MinOpeningMm => "min_opening_mm",
            Self::PinMinDiameterMm => "pin_min_diameter_mm",
            Self::PinLengthRatio => "pin_length_ratio",
            Self::ClearancePerSideMm => "clearance_per_side_mm",
            Self::SocketExtraDepthMm => "socket_extra_depth_mm",
            Self::ChamferMm => "chamfer_mm",
            Self::ToleranceLeastMm => "tolerance_least_mm",
            Self::ToleranceRatio => "tolerance_ratio",
        }
    }

    /// The values that can be meant. Above it micrometres were given for millimetres or per cent for a ratio.
    pub fn plausible(self) -> RangeInclusive<f64> {
        match self {
            Self::PixelXMm | Self::PixelYMm | Self::LayerMm => FINEST_MM..=2.0,
            Self::MinWallMm | Self::MinFeatureMm => FINEST_MM..=20.0,
            Self::MinOpeningMm => FINEST_MM..=100.0,
            Self::PinMinDiameterMm => FINEST_MM..=50.0,
            Self::PinLengthRatio => 0.1..=10.0,
            Self::ClearancePerSideMm | Self::ChamferMm => FINEST_MM..=5.0,
            Self::SocketExtraDepthMm | Self::ToleranceLeastMm => FINEST_MM..=10.0,
            Self::ToleranceRatio => 1e-6..=0.1,
        }
    }

    /// Whether the number is a step of the machine's grid, which may be given as `dpi`.
    pub fn is_grid_step(self) -> bool {
        matches!(self, Self::PixelXMm | Self::PixelYMm | Self::LayerMm)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}
