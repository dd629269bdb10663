//! The limits of the printer and the density of the material, as a kit promises them.

use serde::{Deserialize, Serialize};

use super::Cleaning;
use crate::base::dialect::Dialect;

/// The limits of a printer and its process.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PrinterLimits {
    /// The word of its process, such as `sla`; `None` if it is not known.
    #[serde(default)]
    pub process: Option<String>,
    /// The edges of the build volume along x, y and z, mm; unknown for some machines.
    pub build_volume_mm: Option<[f64; 3]>,
    /// The scale of the part files along x, y and z, which compensates shrinkage; `None` if they
    /// have nominal size.
    #[serde(default)]
    pub print_scale_ratio: Option<[f64; 3]>,
    /// The least wall the process prints, mm. As much must stay around sockets.
    pub minimum_wall_mm: f64,
    /// The least opening through which a void can be cleaned, mm.
    #[serde(default)]
    pub minimum_opening_mm: Option<f64>,
    /// The rule by which a void counts as clean; `None` if that is not judged.
    #[serde(default)]
    pub cleaning: Option<Cleaning>,
    /// The largest step at the rim of a seam, mm; `None` if that is not judged.
    #[serde(default)]
    pub seam_step_mm: Option<f64>,
    /// The family of slicers that its plates give orders to.
    #[serde(default, skip_serializing)]
    pub dialect: Dialect,
    /// The height of a layer, mm; `None` if it is not known.
    #[serde(default, skip_serializing)]
    pub layer_mm: Option<f64>,
    /// The width of a line of filament, or a pixel, along x and y, mm; `None` if it is not known.
    #[serde(default, skip_serializing)]
    pub pixel_mm: Option<[f64; 2]>,
}

/// The density the masses rest on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Density {
    /// g/cm³.
    pub density_g_cm3: f64,
}
