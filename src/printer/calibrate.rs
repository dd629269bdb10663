//! Writing of measured values into a shop's own profile, with day and lot. The rest of the file
//! stays as it is.

use serde::Deserialize;
use toml::Spanned;

use super::{Material, Quantity, Sourced, edits::Edits, profile::ProfileText, reader::Reader};
use crate::base::toml_text::TextFault;
use crate::base::units::MM3_PER_CM3;

/// Two-sided 95 % quantiles of Student's t for 1, 2, … degrees of freedom (any statistical table;
/// notation of ISO 3534-1).
const STUDENT_T: [f64; 9] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262,
];

/// The least credible relative spread: a balance of 0.01 g on a coupon of 10 g.
///
/// With a smaller one, equal readings of a coarse balance give a window that no sound part passes.
/// With a larger one, careful weighing is wasted.
const LEAST_SPREAD_RATIO: f64 = 1e-3;

/// The measurements of a shop on its coupons.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    /// The day, year-month-day.
    pub day: String,
    /// The lot of the material.
    pub lot: String,
    /// The material, as the profile has it.
    pub material: Option<Material>,
    /// Masses of the density coupons, g.
    pub weighed_g: Vec<f64>,
    /// Drawn volume of one density coupon, mm³.
    pub coupon_mm3: f64,
    /// Clearances, pins, walls and the like, mm.
    pub lengths: Vec<(Quantity, f64)>,
    /// The clearance with which shells of the material slide, mm on each side; `None` if no sleeve
    /// was tried.
    pub slide_mm: Option<f64>,
    /// The infill whose blocks were weighed; `None` if none were.
    pub infill: Option<MeasuredInfill>,
}

/// The infill that a printer lays, as weighed blocks have it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredInfill {
    /// Its pattern, in the words of slicers.
    pub pattern: String,
    /// Pairs of a nominal density and the one laid in the core, both over that of solid print;
    /// ascending.
    pub core_ratio: Vec<[f64; 2]>,
}

/// An error that keeps measured values from being written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrateError {
    /// Nothing was measured.
    #[error(
        "nothing was measured; remedy: give the mass of a coupon, a clearance, a pin or a wall"
    )]
    Nothing,
    /// A mass that is not positive and finite.
    #[error("a coupon of {0} g is not possible; remedy: give its mass in grams")]
    Mass(f64),
    /// Masses that differ too much for equal coupons.
    #[error(
        "the coupons differ by {percent:.0} %; \
         remedy: weigh equal, clean and dry coupons of one lot",
        percent = 100.0 * .0
    )]
    Differ(f64),
    /// The file is not TOML, or has unknown keys.
    #[error(transparent)]
    Text(#[from] TextFault),
}

/// Greatest relative difference between the masses of equal coupons. Beyond it, one of them is of
/// another kind or full of support.
const MAX_DIFFERENCE_RATIO: f64 = 0.2;

impl Measured {
    /// Returns the density, g/cm³: mean mass over drawn volume; `None` if nothing was weighed.
    pub fn density_g_cm3(&self) -> Option<f64> {
        let mean_g = self.weighed_g.iter().sum::<f64>() / self.weighed_g.len() as f64;
        (!self.weighed_g.is_empty()).then(|| mean_g / self.coupon_mm3 * MM3_PER_CM3)
    }

    /// Returns the relative spread that covers the next coupon's mass with 95 % probability; `None`
    /// for fewer than two coupons.
    ///
    /// It is the prediction interval of a normal sample: t·s·√(1 + 1/n) over the mean.
    pub fn spread_ratio(&self) -> Option<f64> {
        let n = self.weighed_g.len();
        let t = STUDENT_T[n.checked_sub(2)?.min(STUDENT_T.len() - 1)];
        let mean = self.weighed_g.iter().sum::<f64>() / n as f64;
        let squares: f64 = self
            .weighed_g
            .iter()
            .map(|mass| (mass - mean).powi(2))
            .sum();
        let deviation = (squares / (n as f64 - 1.0)).sqrt();
        Some((t * deviation * (1.0 + 1.0 / n as f64).sqrt() / mean).max(LEAST_SPREAD_RATIO))
    }

