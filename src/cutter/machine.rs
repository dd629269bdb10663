//! Laser cutters: bed, kerf, the finest cuts, and what they can cut.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

use super::material::SheetMaterial;
use super::stock::StockSheet;
use crate::base::sourced::{Sourced, Sure};
use crate::base::words::choice;

/// Least distance of two outlines on a sheet, mm.
const LEAST_SPACING_MM: f64 = 3.0;

choice! {
    /// The way in which a drawing tells cuts from engravings.
    Dialect, "drawing dialect" {
        /// Outer cuts black, inner cuts blue, engraving green, notes red.
        Boxes = "boxes",
        /// The layers C00, C01 and C02 of LightBurn.
        Lightburn = "lightburn",
        /// Any colours; inner and outer cuts must differ, or the outline is cut first.
        Glowforge = "glowforge",
    }
}

impl Dialect {
    /// Returns the colours of engraving, inner cuts, outer cuts and the sheet's edge: red, green
    /// and blue, 0 to 255.
    pub fn colors(self) -> [[u8; 3]; 4] {
        const BLACK: [u8; 3] = [0, 0, 0];
        const BLUE: [u8; 3] = [0, 0, 255];
        const RED: [u8; 3] = [255, 0, 0];
        const GREEN: [u8; 3] = [0, 255, 0];
        match self {
            Self::Boxes => [GREEN, BLUE, BLACK, RED],
            // C02, C01 and C00 of its palette, and a tool layer, which is not cut.
            Self::Lightburn => [RED, BLUE, BLACK, [243, 105, 38]],
            Self::Glowforge => [GREEN, BLUE, BLACK, RED],
        }
    }
}

/// A number of a cutter's `[numbers]` table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CutterNumber {
    /// The width of bed that stays free at each side.
    MarginMm,
    /// The angle by which the sides of a cut lean.
    TaperDeg,
    /// The narrowest strip that survives.
    MinFeatureMm,
    /// The least gap between two cuts.
    MinGapMm,
    /// The power of the tube.
    PowerW,
}

/// The width of the cut in a sheet.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Kerf {
    /// The material.
    pub material: SheetMaterial,
    /// The thickness of the sheet, mm.
    pub thickness_mm: f64,
    /// The whole width of the cut, mm.
    pub kerf_mm: Sourced<f64>,
    /// The speed of the cut, mm/s; `None` if it is not known.
    pub speed_mm_s: Option<f64>,
}

/// The thickest sheet of a material that a cutter cuts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Thickest {
    /// The material.
    pub material: SheetMaterial,
    /// The thickness, mm.
    pub thickness_mm: Sourced<f64>,
}

/// A laser cutter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cutter {
    /// The id, which is also the name of its file.
    pub id: String,
    /// The name for people.
    pub name: String,
    /// The parent that its profile names.
    pub inherits: Option<String>,
    /// SHA-256 of its profile and all parents.
    pub profile_sha256: String,
    /// Width and depth of the bed, mm.
    pub bed_mm: Sourced<[f64; 2]>,
    /// The colours and layers of its drawings.
    pub dialect: Dialect,
    /// True if the shop's software offsets the cuts by half the kerf itself.
    pub compensates_kerf: Sourced<bool>,
    /// The kerfs, by material and then by thickness.
    pub kerfs: Vec<Kerf>,
    /// The thickest sheets, by material.
    pub thickest: Vec<Thickest>,
    /// The other numbers; each may be missing.
    pub numbers: BTreeMap<CutterNumber, Sourced<f64>>,
}

/// The kerf in a sheet of any thickness.
#[derive(Debug, Clone, PartialEq)]
pub struct KerfAt {
    /// The width of the cut, mm.
    pub kerf_mm: f64,
    /// Its source, in words.
    pub provenance: String,
    /// The certainty; that of the less certain of two entries.
    pub sure: Sure,
}

/// The reason that a cutter cannot cut a sheet.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CannotCut {
    /// A material without a kerf.
    #[error(
        "`{cutter}` has no kerf for {material}; remedy: measure it and add it to the profile, or \
         use {known}"
    )]
    Material {
        /// The cutter.
        cutter: String,
        /// The material of the sheet.
        material: SheetMaterial,
        /// The materials with a kerf.
        known: String,
    },
    /// A sheet that is too thick.
    #[error("`{cutter}` cuts {material} up to {most_mm} mm, not {thickness_mm} mm")]
    TooThick {
        /// The cutter.
        cutter: String,
        /// The material of the sheet.
        material: SheetMaterial,
        /// Its thickness, mm.
        thickness_mm: f64,
        /// The thickest sheet, mm.
        most_mm: f64,
    },
}

/// A sheet as it lies on the bed of a cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnBed {
    /// Both sides along those of the bed, mm.
    pub size_mm: [f64; 2],
    /// True if it lies turned by a quarter: its first side, and its grain, run along the second
    /// side of the bed.
    pub is_turned: bool,
}

