//! Writing of measured values into a shop's own profiles of cutters and sheets, with day and lot.
//! The rest of the file stays as it is.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::reader::Reader;
use super::{SheetMaterial, StockSheet};
use crate::base::toml_text::TextFault;
use crate::base::units::MM3_PER_CM3;

/// Kerfs that a row of squares can show, mm.
const KERF_MM: [f64; 2] = [0.0, 2.0];
/// Greatest spread of the thickness of one sheet, as a share of it. Sheets differ by 15 %, and one
/// sheet by less; more is a slip of the pen.
const THICKNESS_SPREAD: f64 = 0.2;
/// Entries for thicknesses this near to each other are one, mm: within it the kerf is the same.
const SAME_THICKNESS_MM: f64 = 0.3;

/// The measurements of a shop on the coupons of a cutter.
#[derive(Debug, Clone, PartialEq)]
pub struct CutMeasured {
    /// The day, year-month-day.
    pub day: String,
    /// The lot of the sheet.
    pub lot: String,
    /// Number of squares in the row.
    pub squares: usize,
    /// Drawn side of a square, mm.
    pub side_mm: f64,
    /// Length of the squares pushed together in a row, mm.
    pub row_mm: f64,
    /// Thicknesses of the sheet, mm.
    pub thickness_mm: Vec<f64>,
    /// Mass of all squares, g; `None` if they were not weighed.
    pub weighed_g: Option<f64>,
}

/// An error that keeps measured values from being written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CutCalibrateError {
    /// A row that is longer than it was drawn, or far shorter.
    #[error(
        "a row of {row_mm} mm means a cut {kerf_mm:.3} mm wide, which is not possible; remedy: \
         push all {squares} squares together and measure the whole row, in mm"
    )]
    Row {
        /// The length of the row, mm.
        row_mm: f64,
        /// The width of the cut that follows, mm.
        kerf_mm: f64,
        /// The number of squares.
        squares: usize,
    },
    /// No thickness, or thicknesses that differ too much.
    #[error(
        "the thicknesses of one sheet must lie within {} % of each other; remedy: measure it at \
         five places, in mm",
        100.0 * THICKNESS_SPREAD
    )]
    Thickness,
    /// A mass that is not positive and finite.
    #[error("squares of {0} g are not possible; remedy: give the mass of all together, in grams")]
    Mass(f64),
    /// The file is not TOML, or not a profile.
    #[error(transparent)]
    Text(#[from] TextFault),
}

impl CutMeasured {
    /// Returns the width of the cut, mm: each square lost half of it on each side.
    ///
    /// # Errors
    /// The row does not give a possible one.
    pub fn kerf_mm(&self) -> Result<f64, CutCalibrateError> {
        let kerf_mm = self.side_mm - self.row_mm / self.squares as f64;
        let [least, most] = KERF_MM;
        if kerf_mm > least && kerf_mm < most.min(0.5 * self.side_mm) {
            return Ok(kerf_mm);
        }
        Err(CutCalibrateError::Row {
            row_mm: self.row_mm,
            kerf_mm,
            squares: self.squares,
        })
    }

    /// Returns the mean thickness, mm.
    ///
    /// # Errors
    /// None was measured, or they differ too much.
    pub fn mean_thickness_mm(&self) -> Result<f64, CutCalibrateError> {
        let all = &self.thickness_mm;
        let [least, most] = [f64::min, f64::max].map(|f| all.iter().copied().reduce(f));
        let (Some(least), Some(most)) = (least, most) else {
            return Err(CutCalibrateError::Thickness);
        };
        if !(least > 0.0 && most.is_finite() && most - least <= THICKNESS_SPREAD * least) {
            return Err(CutCalibrateError::Thickness);
        }
        Ok(all.iter().sum::<f64>() / all.len() as f64)
    }

    /// Returns the density, g/cm³; `None` if nothing was weighed.
    ///
    /// # Errors
    /// As for the thickness and the kerf, or the mass is not possible.
    pub fn density_g_cm3(&self) -> Result<Option<f64>, CutCalibrateError> {
        let Some(mass_g) = self.weighed_g else {
            return Ok(None);
        };
        if !(mass_g > 0.0 && mass_g.is_finite()) {
            return Err(CutCalibrateError::Mass(mass_g));
        }
        let side_mm = self.side_mm - self.kerf_mm()?;
        let volume_mm3 = side_mm * side_mm * self.mean_thickness_mm()? * self.squares as f64;
        Ok(Some(mass_g / volume_mm3 * MM3_PER_CM3))
    }

