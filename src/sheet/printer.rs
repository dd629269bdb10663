//! The rows of the printer, its material, the wall, and lengths as the machine makes them.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::base::dialect::Dialect;
use crate::verify::Cleaning;

/// The printer, as far as the shop and the judge need it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PrinterRow {
    /// Id of its profile.
    pub id: String,
    /// SHA-256 of that profile and the ones it inherits from.
    #[serde(default)]
    pub profile_sha256: String,
    /// Name.
    pub name: String,
    /// Process.
    pub process: Process,
    /// Pixels or line widths along x and y, mm.
    pub pixel_mm: [f64; 2],
    /// Height of a layer, mm.
    pub layer_mm: f64,
    /// Family of slicers that its plates give orders to; PrusaSlicer's if it is missing.
    #[serde(default, skip_serializing_if = "Dialect::is_usual")]
    pub dialect: Dialect,
    /// Edges of the build volume, mm; unknown for some machines.
    pub build_volume_mm: Option<[f64; 3]>,
    /// Factors by which files are enlarged along x, y and z to make up for shrinkage; `None` if
    /// files are nominal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub print_scale_ratio: Option<[f64; 3]>,
    /// Way in which support is removed.
    pub support: SupportMethod,
    /// Least wall the process prints, mm.
    pub minimum_wall_mm: f64,
    /// Least opening through which a void can be cleaned, mm.
    pub minimum_opening_mm: f64,
    /// Rule by which a void counts as clean.
    pub cleaning: Cleaning,
    /// Diameter of the thinnest printed pin, mm; `None` in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_pin_mm: Option<f64>,
    /// Largest step at the rim of a seam, mm; `None` if the profile names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seam_step_mm: Option<f64>,
    /// Glue for its materials; `None` if its profile names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glue: Option<GlueRow>,
    /// Sources of these numbers, in words, and which of them are assumed.
    pub sources: Vec<String>,
}

/// A glue, as far as the profile knows it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GlueRow {
    /// Name.
    pub name: String,
    /// Seconds for which the parts are held together.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold_s: Option<f64>,
    /// Hours after which it has its whole strength.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cure_h: Option<f64>,
    /// Dangers, in sentences.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub safety: Option<String>,
}

/// A printing process.
///
/// In JSON it is its word; a shop's own process keeps the word of its profile.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub enum Process {
    /// `fdm`: filament.
    Fdm,
    /// `mjf`: powder fused by an agent and heat.
    Mjf,
    /// `mjp`: jetted resin with wax support.
    Mjp,
    /// `polyjet`: jetted resin.
    Polyjet,
    /// `sla`: resin in a vat.
    Sla,
    /// `sls`: powder sintered by a laser.
    Sls,
    /// Any other word; empty if the profile names no process.
    Other(String),
}

impl From<String> for Process {
    fn from(word: String) -> Self {
        match word.as_str() {
            "fdm" => Self::Fdm,
            "mjf" => Self::Mjf,
            "mjp" => Self::Mjp,
            "polyjet" => Self::Polyjet,
            "sla" => Self::Sla,
            "sls" => Self::Sls,
            _ => Self::Other(word),
        }
    }
}

impl From<Process> for String {
    fn from(process: Process) -> Self {
        process.to_string()
    }
}

impl fmt::Display for Process {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fdm => "fdm",
            Self::Mjf => "mjf",
            Self::Mjp => "mjp",
            Self::Polyjet => "polyjet",
            Self::Sla => "sla",
            Self::Sls => "sls",
            Self::Other(word) => word,
        })
    }
}

/// The way in which support is removed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SupportMethod {
    /// It dissolves in a bath.
    Soluble,
    /// It is broken off.
    Breakaway,
    /// A water jet flushes it out.
    WaterJet,
    /// The process needs no support.
    None,
}

/// The material on which the masses rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MaterialRow {
    /// Id of its profile.
    pub id: String,
    /// Name.
    pub name: String,
    /// Density, g/cm³.
    pub density_g_cm3: f64,
    /// Source of the density.
    pub density_source: String,
    /// Certainty of that source, such as `read` or `recalled`.
    pub density_sure: String,
    /// Allowed relative deviation of the mass of a sound print from volume × density. Without it
    /// the sheet shows no weighing window.
    pub density_spread_ratio: Option<f64>,
    /// The same deviation as the profile states it, whether this shop measured it or not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub typical_spread_ratio: Option<f64>,
}

/// The wall as ordered and as measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WallRow {
    /// Least wall promised, mm: the ordered one, rounded up to what the printer makes.
    pub required_mm: f64,
    /// Ordered wall, mm; `None` if the printer's least wall was used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub asked_mm: Option<f64>,
    /// Least distance between a void and the outside on the written surfaces, mm; `None` without
    /// voids.
    pub measured_min_mm: Option<f64>,
}

/// A length as it was ordered, as it is drawn, and as the machine makes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GridRow {
    /// Name of the length, such as `wall` or `pin N1, diameter`.
    pub what: String,
    /// Direction of the printer.
    pub along: Direction,
    /// Ordered length, mm.
    pub asked_mm: f64,
    /// Length in the files, mm.
    pub drawn_mm: f64,
    /// Name of the machine's steps: `pixels`, `line widths` or `layers`.
    pub steps_of: String,
    /// Size of a step, mm.
    pub step_mm: f64,
    /// Number of whole steps it becomes; the least number if that depends on its position.
    pub steps: u32,
    /// Length that the machine makes, mm: `steps` of `step_mm`.
    pub given_mm: f64,
    /// `true` if the drawn length is a whole number of steps.
    pub is_whole: bool,
}

/// A direction of the printer along which a length is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Along x, in the plane of a layer.
    X,
    /// Along y, in the plane of a layer.
    Y,
    /// Upright, across the layers.
    Z,
    /// Along none of them.
    Tilted,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_process_reads_back_from_its_word() {
        for word in ["fdm", "mjf", "mjp", "polyjet", "sla", "sls", "ours", ""] {
            let process = Process::from(word.to_owned());
            let is_other = matches!(process, Process::Other(_));
            assert_eq!(serde_json::to_value(&process).unwrap(), word);
            assert_eq!(is_other, matches!(word, "ours" | ""));
        }
    }
}
