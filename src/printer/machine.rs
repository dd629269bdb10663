//! A printer with all its numbers settled.

use std::{collections::BTreeMap, path::Path};

use serde::{Deserialize, Serialize};

use super::{
    ExcludedCorner, Material, MaterialError, ProfileError, Quantity, SizedWall, Sourced,
    error::suggestion, library,
};

/// What the steps of a printer's grid in x and y are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Grid {
    /// Pixels of a display, a print head or a laser's raster.
    Pixel,
    /// Lines of extruded filament.
    Line,
}

impl Grid {
    /// Its steps, in words.
    pub fn steps(self) -> &'static str {
        match self {
            Self::Pixel => "pixels",
            Self::Line => "line widths",
        }
    }
}

/// What holds overhangs up while printing, and so what must come out of a void.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Support {
    /// Dissolves or melts out: any opening that is large enough will do.
    Soluble,
    /// Broken off by hand: the wall of a void must be in sight of the opening.
    Breakaway,
    /// Flushed out by a jet of water: the wall of a void must be in sight of the opening.
    WaterJet,
    /// Nothing is needed.
    None,
}

impl Support {
    /// Whether every place of a void's wall must be in sight of its opening to be cleaned.
    pub fn needs_sight(self) -> bool {
        matches!(self, Self::Breakaway | Self::WaterJet)
    }
}

/// How parts are best laid on the plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PrintPose {
    /// Open hollows up, so that no support fills them from above (PolyJet puts none on top faces).
    OpenHollowsUp,
    /// The cut face on the plate.
    CutFaceDown,
}

/// How far a printed dimension may be from the drawn one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tolerance {
    /// The tolerance of a short dimension, mm.
    pub least_mm: Sourced<f64>,
    /// What of a long dimension's tolerance does not grow with it, mm; zero where it is not given.
    pub base_mm: Option<Sourced<f64>>,
    /// The tolerance of a long dimension over its length; none where it does not grow.
    pub ratio: Option<Sourced<f64>>,
}

impl Tolerance {
    /// The tolerance of a dimension of `length_mm`, ± mm: base + ratio × length, and not below the
    /// least. Both of the makers' forms are that: "±0.3 %, at least 0.3 mm" has no base, "±0.3 mm +
    /// 0.002 mm/mm" has the least as its base.
    pub fn at_mm(&self, length_mm: f64) -> f64 {
        let number =
            |number: &Option<Sourced<f64>>| number.as_ref().map_or(0.0, |number| number.value);
        let growing_mm = number(&self.base_mm) + number(&self.ratio) * length_mm;
        self.least_mm.value.max(growing_mm)
    }
}