    fn number(&self, value: f64, what: &str) -> String {
        // A micrometre or a milligram: more than a shop measures.
        const DIGITS: f64 = 1e4;
        let value = (value * DIGITS).round() / DIGITS;
        let source = format!("{what}, lot {}, {}", self.lot, self.day);
        let source = toml::Value::String(source);
        format!("{{ value = {value}, source = {source}, sure = \"measured\" }}")
    }
}

#[derive(Deserialize)]
struct OwnCutter {
    #[serde(default)]
    kerf: Vec<OwnKerf>,
}

#[derive(Deserialize)]
struct OwnKerf {
    material: String,
    thickness_mm: f64,
    kerf_mm: Spanned<toml::Value>,
}

/// Returns the text of a cutter's profile with the measured kerf in a material. An entry of that
/// material and thickness is replaced. Error messages call the profile `file`.
///
/// # Errors
/// The measurements are not possible, or the text is no profile.
pub fn calibrate_cutter(
    file: &str,
    text: &str,
    material: SheetMaterial,
    measured: &CutMeasured,
) -> Result<String, CutCalibrateError> {
    let own: OwnCutter = Reader::new(file, text).parse()?;
    let thickness_mm = measured.mean_thickness_mm()?;
    let what = format!("a row of {} squares", measured.squares);
    let entry = measured.number(measured.kerf_mm()?, &what);
    let is_it = |kerf: &&OwnKerf| {
        kerf.material == material.word()
            && (kerf.thickness_mm - thickness_mm).abs() <= SAME_THICKNESS_MM
    };
    if let Some(old) = own.kerf.iter().find(is_it) {
        return Ok(replaced(text, old.kerf_mm.span(), &entry));
    }
    let gap = if text.ends_with('\n') { "" } else { "\n" };
    let thickness_mm = (thickness_mm * 100.0).round() / 100.0;
    Ok(format!(
        "{text}{gap}\n[[kerf]]\nmaterial = \"{}\"\nthickness_mm = {thickness_mm}\nkerf_mm = \
         {entry}\n",
        material.word()
    ))
}

#[derive(Deserialize)]
struct OwnSheet {
    thickness_mm: Option<Spanned<toml::Value>>,
    density_g_cm3: Option<Spanned<toml::Value>>,
}

/// Returns the text of a sheet's profile with the measured thickness and, if it was weighed, the
/// density. Error messages call the profile `file`.
///
/// # Errors
/// The measurements are not possible, or the text is no profile.
pub fn calibrate_sheet(
    file: &str,
    text: &str,
    measured: &CutMeasured,
) -> Result<String, CutCalibrateError> {
    let own: OwnSheet = Reader::new(file, text).parse()?;
    let places = measured.thickness_mm.len();
    let mut numbers = vec![(
        "thickness_mm",
        own.thickness_mm,
        measured.number(measured.mean_thickness_mm()?, &format!("mean of {places}")),
    )];
    if let Some(density) = measured.density_g_cm3()? {
        let what = format!("{} squares weighed", measured.squares);
        let entry = measured.number(density, &what);
        numbers.push(("density_g_cm3", own.density_g_cm3, entry));
    }
    let mut old: Vec<(Range<usize>, String)> = Vec::new();
    let mut added = String::new();
    for (key, known, entry) in numbers {
        match known {
            Some(known) => old.push((known.span(), entry)),
            None => added += &format!("{key} = {entry}\n"),
        }
    }
    old.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    let text = old
        .into_iter()
        .fold(text.to_owned(), |text, (range, entry)| {
            replaced(&text, range, &entry)
        });
    Ok(before_tables(&text, &added))
}

fn replaced(text: &str, range: Range<usize>, entry: &str) -> String {
    format!("{}{entry}{}", &text[..range.start], &text[range.end..])
}

/// Adds lines before the first table, since keys after it would belong to it.
fn before_tables(text: &str, lines: &str) -> String {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        if line.starts_with('[') {
            break;
        }
        at += line.len();
    }
    let (head, tail) = text.split_at(at);
    let gap = if head.is_empty() || head.ends_with('\n') {
        ""
    } else {
        "\n"
    };
    format!("{head}{gap}{lines}{tail}")
}