    fn check(&self) -> Result<(), CalibrateError> {
        let is_empty = self.weighed_g.is_empty() && self.lengths.is_empty();
        if is_empty && self.infill.is_none() && self.slide_mm.is_none() {
            return Err(CalibrateError::Nothing);
        }
        if let Some(&bad) = self
            .weighed_g
            .iter()
            .find(|mass| !(mass.is_finite() && **mass > 0.0))
        {
            return Err(CalibrateError::Mass(bad));
        }
        let (least, most) = self
            .weighed_g
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(l, m), &g| (l.min(g), m.max(g)));
        let difference = if most > 0.0 { 1.0 - least / most } else { 0.0 };
        if difference > MAX_DIFFERENCE_RATIO {
            Err(CalibrateError::Differ(difference))
        } else {
            Ok(())
        }
    }

    fn source(&self, what: &str) -> String {
        format!("{what}, lot {}, {}", self.lot, self.day)
    }
}

/// Returns the text of a profile with the measured values: old values are replaced, new ones added.
/// Error messages call the profile `file`.
pub fn calibrate(file: &str, text: &str, measured: &Measured) -> Result<String, CalibrateError> {
    measured.check()?;
    let reader = Reader::new(file, text);
    let profile: ProfileText = reader.parse()?;
    let own: OwnMaterials = reader.parse()?;
    let mut edits = Edits::new(text);
    let mut added = String::new();
    for &(quantity, value) in &measured.lengths {
        let entry = inline_table(value, &measured.source("read off a coupon"));
        match profile.numbers.get(&quantity) {
            Some(old) => edits.replace(old.span(), entry),
            None => added += &format!("{quantity} = {entry}\n"),
        }
    }
    if !added.is_empty() {
        edits.add_numbers(&added);
    }
    if let Some(infill) = &measured.infill {
        let entry = ratio_table(&infill.core_ratio, &measured.source("blocks weighed"));
        match &profile.infill_core_ratio {
            Some(old) => edits.replace(old.span(), entry),
            None => {
                let pattern = string(&infill.pattern);
                let lines = format!("infill_pattern = {pattern}\ninfill_core_ratio = {entry}\n");
                edits.add_after_line(profile.name.span().end, &lines);
            }
        }
    }
    let is_of_material = !measured.weighed_g.is_empty() || measured.slide_mm.is_some();
    if let Some(kept) = measured.material.as_ref().filter(|_| is_of_material) {
        let entries = MaterialEntries::new(measured);
        let mut materials = own.material.iter();
        match materials.find(|material| *material.id.get_ref() == kept.id) {
            Some(material) => edits.update_material(material, entries),
            None => edits.add_material(kept, entries.or_kept(kept)),
        }
    }
    Ok(edits.apply())
}

/// Formats a measured number with its source as an inline table.
fn inline_table(value: f64, source: &str) -> String {
    // Seven digits: more than any balance or calliper has.
    const DIGITS: f64 = 1e7;
    let value = (value * DIGITS).round() / DIGITS;
    format!(
        "{{ value = {value}, source = {}, sure = \"measured\" }}",
        string(source)
    )
}

/// Formats measured pairs of densities with their source as an inline table.
fn ratio_table(rows: &[[f64; 2]], source: &str) -> String {
    // A balance of 0.01 g says no more.
    let rows = rows
        .iter()
        .map(|[nominal, laid]| format!("[{nominal}, {laid:.4}]"));
    let rows = rows.collect::<Vec<String>>().join(", ");
    let source = string(source);
    format!("{{ value = [{rows}], source = {source}, sure = \"measured\" }}")
}

