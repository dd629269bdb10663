//! The printer: all its numbers, complete and checked.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::base::dialect::Dialect;
use crate::base::walls::Walls;

use super::{
    ExcludedCorner, InfillPattern, Material, MaterialError, Quantity, Sourced, error::suggest,
};

/// The steps of a printer's grid in x and y.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Grid {
    /// Pixels of a display, a print head or a laser's raster.
    Pixel,
    /// Lines of extruded filament.
    Line,
}

impl Grid {
    /// Returns the word for its steps.
    pub fn steps(self) -> &'static str {
        match self {
            Self::Pixel => "pixels",
            Self::Line => "line widths",
        }
    }
}

/// The support of overhangs while printing, which must be removed from voids.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Support {
    /// Dissolves or melts out: any opening that is large enough serves.
    Soluble,
    /// Broken off by hand: the wall of a void must be visible from the opening.
    Breakaway,
    /// Flushed out by a water jet: the wall of a void must be visible from the opening.
    WaterJet,
    /// No support is needed.
    None,
}

impl Support {
    /// True if a void can be cleaned only if its wall is visible from an opening.
    pub fn needs_sight(self) -> bool {
        matches!(self, Self::Breakaway | Self::WaterJet)
    }
}

/// A value of a printer that its profile does not state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// The build volume.
    BuildVolume,
    /// Whether its slicer compensates for shrinkage.
    Shrinkage,
    /// A number.
    Number(Quantity),
}

impl Unknown {
    /// Returns its key in a profile.
    pub fn key(self) -> &'static str {
        match self {
            Self::BuildVolume => "build_volume_mm",
            Self::Shrinkage => "compensates_shrinkage",
            Self::Number(quantity) => quantity.key(),
        }
    }
}

/// The best pose of a part on the plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PrintPose {
    /// Open hollows up, so that no support fills them from above (PolyJet puts none on top faces).
    OpenHollowsUp,
    /// The cut face on the plate.
    CutFaceDown,
}

/// The greatest deviation of a printed dimension from the drawn one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tolerance {
    /// The least tolerance, that of short dimensions, mm.
    pub least_mm: Sourced<f64>,
    /// The constant part of a long dimension's tolerance, mm; 0 if not given.
    pub base_mm: Option<Sourced<f64>>,
    /// The growing part of a long dimension's tolerance, over its length; `None` if it does not
    /// grow.
    pub ratio: Option<Sourced<f64>>,
}

impl Tolerance {
    /// Returns the tolerance of a dimension of `length_mm`, ± mm: base + ratio × length, but at
    /// least [`Self::least_mm`].
    ///
    /// Makers state tolerances in two forms. The form "±0.3 %, at least 0.3 mm" has no base. The
    /// form "±0.3 mm + 0.002 mm/mm" has the least as its base.
    pub fn at_mm(&self, length_mm: f64) -> f64 {
        let number =
            |number: &Option<Sourced<f64>>| number.as_ref().map_or(0.0, |number| number.value);
        let growing_mm = number(&self.base_mm) + number(&self.ratio) * length_mm;
        self.least_mm.value.max(growing_mm)
    }
}

/// The thinnest wall of parts up to a size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizedWall {
    /// The longest side of a part that may have this wall, mm.
    pub up_to_mm: f64,
    /// The wall, mm.
    pub wall_mm: Sourced<f64>,
}