/// Returns a measured thickness beside the one for which a coupon was drawn, in words; `None` if
/// they agree.
pub fn thickness_warning(sheet: &StockSheet, measured_mm: f64) -> Option<String> {
    let range = sheet.thickness_range_mm.as_ref()?.value;
    let is_sold = (range[0]..=range[1]).contains(&measured_mm);
    (!is_sold).then(|| {
        format!(
            "{measured_mm:.2} mm is outside of what is sold as {}, {} to {} mm; is it this sheet?",
            sheet.id, range[0], range[1]
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::{AnyProfile, Cutter};

    fn measured() -> CutMeasured {
        CutMeasured {
            day: "2026-11-26".to_owned(),
            lot: "B7".to_owned(),
            squares: 10,
            side_mm: 20.0,
            row_mm: 197.8,
            thickness_mm: vec![5.1, 5.2, 5.15],
            weighed_g: Some(14.0),
        }
    }

    #[test]
    fn a_row_of_squares_gives_the_kerf_and_their_mass_the_density() {
        let measured = measured();
        assert!((measured.kerf_mm().unwrap() - 0.22).abs() < 1e-12);
        assert!((measured.mean_thickness_mm().unwrap() - 5.15).abs() < 1e-12);
        let volume_mm3 = 19.78 * 19.78 * 5.15 * 10.0;
        let density = measured.density_g_cm3().unwrap().unwrap();
        assert!((density - 14_000.0 / volume_mm3).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_is_refused_with_what_to_do() {
        let rows = [200.0, 201.0, 19.78, 0.0, f64::NAN, f64::INFINITY];
        for row_mm in rows {
            let wrong = CutMeasured {
                row_mm,
                ..measured()
            };
            let error = wrong.kerf_mm().unwrap_err().to_string();
            assert!(error.contains("measure the whole row"), "{row_mm}: {error}");
        }
        for thickness_mm in [vec![], vec![5.0, 51.0], vec![-1.0], vec![f64::NAN]] {
            let wrong = CutMeasured {
                thickness_mm,
                ..measured()
            };
            assert!(
                wrong.mean_thickness_mm().is_err(),
                "{:?}",
                wrong.thickness_mm
            );
        }
        let light = CutMeasured {
            weighed_g: Some(0.0),
            ..measured()
        };
        assert_eq!(light.density_g_cm3(), Err(CutCalibrateError::Mass(0.0)));
    }

    #[test]
    fn the_kerf_is_added_once_and_then_replaced() {
        let text = "id = \"own\"\nname = \"Own\"\ninherits = \"glowforge\"\n\n[numbers]\npower_w = { value \
                    = 45, source = \"plate\", sure = \"read\" }";
        let once = calibrate_cutter("own", text, SheetMaterial::Plywood, &measured()).unwrap();
        let again = CutMeasured {
            row_mm: 197.5,
            thickness_mm: vec![5.2],
            ..measured()
        };
        let twice = calibrate_cutter("own", &once, SheetMaterial::Plywood, &again).unwrap();
        assert_eq!(twice.matches("[[kerf]]").count(), 1);
        assert!(twice.contains("value = 0.25,") && twice.contains("lot B7, 2026-11-26"));
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("own.toml");
        std::fs::write(&file, &twice).unwrap();
        let AnyProfile::Cutter(cutter) = AnyProfile::read(&file).unwrap() else {
            panic!("a cutter");
        };
        let kerf = Cutter::kerf(&cutter, SheetMaterial::Plywood, 5.15).unwrap();
        assert!((kerf.kerf_mm - 0.25).abs() < 1e-12);
    }

    #[test]
    fn thickness_and_density_go_before_the_tables_of_a_sheet() {
        let text = "id = \"own\"\nname = \"Own\"\ninherits = \"birch-5\"\nthickness_mm = { value = 5, \
                    source = \"label\", sure = \"read\" }\n[[size]]\nsize_mm = { value = [600, 400], \
                    source = \"tape\", sure = \"measured\" }\n";
        let after = calibrate_sheet("own", text, &measured()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("own.toml");
        std::fs::write(&file, &after).unwrap();
        let AnyProfile::Sheet(sheet) = AnyProfile::read(&file).unwrap() else {
            panic!("a sheet");
        };
        assert!((sheet.thickness_mm.value - 5.15).abs() < 1e-12);
        assert!(
            sheet
                .density_g_cm3
                .source
                .contains("10 squares weighed, lot B7")
        );
        assert_eq!(thickness_warning(&sheet, 5.1), None);
    }
}