impl Cutter {
    /// Returns the kerf in a sheet: between two listed thicknesses in proportion, beyond them that
    /// of the nearest.
    pub fn kerf(&self, material: SheetMaterial, thickness_mm: f64) -> Result<KerfAt, CannotCut> {
        let is_of = |kerf: &&Kerf| kerf.material == material;
        let mut below = self.kerfs.iter().filter(is_of);
        let below = below.rfind(|kerf| kerf.thickness_mm <= thickness_mm);
        let mut above = self.kerfs.iter().filter(is_of);
        let above = above.find(|kerf| kerf.thickness_mm >= thickness_mm);
        match (below, above) {
            (Some(thin), Some(thick)) if thin != thick => Ok(between(thin, thick, thickness_mm)),
            (Some(only), _) | (None, Some(only)) => Ok(KerfAt {
                kerf_mm: only.kerf_mm.value,
                provenance: format!("{} mm: {}", only.thickness_mm, only.kerf_mm.provenance()),
                sure: only.kerf_mm.sure,
            }),
            (None, None) => Err(CannotCut::Material {
                cutter: self.id.clone(),
                material,
                known: self.materials().join(", "),
            }),
        }
    }

    fn materials(&self) -> Vec<&'static str> {
        let mut known: Vec<&str> = self.kerfs.iter().map(|kerf| kerf.material.word()).collect();
        known.dedup();
        known
    }

    /// Checks that a sheet can be cut, and returns the kerf in it.
    pub fn check_sheet(&self, sheet: &StockSheet) -> Result<KerfAt, CannotCut> {
        let (material, thickness_mm) = (sheet.material, sheet.thickness_mm.value);
        let limit = self
            .thickest
            .iter()
            .find(|limit| limit.material == material);
        let most_mm = limit.map_or(f64::INFINITY, |limit| limit.thickness_mm.value);
        if thickness_mm > most_mm {
            let cutter = self.id.clone();
            return Err(CannotCut::TooThick {
                cutter,
                material,
                thickness_mm,
                most_mm,
            });
        }
        self.kerf(material, thickness_mm)
    }

    /// Returns the rectangles in which a face can be cut out of a sheet, mm, in the order of the
    /// sheet's sizes. Each is what of the sheet fits the bed, less the margin at each side.
    pub fn rooms_mm(&self, sheet: &StockSheet) -> Vec<[f64; 2]> {
        let margin = self.numbers.get(&CutterNumber::MarginMm);
        let margin_mm = margin.map_or(0.0, |margin| margin.value);
        let room = |size: [f64; 2]| {
            let on_bed = self.on_bed(size).size_mm;
            on_bed.map(|side| (side - 2.0 * margin_mm).max(0.0))
        };
        let sizes = sheet.sizes.iter();
        sizes.map(|stock| room(stock.size_mm.value)).collect()
    }

    /// Returns what of a sheet with these sides, mm, lies on the bed: as it is, or turned if that
    /// is larger.
    pub fn on_bed(&self, sheet_mm: [f64; 2]) -> OnBed {
        let bed = self.bed_mm.value;
        let fitted = |[x, y]: [f64; 2]| [x.min(bed[0]), y.min(bed[1])];
        let [lying, turned] = [fitted(sheet_mm), fitted([sheet_mm[1], sheet_mm[0]])];
        let is_larger = lying[0] * lying[1] >= turned[0] * turned[1];
        OnBed {
            size_mm: if is_larger { lying } else { turned },
            is_turned: !is_larger,
        }
    }

    /// Returns the least distance of two outlines on a sheet, mm, where the cut has this width: the
    /// strip between them stays in one piece.
    pub fn spacing_mm(&self, kerf_mm: f64) -> f64 {
        let least = self.numbers.get(&CutterNumber::MinGapMm);
        let least_mm = least.map_or(0.0, |gap| gap.value);
        LEAST_SPACING_MM.max(least_mm + 2.0 * kerf_mm)
    }

    /// Returns the part of a cut's width, mm, by which drawings are offset: none of it if the
    /// shop's software does that.
    pub fn offset_mm(&self, kerf_mm: f64) -> f64 {
        if self.compensates_kerf.value {
            0.0
        } else {
            kerf_mm
        }
    }
}

fn between(thin: &Kerf, thick: &Kerf, thickness_mm: f64) -> KerfAt {
    let share = (thickness_mm - thin.thickness_mm) / (thick.thickness_mm - thin.thickness_mm);
    let [low, high] = [thin, thick].map(|kerf| kerf.kerf_mm.value);
    let [from, to] = [thin, thick].map(|kerf| {
        let provenance = kerf.kerf_mm.provenance();
        format!("{} mm: {provenance}", kerf.thickness_mm)
    });
    KerfAt {
        kerf_mm: low + share * (high - low),
        provenance: format!("in proportion between {from}, and {to}"),
        sure: thin.kerf_mm.sure.max(thick.kerf_mm.sure),
    }
}