/// Formats a text as a TOML string.
fn string(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// A profile's own materials, for their places in the text.
#[derive(Deserialize)]
struct OwnMaterials {
    #[serde(default)]
    material: Vec<OwnMaterial>,
}

#[derive(Deserialize)]
struct OwnMaterial {
    id: Spanned<String>,
    density_g_cm3: Spanned<toml::Value>,
    density_spread_ratio: Option<Spanned<toml::Value>>,
    clearance_slide_per_side_mm: Option<Spanned<toml::Value>>,
    lot: Option<Spanned<toml::Value>>,
    measured_on: Option<Spanned<toml::Value>>,
}

/// The entries of a material, as they stand in a profile; `None` for those that stay.
#[derive(Default)]
struct MaterialEntries {
    density: Option<String>,
    /// `None` for a single coupon.
    spread: Option<String>,
    slide: Option<String>,
    flow: Option<String>,
    lot: Option<String>,
    day: Option<String>,
}

impl MaterialEntries {
    /// Returns what was measured.
    fn new(measured: &Measured) -> Self {
        let slide = measured.slide_mm;
        let slide = slide.map(|mm| inline_table(mm, &measured.source("sleeves tried")));
        let Some(density_g_cm3) = measured.density_g_cm3() else {
            return Self {
                slide,
                ..Self::default()
            };
        };
        let count = measured.weighed_g.len();
        let source = measured.source(&format!(
            "{count} coupons of {:.1} mm³ weighed",
            measured.coupon_mm3
        ));
        let spread = measured
            .spread_ratio()
            .map(|spread| inline_table(spread, &format!("{source}; 95 % of the next")));
        Self {
            density: Some(inline_table(density_g_cm3, &source)),
            spread,
            slide,
            flow: None,
            lot: Some(string(&measured.lot)),
            day: Some(measured.day.clone()),
        }
    }

    /// Returns these entries, and those of a material that are not among them. Its spread, lot and
    /// day are those of its density.
    fn or_kept(self, kept: &Material) -> Self {
        let weighed = self.density.is_some();
        let of_density = |own: Option<String>| own.filter(|_| !weighed);
        let number = |own: &Option<Sourced<f64>>| own.as_ref().map(sourced_table);
        Self {
            density: self
                .density
                .or_else(|| Some(sourced_table(&kept.density_g_cm3))),
            spread: self
                .spread
                .or(of_density(number(&kept.density_spread_ratio))),
            slide: self
                .slide
                .or_else(|| number(&kept.clearance_slide_per_side_mm)),
            flow: self.flow.or_else(|| number(&kept.flow_ratio)),
            lot: self.lot.or(of_density(kept.lot.as_deref().map(string))),
            day: self.day.or(of_density(kept.measured_on.clone())),
        }
    }

    /// Returns the entries with their keys, the density first.
    fn lines(self) -> [(&'static str, Option<String>); 6] {
        [
            ("density_g_cm3", self.density),
            ("density_spread_ratio", self.spread),
            (Quantity::ClearanceSlidePerSideMm.key(), self.slide),
            ("flow_ratio", self.flow),
            ("lot", self.lot),
            ("measured_on", self.day),
        ]
    }
}

/// Formats a number with the source that it has as an inline table.
fn sourced_table(number: &Sourced<f64>) -> String {
    let sure = toml::Value::try_from(number.sure);
    let sure = sure.map_or_else(|_| string("own-choice"), |sure| sure.to_string());
    let (value, source) = (number.value, string(&number.source));
    format!("{{ value = {value}, source = {source}, sure = {sure} }}")
}

impl Edits<'_> {
    /// Adds a material at the end.
    fn add_material(&mut self, material: &Material, entries: MaterialEntries) {
        let (id, name) = (&material.id, string(&material.name));
        let mut lines = format!("\n[[material]]\nid = \"{id}\"\nname = {name}\n");
        for (key, value) in entries.lines() {
            if let Some(value) = value {
                lines += &format!("{key} = {value}\n");
            }
        }
        self.add_at_end(&lines);
    }

    /// Replaces the entries of a material; those it lacks follow its density.
    fn update_material(&mut self, material: &OwnMaterial, entries: MaterialEntries) {
        let density = &material.density_g_cm3;
        let after = density.span().end;
        for (key, new) in entries.lines() {
            let old = match key {
                "density_g_cm3" => Some(density),
                "density_spread_ratio" => material.density_spread_ratio.as_ref(),
                "lot" => material.lot.as_ref(),
                "measured_on" => material.measured_on.as_ref(),
                _ => material.clearance_slide_per_side_mm.as_ref(),
            };
            match (old, new) {
                (Some(old), Some(new)) => self.replace(old.span(), new),
                (None, Some(new)) => self.replace(after..after, format!("\n{key} = {new}")),
                (_, None) => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::{Printer, Sure};

    const OWN: &str = "# the one by the window\nid = \"shop\"\nname = \"Shop\"\n\
        inherits = \"prusa-mk4\"\n\n[numbers]  # ours\n\
        min_wall_mm = { value = 1.3, source = \"s\", sure = \"own-choice\" } # thinner broke\n";

    fn measured() -> Measured {
        Measured {
            day: "2026-11-21".into(),
            lot: "A7".into(),
            material: Some(material("pla")),
            weighed_g: vec![9.80, 9.84, 9.88],
            coupon_mm3: 8000.0,
            lengths: vec![
                (Quantity::MinWallMm, 1.2),
                (Quantity::ClearancePerSideMm, 0.15),
            ],
            ..Measured::default()
        }
    }

    /// Returns a material as a shipped printer has it.
    fn material(id: &str) -> Material {
        let printer = Printer::find("prusa-mk4").unwrap();
        printer.material(Some(id)).unwrap().clone()
    }

    fn read(text: &str) -> Printer {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("shop.toml");
        std::fs::write(&path, text).unwrap();
        Printer::read(&path).unwrap()
    }

    #[test]
    fn measured_values_are_read_back_and_remarks_stay() {
        let text = calibrate("shop.toml", OWN, &measured()).unwrap();
        assert!(
            text.starts_with("# the one by the window\n") && text.contains(" # thinner broke"),
            "{text}"
        );
        let printer = read(&text);
        assert_eq!(
            (
                printer.min_wall_mm.value,
                printer.clearance_per_side_mm.value
            ),
            (1.2, 0.15)
        );
        assert_eq!(printer.min_wall_mm.sure, Sure::Measured);
        assert!(printer.min_wall_mm.source.contains("lot A7, 2026-11-21"));
        let pla = printer.material(Some("pla")).unwrap();
        assert!((pla.density_g_cm3.value - 1.23).abs() < 1e-12);
        assert_eq!(
            (pla.lot.as_deref(), pla.measured_on.as_deref()),
            (Some("A7"), Some("2026-11-21"))
        );
        let [least, most] = pla.weighing_window_g(100.0).unwrap();
        // s = 0.04 g, t(2) = 4.303: 4.303 · 0.04 · √(4/3) / 9.84 = 2.02 %.
        assert!(
            (most - 100.0 - 2.0198).abs() < 1e-3 && (100.0 - least - 2.0198).abs() < 1e-3,
            "{most}"
        );
    }

    #[test]
    fn measuring_again_replaces_the_earlier_values() {
        let once = calibrate("shop.toml", OWN, &measured()).unwrap();
        let later = Measured {
            day: "2026-12-24".into(),
            lot: "B1".into(),
            weighed_g: vec![9.6, 9.6],
            ..measured()
        };
        let twice = calibrate("shop.toml", &once, &later).unwrap();
        let pla = read(&twice).material(None).unwrap().clone();
        assert_eq!(
            (pla.density_g_cm3.value, pla.lot.as_deref()),
            (1.2, Some("B1"))
        );
        assert_eq!(
            pla.measured_spread_ratio(),
            Some(LEAST_SPREAD_RATIO),
            "no balance is more certain than that"
        );
        assert!(
            !twice.contains("A7") && twice.lines().count() == once.lines().count(),
            "{twice}"
        );
    }

    #[test]
    fn a_profile_without_numbers_gets_them_before_its_materials() {
        let plain = "id = \"shop\"\nname = \"Shop\"\ninherits = \"prusa-mk4\"\n\
                     [[material]]\nid = \"pla\"\nname = \"P\"\n\
                     density_g_cm3 = { value = 1.2, source = \"s\", sure = \"read\" } # as bought";
        let one = Measured {
            weighed_g: vec![9.6],
            ..measured()
        };
        let printer = read(&calibrate("shop.toml", plain, &one).unwrap());
        assert_eq!(printer.clearance_per_side_mm.value, 0.15);
        let pla = printer.material(None).unwrap();
        assert!(
            pla.is_measured() && pla.weighing_window_g(1.0).is_none(),
            "one coupon has no spread"
        );
    }

    #[test]
    fn the_table_of_an_infill_is_added_after_the_name_and_then_replaced() {
        let of = |laid: f64| Measured {
            day: "2026-11-21".into(),
            lot: "A7".into(),
            infill: Some(MeasuredInfill {
                pattern: "gyroid".to_owned(),
                core_ratio: vec![[0.15, laid], [0.5, 0.47]],
            }),
            ..Measured::default()
        };
        let once = calibrate("shop.toml", OWN, &of(0.1441)).unwrap();
        let twice = calibrate("shop.toml", &once, &of(0.1438)).unwrap();
        assert_eq!(twice.matches("infill_core_ratio").count(), 1, "{twice}");
        let infill = read(&twice).infill.unwrap();
        assert_eq!(infill.core_ratio.value, [[0.15, 0.1438], [0.5, 0.47]]);
        assert_eq!(infill.core_ratio.sure, Sure::Measured);
        assert_eq!(
            infill.core_ratio.source,
            "blocks weighed, lot A7, 2026-11-21"
        );
        assert!(twice.starts_with("# the one by the window"), "{twice}");
    }

    #[test]
    fn a_sliding_clearance_is_that_of_its_material_and_the_rest_of_it_stays() {
        let slide = |id: &str, mm: f64| Measured {
            day: "2026-11-21".into(),
            lot: "A7".into(),
            material: Some(material(id)),
            slide_mm: Some(mm),
            ..Measured::default()
        };
        let once = calibrate("shop.toml", OWN, &slide("petg", 0.45)).unwrap();
        let twice = calibrate("shop.toml", &once, &slide("petg", 0.5)).unwrap();
        assert_eq!(twice.matches("[[material]]").count(), 1, "{twice}");
        let printer = read(&twice);
        let petg = printer.material(Some("petg")).unwrap();
        let found = printer.slide_clearance(petg).unwrap();
        assert_eq!((found.value, found.sure), (0.5, Sure::Measured));
        assert_eq!(found.source, "sleeves tried, lot A7, 2026-11-21");
        // Its density is the one before, with its source, and counts as no more than that.
        assert_eq!(petg.density_g_cm3, material("petg").density_g_cm3);
        assert_eq!(petg.lot, None);
        // Other materials slide as before.
        let pla = printer.material(Some("pla")).unwrap();
        let others = printer.slide_clearance(pla).unwrap();
        assert_eq!((others.value, others.sure), (0.3, Sure::Recalled));
    }

    #[test]
    fn a_material_that_is_weighed_keeps_its_own_sliding_clearance() {
        let weighed = Measured {
            material: Some(material("petg")),
            lengths: Vec::new(),
            ..measured()
        };
        let text = calibrate("shop.toml", OWN, &weighed).unwrap();
        let printer = read(&text);
        let petg = printer.material(Some("petg")).unwrap();
        assert_eq!(printer.slide_clearance(petg).unwrap().value, 0.4);
        assert_eq!(petg.density_g_cm3.sure, Sure::Measured);
    }

    #[test]
    fn impossible_measurements_are_refused() {
        let with = |weighed_g: Vec<f64>| Measured {
            weighed_g,
            lengths: Vec::new(),
            ..measured()
        };
        for (weighed, words) in [
            (vec![], "nothing was measured"),
            (vec![0.0], "a coupon of 0 g is not possible"),
            (vec![f64::NAN], "a coupon of NaN g"),
            (vec![9.8, 4.9], "differ by 50 %"),
        ] {
            let error = calibrate("shop.toml", OWN, &with(weighed))
                .unwrap_err()
                .to_string();
            assert!(error.contains(words), "{error}");
        }
        assert!(calibrate("shop.toml", "id = ", &measured()).is_err());
    }
}