/// A printer: its resolution, its limits for walls, openings, pins and fits, and its materials.
///
/// All numbers are positive and finite; lengths are in mm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Printer {
    /// Its id, by which jobs name it.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// The process it inherits from, if any.
    pub process: Option<String>,
    /// The profiles it inherits from, the nearest first; the process is the last.
    pub inherits: Vec<String>,
    /// SHA-256 of the profile's text followed by the texts of its parents, in hexadecimal.
    pub profile_sha256: String,
    /// The steps of its grid in x and y.
    pub grid: Grid,
    /// Pixel size or line width along x.
    pub pixel_x_mm: Sourced<f64>,
    /// Pixel size or line width along y.
    pub pixel_y_mm: Sourced<f64>,
    /// Layer height.
    pub layer_mm: Sourced<f64>,
    /// Width, depth and height of the build volume; `None` if no source states it.
    pub build_volume_mm: Option<Sourced<[f64; 3]>>,
    /// Sides of the largest recommended part; `None` if only the build volume limits parts.
    pub largest_part_mm: Option<Sourced<[f64; 3]>>,
    /// Corners of the plate that must stay free.
    pub excluded_corners: Vec<ExcludedCorner>,
    /// The thinnest wall of parts up to a size, the smallest first. Above the last size,
    /// `min_wall_mm` applies.
    pub walls_by_part_size: Vec<SizedWall>,
    /// True if the machine or its software compensates shrinkage; `None` if that is unknown, which
    /// counts as true.
    pub compensates_shrinkage: Option<Sourced<bool>>,
    /// The family of slicers that its plates give orders to; `None` for a printer without slicers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dialect: Option<Sourced<Dialect>>,
    /// The pattern of sparse infill; `None` for a printer without infill.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub infill: Option<InfillPattern>,
    /// The thinnest wall that prints and survives cleaning.
    pub min_wall_mm: Sourced<f64>,
    /// The smallest detail that prints.
    pub min_feature_mm: Sourced<f64>,
    /// The narrowest opening through which support, resin or powder comes out of a void.
    pub min_opening_mm: Sourced<f64>,
    /// The thinnest pin that holds.
    pub pin_min_diameter_mm: Sourced<f64>,
    /// Length of a pin over its diameter.
    pub pin_length_ratio: Sourced<f64>,
    /// Gap between pin and socket on each side.
    pub clearance_per_side_mm: Sourced<f64>,
    /// Depth of a socket beyond the end of its pin.
    pub socket_extra_depth_mm: Sourced<f64>,
    /// Chamfer of pins and socket mouths.
    pub chamfer_mm: Sourced<f64>,
    /// The tolerance of printed dimensions.
    pub tolerance: Tolerance,
    /// The support of overhangs.
    pub support: Support,
    /// The best pose of a part on the plate.
    pub print_pose: PrintPose,
    /// Instruction for cleaning a void: a sentence for the job sheet.
    pub cleaning: String,
    /// The glue for its materials: a name for the job sheet.
    pub glue: Option<String>,
    /// The dangers of that glue: sentences for the job sheet.
    pub glue_safety: Option<String>,
    /// The materials it prints, never empty; the default is first.
    pub materials: Vec<Material>,
    /// The known numbers among those that a printer may lack ([`Quantity::is_needed`]).
    #[serde(flatten)]
    pub optional_numbers: BTreeMap<Quantity, Sourced<f64>>,
}

impl Printer {
    /// Returns the family of slicers that its plates give orders to: PrusaSlicer's if none is
    /// stated.
    pub fn dialect(&self) -> Dialect {
        self.dialect
            .as_ref()
            .map_or_else(Dialect::default, |dialect| dialect.value)
    }

    /// Returns the lines and layers that its slicer lays solid; the usual ones where none are
    /// stated. Numbers of them are rounded.
    pub fn walls(&self) -> Walls {
        let usual = Walls::default();
        let stated = |quantity| self.number(quantity).map(|number| number.value);
        let count = |quantity| stated(quantity).map(|number| number.round() as usize);
        Walls {
            perimeters: count(Quantity::Perimeters).unwrap_or(usual.perimeters),
            solid_layers: count(Quantity::SolidLayers).unwrap_or(usual.solid_layers),
            overlap_ratio: stated(Quantity::InfillOverlapRatio).unwrap_or(usual.overlap_ratio),
        }
    }

    /// Returns the gap on each side of what is pressed into a print, mm: that of a pressed joint.
    /// If the profile does not know it, half of that of a glued one.
    pub fn snug_gap_mm(&self) -> f64 {
        let press = self.number(Quantity::ClearancePressPerSideMm);
        press.map_or(0.5 * self.clearance_per_side_mm.value, |gap| gap.value)
    }

    /// Returns every known number of the profile's `[numbers]`, in the order of [`Quantity`].
    pub fn numbers(&self) -> Vec<(Quantity, &Sourced<f64>)> {
        Quantity::ALL
            .iter()
            .filter_map(|&quantity| Some((quantity, self.number(quantity)?)))
            .collect()
    }

    /// Returns a number of the profile's `[numbers]`; `None` if it is not known.
    pub fn number(&self, quantity: Quantity) -> Option<&Sourced<f64>> {
        Some(match quantity {
            Quantity::PixelXMm => &self.pixel_x_mm,
            Quantity::PixelYMm => &self.pixel_y_mm,
            Quantity::LayerMm => &self.layer_mm,
            Quantity::MinWallMm => &self.min_wall_mm,
            Quantity::MinFeatureMm => &self.min_feature_mm,
            Quantity::MinOpeningMm => &self.min_opening_mm,
            Quantity::PinMinDiameterMm => &self.pin_min_diameter_mm,
            Quantity::PinLengthRatio => &self.pin_length_ratio,
            Quantity::ClearancePerSideMm => &self.clearance_per_side_mm,
            Quantity::SocketExtraDepthMm => &self.socket_extra_depth_mm,
            Quantity::ChamferMm => &self.chamfer_mm,
            Quantity::ToleranceLeastMm => &self.tolerance.least_mm,
            Quantity::ToleranceBaseMm => self.tolerance.base_mm.as_ref()?,
            Quantity::ToleranceRatio => self.tolerance.ratio.as_ref()?,
            other => self.optional_numbers.get(&other)?,
        })
    }

