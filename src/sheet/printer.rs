//! The printer, its material, the wall, and what the machine makes of lengths.

use serde::{Deserialize, Serialize};

use crate::verify::Cleaning;

/// The printer, as far as the shop and the judge need it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PrinterRow {
    /// The id of its profile.
    pub id: String,
    /// The SHA-256 of that profile and the ones it inherits from.
    #[serde(default)]
    pub profile_sha256: String,
    /// Its name.
    pub name: String,
    /// The process, such as `polyjet` or `fdm`.
    pub process: String,
    /// Pixels or line widths along x and y, mm.
    pub pixel_mm: [f64; 2],
    /// The height of a layer, mm.
    pub layer_mm: f64,
    /// The edges of the build volume, mm; unknown for some machines.
    pub build_volume_mm: Option<[f64; 3]>,
    /// What files are multiplied by along x, y and z so that shrunken parts have their nominal
    /// size; none where files are nominal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub print_scale_ratio: Option<[f64; 3]>,
    /// What holds overhangs and must come out of the voids: `soluble`, `breakaway`, `water-jet` or
    /// `none`.
    pub support: String,
    /// The least wall the process prints, mm.
    pub minimum_wall_mm: f64,
    /// The least opening through which a void can be cleaned, mm.
    pub minimum_opening_mm: f64,
    /// When a void counts as clean.
    pub cleaning: Cleaning,
    /// What each of these numbers rests on, in words: sources, and what is only assumed.
    pub sources: Vec<String>,
}

/// The material the masses rest on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MaterialRow {
    /// The id of its profile.
    pub id: String,
    /// Its name.
    pub name: String,
    /// g/cm³.
    pub density_g_cm3: f64,
    /// Where the density is from.
    pub density_source: String,
    /// How sure that source is, such as `read` or `recalled`.
    pub density_sure: String,
    /// How far the mass of a sound print may be from volume × density, as a share; no weighing
    /// window is printed where it is not known.
    pub density_spread_ratio: Option<f64>,
}

/// The wall that was ordered and the one that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WallRow {
    /// The least wall promised, mm: what was asked for, rounded up to what the printer makes.
    pub required_mm: f64,
    /// What was asked for, mm; none where the printer's least was taken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub asked_mm: Option<f64>,
    /// The least distance between a void and the outside on the written surfaces, mm; none without
    /// voids.
    pub measured_min_mm: Option<f64>,
}

/// A length as it was asked for, as it is drawn, and as the machine makes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GridRow {
    /// What it is, such as `wall` or `pin N1, diameter`.
    pub what: String,
    /// Along which direction of the printer: `x`, `y`, `z`, or `tilted`.
    pub along: String,
    /// What was asked for, mm.
    pub asked_mm: f64,
    /// What the files have, mm.
    pub drawn_mm: f64,
    /// What the machine's steps are called: `pixels`, `line widths` or `layers`.
    pub steps_of: String,
    /// One step, mm.
    pub step_mm: f64,
    /// How many whole steps it becomes; the least where that depends on where it lies between them.
    pub steps: u32,
    /// What the machine makes of it, mm: `steps` of `step_mm`.
    pub given_mm: f64,
    /// Whether what is drawn is a whole number of steps.
    pub is_whole: bool,
}
