//! The sizes of a fastener by its kind.

use std::f64::consts::FRAC_PI_4;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

/// The share of the cylinder around it that a round head fills.
const HEAD_RATIO: f64 = 0.55;
/// The area of a regular hexagon over the square of its width over corners: 3√3/8.
const HEXAGON: f64 = 0.649_519_052_838_329;

/// The plausible densities of metal fasteners by their nominal shape, g/cm³: threads, sockets and
/// knurls take some of it away.
const METAL_G_CM3: RangeInclusive<f64> = 3.0..=10.0;
/// The plausible densities of wooden ones, g/cm³: from balsa to lignum vitae.
const WOOD_G_CM3: RangeInclusive<f64> = 0.1..=1.4;

/// The sizes of a fastener, mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum FastenerShape {
    /// A machine screw with a round head.
    Screw {
        /// Nominal diameter of the thread.
        thread_mm: f64,
        /// Length below the head.
        length_mm: f64,
        /// Diameter of the head.
        head_diameter_mm: f64,
        /// Height of the head.
        head_height_mm: f64,
        /// Diameter of the hole that it passes with play.
        hole_mm: f64,
    },
    /// A threaded insert that is pressed hot into a print.
    Insert {
        /// Nominal diameter of the thread.
        thread_mm: f64,
        /// Length.
        length_mm: f64,
        /// Diameter over the knurl.
        diameter_mm: f64,
        /// Diameter of the hole that is printed for it.
        hole_mm: f64,
    },
    /// A hexagon nut.
    Nut {
        /// Nominal diameter of the thread.
        thread_mm: f64,
        /// Diameter over the corners.
        diameter_mm: f64,
        /// Thickness.
        thickness_mm: f64,
    },
    /// A flat washer.
    Washer {
        /// Nominal diameter of the thread that it fits.
        thread_mm: f64,
        /// Outer diameter.
        diameter_mm: f64,
        /// Diameter of its hole.
        bore_mm: f64,
        /// Thickness.
        thickness_mm: f64,
    },
    /// A round rod that is sold by length and cut.
    Dowel {
        /// Diameter.
        diameter_mm: f64,
        /// Length as it is sold.
        length_mm: f64,
        /// Diameter of the hole into which it is glued.
        hole_mm: f64,
    },
}

impl FastenerShape {
    /// Returns the nominal diameter of its thread, mm; 0 for a rod.
    pub fn thread_mm(&self) -> f64 {
        match *self {
            Self::Screw { thread_mm, .. }
            | Self::Insert { thread_mm, .. }
            | Self::Nut { thread_mm, .. }
            | Self::Washer { thread_mm, .. } => thread_mm,
            Self::Dowel { .. } => 0.0,
        }
    }

    /// Returns the greatest diameter, mm.
    pub fn diameter_mm(&self) -> f64 {
        match *self {
            Self::Screw {
                head_diameter_mm, ..
            } => head_diameter_mm,
            Self::Insert { diameter_mm, .. }
            | Self::Nut { diameter_mm, .. }
            | Self::Washer { diameter_mm, .. }
            | Self::Dowel { diameter_mm, .. } => diameter_mm,
        }
    }

    /// Returns the plausible densities of the nominal shape, g/cm³: of steel and brass, or of wood.
    pub(super) fn density_g_cm3(&self) -> RangeInclusive<f64> {
        match self {
            Self::Dowel { .. } => WOOD_G_CM3,
            _ => METAL_G_CM3,
        }
    }

    /// Returns the volume of the nominal shape, mm³, threads and knurls as full cylinders.
    pub fn volume_mm3(&self) -> f64 {
        let rod = |diameter: f64, length: f64| FRAC_PI_4 * diameter * diameter * length;
        match *self {
            Self::Screw {
                thread_mm,
                length_mm,
                head_diameter_mm,
                head_height_mm,
                ..
            } => rod(thread_mm, length_mm) + HEAD_RATIO * rod(head_diameter_mm, head_height_mm),
            Self::Insert {
                thread_mm,
                length_mm,
                diameter_mm,
                ..
            } => rod(diameter_mm, length_mm) - rod(thread_mm, length_mm),
            Self::Nut {
                thread_mm,
                diameter_mm,
                thickness_mm,
            } => {
                let hexagon_mm2 = HEXAGON * diameter_mm * diameter_mm;
                hexagon_mm2 * thickness_mm - rod(thread_mm, thickness_mm)
            }
            Self::Washer {
                diameter_mm,
                bore_mm,
                thickness_mm,
                ..
            } => rod(diameter_mm, thickness_mm) - rod(bore_mm, thickness_mm),
            Self::Dowel {
                diameter_mm,
                length_mm,
                ..
            } => rod(diameter_mm, length_mm),
        }
    }

    /// Returns every size with its key, mm.
    pub fn sizes_mm(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Screw {
                thread_mm,
                length_mm,
                head_diameter_mm,
                head_height_mm,
                hole_mm,
            } => vec![
                ("thread_mm", thread_mm),
                ("length_mm", length_mm),
                ("head_diameter_mm", head_diameter_mm),
                ("head_height_mm", head_height_mm),
                ("hole_mm", hole_mm),
            ],
            Self::Insert {
                thread_mm,
                length_mm,
                diameter_mm,
                hole_mm,
            } => vec![
                ("thread_mm", thread_mm),
                ("length_mm", length_mm),
                ("diameter_mm", diameter_mm),
                ("hole_mm", hole_mm),
            ],
            Self::Nut {
                thread_mm,
                diameter_mm,
                thickness_mm,
            } => vec![
                ("thread_mm", thread_mm),
                ("diameter_mm", diameter_mm),
                ("thickness_mm", thickness_mm),
            ],
            Self::Washer {
                thread_mm,
                diameter_mm,
                bore_mm,
                thickness_mm,
            } => vec![
                ("thread_mm", thread_mm),
                ("diameter_mm", diameter_mm),
                ("bore_mm", bore_mm),
                ("thickness_mm", thickness_mm),
            ],
            Self::Dowel {
                diameter_mm,
                length_mm,
                hole_mm,
            } => vec![
                ("diameter_mm", diameter_mm),
                ("length_mm", length_mm),
                ("hole_mm", hole_mm),
            ],
        }
    }

    /// Returns two sizes of which the first must be below the second, with their keys.
    pub(super) fn order(&self) -> [(&'static str, f64); 2] {
        match *self {
            Self::Screw {
                hole_mm,
                head_diameter_mm,
                ..
            } => [("hole_mm", hole_mm), ("head_diameter_mm", head_diameter_mm)],
            Self::Insert {
                thread_mm,
                diameter_mm,
                ..
            }
            | Self::Nut {
                thread_mm,
                diameter_mm,
                ..
            } => [("thread_mm", thread_mm), ("diameter_mm", diameter_mm)],
            Self::Washer {
                bore_mm,
                diameter_mm,
                ..
            } => [("bore_mm", bore_mm), ("diameter_mm", diameter_mm)],
            Self::Dowel {
                diameter_mm,
                hole_mm,
                ..
            } => [("diameter_mm", diameter_mm), ("hole_mm", hole_mm)],
        }
    }
}