    /// Lists all unknown values: the build volume, the shrinkage, then the numbers in the order of
    /// [`Quantity`] but for those that only estimate times.
    pub fn unknown(&self) -> Vec<Unknown> {
        let numbers = Quantity::ALL
            .iter()
            .filter(|&&quantity| !quantity.is_for_estimates() && self.number(quantity).is_none());
        let volume = self
            .build_volume_mm
            .is_none()
            .then_some(Unknown::BuildVolume);
        let shrinkage = self
            .compensates_shrinkage
            .is_none()
            .then_some(Unknown::Shrinkage);
        volume
            .into_iter()
            .chain(shrinkage)
            .chain(numbers.copied().map(Unknown::Number))
            .collect()
    }

    /// Returns the material of that id, or the printer's default for `None`.
    pub fn material(&self, id: Option<&str>) -> Result<&Material, MaterialError> {
        let wanted = self
            .materials
            .iter()
            .find(|material| id.is_none_or(|id| material.id == id));
        wanted.ok_or_else(|| {
            let known: Vec<&str> = self
                .materials
                .iter()
                .map(|material| material.id.as_str())
                .collect();
            let id = id.unwrap_or_default();
            MaterialError {
                printer: self.id.clone(),
                id: id.to_owned(),
                remedy: suggest(id, &known),
            }
        })
    }
}

impl Printer {
    /// Returns the gap on each side with which shells of a material slide; `None` if it is not
    /// known.
    pub fn slide_clearance<'a>(&'a self, material: &'a Material) -> Option<&'a Sourced<f64>> {
        let own = material.clearance_slide_per_side_mm.as_ref();
        own.or_else(|| self.number(Quantity::ClearanceSlidePerSideMm))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::Sure;

    fn printer(id: &str) -> Printer {
        Printer::find(id).unwrap()
    }

    #[test]
    fn six_hundred_dots_an_inch_are_42_micrometres() {
        let objet = printer("objet-connex350");
        assert_eq!(objet.pixel_x_mm.value, 25.4 / 600.0);
        assert!((objet.layer_mm.value - 0.015_875).abs() < 1e-15);
    }

    #[test]
    fn the_first_material_is_the_default_and_an_unknown_one_has_a_suggestion() {
        let mk4 = printer("prusa-mk4");
        assert_eq!(mk4.material(None).unwrap().id, "pla");
        assert_eq!(mk4.material(Some("asa")).unwrap().density_g_mm3(), 1.07e-3);
        let error = mk4.material(Some("pegt")).unwrap_err();
        assert!(error.to_string().contains("did you mean `petg`"), "{error}");
        let error = mk4.material(Some("vero-white")).unwrap_err();
        assert!(
            error.to_string().contains("pla, petg, asa, abs, pc"),
            "{error}"
        );
    }

    #[test]
    fn only_a_measured_density_gives_a_weighing_window_and_it_is_symmetric() {
        let mut pla = printer("prusa-mk4").material(None).unwrap().clone();
        assert_eq!(pla.weighing_window_g(100.0), None);
        pla.density_g_cm3.sure = Sure::Measured;
        let spread = Sourced {
            value: 0.02,
            sure: Sure::Measured,
            ..pla.density_g_cm3.clone()
        };
        pla.density_spread_ratio = Some(spread);
        let window = pla.weighing_window_g(100.0).unwrap();
        assert!((window[0] - 98.0).abs() < 1e-12 && (window[1] - 102.0).abs() < 1e-12);
    }

    #[test]
    fn a_material_may_slide_with_a_gap_of_its_own() {
        let mk4 = printer("prusa-mk4");
        let gap = |material| {
            let material = mk4.material(Some(material)).unwrap();
            mk4.slide_clearance(material).unwrap().value
        };
        assert_eq!((gap("pla"), gap("petg")), (0.3, 0.4));
        let sla = printer("formlabs-form4");
        assert_eq!(sla.number(Quantity::ClearanceInPlacePerSideMm), None);
        let all = Printer::all().unwrap();
        let slides = |printer: &Printer| printer.slide_clearance(&printer.materials[0]).is_some();
        assert!(all.iter().all(slides));
    }

    #[test]
    fn the_tolerance_grows_with_length_only_if_the_process_says_so() {
        let mk4 = printer("prusa-mk4").tolerance;
        assert_eq!(mk4.at_mm(10.0), 0.3);
        assert!((mk4.at_mm(200.0) - 0.6).abs() < 1e-12);
        assert_eq!(printer("objet-connex350").tolerance.at_mm(1000.0), 0.1);
        let mjf = printer("hp-mjf-5200").tolerance;
        assert!((mjf.at_mm(100.0) - 0.5).abs() < 1e-12, "0.30 + 0.002 × 100");
    }
}
