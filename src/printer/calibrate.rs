//! Writing of measured values into a shop's own profile, with day and lot. The rest of the file
//! stays as it is.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::{Quantity, profile::ProfileText, reader::Reader};
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
    /// Id and name of the material.
    pub material: Option<(String, String)>,
    /// Masses of the density coupons, g.
    pub weighed_g: Vec<f64>,
    /// Drawn volume of one density coupon, mm³.
    pub coupon_mm3: f64,
    /// Clearances, pins, walls and the like, mm.
    pub lengths: Vec<(Quantity, f64)>,
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
        if self.weighed_g.is_empty() && self.lengths.is_empty() && self.infill.is_none() {
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
    let mut edits = Edits {
        text,
        edits: Vec::new(),
    };
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
    if let (Some((id, name)), Some(density_g_cm3)) = (&measured.material, measured.density_g_cm3())
    {
        let entries = MaterialEntries::new(measured, density_g_cm3);
        let mut materials = own.material.iter();
        match materials.find(|material| material.id.get_ref() == id) {
            Some(material) => edits.update_material(material, entries),
            None => edits.add_material(id, name, &entries),
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
    lot: Option<Spanned<toml::Value>>,
    measured_on: Option<Spanned<toml::Value>>,
}

/// The measured entries of a material, as they stand in a profile.
struct MaterialEntries {
    density: String,
    /// `None` for a single coupon.
    spread: Option<String>,
    lot: String,
    day: String,
}

impl MaterialEntries {
    fn new(measured: &Measured, density_g_cm3: f64) -> Self {
        let count = measured.weighed_g.len();
        let source = measured.source(&format!(
            "{count} coupons of {:.1} mm³ weighed",
            measured.coupon_mm3
        ));
        let spread = measured
            .spread_ratio()
            .map(|spread| inline_table(spread, &format!("{source}; 95 % of the next")));
        Self {
            density: inline_table(density_g_cm3, &source),
            spread,
            lot: string(&measured.lot),
            day: measured.day.clone(),
        }
    }
}

/// Replacements of pieces of a text.
struct Edits<'a> {
    text: &'a str,
    edits: Vec<(Range<usize>, String)>,
}

impl Edits<'_> {
    fn replace(&mut self, range: Range<usize>, new: String) {
        self.edits.push((range, new));
    }

    /// Adds lines after the line in which a place lies.
    fn add_after_line(&mut self, place: usize, lines: &str) {
        match self.text[place..].find('\n') {
            Some(end) => {
                let at = place + end + 1;
                self.replace(at..at, lines.to_owned());
            }
            None => {
                let at = self.text.len();
                self.replace(at..at, format!("\n{lines}"));
            }
        }
    }

    /// Adds lines at the head of `[numbers]`, which is added if missing.
    fn add_numbers(&mut self, lines: &str) {
        const HEADER: &str = "[numbers]";
        let mut start = 0;
        let mut header = None;
        let mut first_material = self.text.len();
        for line in self.text.split_inclusive('\n') {
            if line.trim_end().starts_with(HEADER) {
                header = Some(start + line.len());
            } else if line.starts_with("[[material]]") {
                first_material = first_material.min(start);
            }
            start += line.len();
        }
        match header {
            Some(at) => {
                let newline = if self.text[..at].ends_with('\n') {
                    ""
                } else {
                    "\n"
                };
                self.replace(at..at, format!("{newline}{lines}"));
            }
            None => self.replace(
                first_material..first_material,
                format!("\n{HEADER}\n{lines}\n"),
            ),
        }
    }

    /// Adds a material at the end.
    fn add_material(&mut self, id: &str, name: &str, entries: &MaterialEntries) {
        let MaterialEntries {
            density,
            spread,
            lot,
            day,
        } = entries;
        let spread = spread.as_ref().map_or_else(String::new, |spread| {
            format!("density_spread_ratio = {spread}\n")
        });
        let head = format!("\n[[material]]\nid = \"{id}\"\nname = {}\n", string(name));
        let rest = format!("density_g_cm3 = {density}\n{spread}lot = {lot}\nmeasured_on = {day}\n");
        let end = self.text.len();
        let newline = if self.text.ends_with('\n') { "" } else { "\n" };
        self.replace(end..end, format!("{newline}{head}{rest}"));
    }

    /// Replaces the entries of a material; those it lacks follow its density.
    fn update_material(&mut self, material: &OwnMaterial, entries: MaterialEntries) {
        let MaterialEntries {
            density,
            spread,
            lot,
            day,
        } = entries;
        let after = material.density_g_cm3.span().end;
        self.replace(material.density_g_cm3.span(), density);
        let others = [
            (
                "density_spread_ratio",
                &material.density_spread_ratio,
                spread,
            ),
            ("lot", &material.lot, Some(lot)),
            ("measured_on", &material.measured_on, Some(day)),
        ];
        for (key, old, new) in others {
            match (old, new) {
                (Some(old), Some(new)) => self.replace(old.span(), new),
                (None, Some(new)) => self.replace(after..after, format!("\n{key} = {new}")),
                (_, None) => {}
            }
        }
    }

    /// Returns the text with all pieces replaced.
    fn apply(mut self) -> String {
        // The sort is stable: insertions at one place keep their order.
        self.edits
            .sort_by_key(|(range, _)| (range.start, range.end));
        let mut text = String::new();
        let mut done = 0;
        for (range, new) in &self.edits {
            text += &self.text[done..range.start];
            text += new;
            done = range.end;
        }
        text + &self.text[done..]
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
            material: Some(("pla".into(), "PLA".into())),
            weighed_g: vec![9.80, 9.84, 9.88],
            coupon_mm3: 8000.0,
            lengths: vec![
                (Quantity::MinWallMm, 1.2),
                (Quantity::ClearancePerSideMm, 0.15),
            ],
            infill: None,
        }
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
