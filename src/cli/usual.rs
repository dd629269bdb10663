//! The usual: sizes that are printed, and the material where none is named.

use super::mass_facts::plain;
use crate::base::setting::{Key, Setting};
use crate::printer::{MaterialError, Printer};

/// The least plausible longest side, mm. Half of a smaller model would be wall, so its unit is
/// wrong.
const MIN_SIZE_MM: f64 = 5.0;
/// The greatest plausible longest side, mm. A longer one fits no printer.
const MAX_SIZE_MM: f64 = 2000.0;

/// The density of the print, g/cm³, without a printer: about that of PLA, PA and resins.
const PLAIN_DENSITY_G_CM3: f64 = 1.2;

/// Returns a remedy for a longest side, mm, that nobody prints.
pub(super) fn size_hint(longest_mm: f64) -> Option<String> {
    let is_plausible = (MIN_SIZE_MM..=MAX_SIZE_MM).contains(&longest_mm);
    (!is_plausible).then(|| {
        format!(
            "its longest side would be {}: the file's numbers are hardly mm; give their unit, cm, m \
             or in (`{}`), or the size of the object (`{}`)",
            long_words(longest_mm),
            Setting::open(Key::Unit),
            Setting::new(Key::Size, "100mm")
        )
    })
}

/// Returns a length in words; beyond a kilometre as a power of ten.
fn long_words(mm: f64) -> String {
    if mm < 1e6 {
        plain(mm, "mm")
    } else {
        format!("{mm:.1e} mm")
    }
}

/// Returns the density of the printer's material, g/cm³; a plain one without a printer.
pub(super) fn density_g_cm3(printer: Option<&Printer>) -> Result<f64, MaterialError> {
    let material = printer.map(|printer| printer.material(None)).transpose()?;
    Ok(material.map_or(PLAIN_DENSITY_G_CM3, |material| material.density_g_cm3.value))
}