/// A printer: what it can resolve, what it needs to be able to clean, join and fit parts, and its
/// materials.
///
/// All numbers are positive and finite; lengths are in mm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Printer {
    /// Its id, as `--printer` takes it.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// The process it inherits from, if any.
    pub process: Option<String>,
    /// The profiles it inherits from, the nearest first; the process is the last.
    pub inherits: Vec<String>,
    /// SHA-256 of the profile's text followed by those of what it inherits from, in hexadecimal.
    pub profile_sha256: String,
    /// What the steps of its grid are.
    pub grid: Grid,
    /// Pixel size or line width along x.
    pub pixel_x_mm: Sourced<f64>,
    /// Pixel size or line width along y.
    pub pixel_y_mm: Sourced<f64>,
    /// Layer height.
    pub layer_mm: Sourced<f64>,
    /// Width, depth and height of what fits; none where no source was found.
    pub build_volume_mm: Option<Sourced<[f64; 3]>>,
    /// The sides of the largest part that should be printed; none where it is the build volume.
    pub largest_part_mm: Option<Sourced<[f64; 3]>>,
    /// Corners of the plate where nothing may be printed.
    pub excluded_corners: Vec<ExcludedCorner>,
    /// The thinnest wall of parts up to a size, the smallest first; beyond the last it is
    /// `min_wall_mm`.
    pub walls_by_part_size: Vec<SizedWall>,
    /// Whether the machine or its software makes up for shrinkage; none where that is not known,
    /// and it is taken to.
    pub compensates_shrinkage: Option<Sourced<bool>>,
    /// The thinnest wall that prints and survives cleaning.
    pub min_wall_mm: Sourced<f64>,
    /// The smallest detail that prints.
    pub min_feature_mm: Sourced<f64>,
    /// The narrowest opening through which support, resin or powder can be got out of a void.
    pub min_opening_mm: Sourced<f64>,
    /// The thinnest pin that holds.
    pub pin_min_diameter_mm: Sourced<f64>,
    /// A pin's length over its diameter.
    pub pin_length_ratio: Sourced<f64>,
    /// Gap between pin and socket on each side.
    pub clearance_per_side_mm: Sourced<f64>,
    /// How much deeper than its pin a socket is.
    pub socket_extra_depth_mm: Sourced<f64>,
    /// Chamfer of pins and of the mouths of sockets.
    pub chamfer_mm: Sourced<f64>,
    /// How far dimensions may be off.
    pub tolerance: Tolerance,
    /// What holds overhangs up.
    pub support: Support,
    /// How parts are best laid on the plate.
    pub print_pose: PrintPose,
    /// How a void is cleaned: a sentence for the job sheet.
    pub cleaning: String,
    /// What it prints, never empty; the default is first.
    pub materials: Vec<Material>,
    /// What is known besides, of the quantities that no printer needs ([`Quantity::is_needed`]).
    #[serde(flatten)]
    pub besides: BTreeMap<Quantity, Sourced<f64>>,
}

impl Printer {
    /// The built-in printer of that id, or the one described by that TOML file.
    pub fn find(id_or_path: &str) -> Result<Self, ProfileError> {
        library::BUILT_IN.find(id_or_path)
    }

    /// Every built-in printer, in the order of their ids.
    pub fn all() -> Result<Vec<Self>, ProfileError> {
        library::BUILT_IN.all()
    }

    /// The printer described by the TOML file at `path`, even if a built-in one has that name.
    pub fn read(path: &Path) -> Result<Self, ProfileError> {
        library::BUILT_IN.read(path)
    }

    /// Every number of the profile's `[numbers]`, in the order of [`Quantity`].
    pub fn numbers(&self) -> Vec<(Quantity, &Sourced<f64>)> {
        Quantity::ALL
            .iter()
            .filter_map(|&quantity| Some((quantity, self.number(quantity)?)))
            .collect()
    }

    /// A number of the profile's `[numbers]`; none where it is not known.
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
            other => self.besides.get(&other)?,
        })
    }

    /// What is not known of the printer, by key, in the order of [`Quantity`].
    pub fn unknown(&self) -> Vec<&'static str> {
        let numbers = Quantity::ALL
            .iter()
            .filter(|&&quantity| self.number(quantity).is_none());
        let volume = self.build_volume_mm.is_none().then_some("build_volume_mm");
        let shrinkage = self
            .compensates_shrinkage
            .is_none()
            .then_some("compensates_shrinkage");
        volume
            .into_iter()
            .chain(shrinkage)
            .chain(numbers.map(|quantity| quantity.key()))
            .collect()
    }

    /// The material of that id; the printer's default where none is asked for.
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
                remedy: suggestion(id, &known),
            }
        })
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
    fn the_first_material_is_the_default_and_an_unknown_one_is_told_with_the_nearest() {
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
    fn a_weighing_window_lies_evenly_about_the_mass_and_only_a_measured_density_has_one() {
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
    fn the_tolerance_grows_with_length_only_where_the_process_says_so() {
        let mk4 = printer("prusa-mk4").tolerance;
        assert_eq!(mk4.at_mm(10.0), 0.3);
        assert!((mk4.at_mm(200.0) - 0.6).abs() < 1e-12);
        assert_eq!(printer("objet-connex350").tolerance.at_mm(1000.0), 0.1);
        let mjf = printer("hp-mjf-5200").tolerance;
        assert!((mjf.at_mm(100.0) - 0.5).abs() < 1e-12, "0.30 + 0.002 × 100");
    }
}
