//! The QR code of a job: what it is called, and the hash that everything in its kit hangs on.

use qrcode::{Color, EcLevel, QrCode};

/// The free rim around a code, modules: ISO/IEC 18004 asks for four; with less, scanners lose the
/// corners.
const QUIET_MODULES: usize = 4;
/// Digits of the hash in the code of the running header, which must stay readable at 15 mm: 64
/// bits.
const HEADER_DIGITS: usize = 16;
/// Digits of the hash in the id that people read aloud: 32 bits.
const ID_DIGITS: usize = 8;

/// A job by its name and the SHA-256 of its `checklist.json`, which holds the hashes of the other
/// files.
#[derive(Debug, Clone, Copy)]
pub struct JobId<'a> {
    /// The job's name.
    pub name: &'a str,
    /// The SHA-256 of the kit's `checklist.json`, hexadecimal.
    pub sha256: &'a str,
}

impl JobId<'_> {
    /// The name with the first digits of the hash: `elephant-3f2a9c01`.
    pub fn short(&self) -> String {
        format!("{}-{}", self.name, digits(self.sha256, ID_DIGITS))
    }

    /// What the code on the cover says.
    pub fn text(&self) -> String {
        format!("EQUIPOISE {} SHA256 {}", self.name, self.sha256)
    }

    /// What the code on every page says: the same with the first 16 digits of the hash.
    pub fn header_text(&self) -> String {
        format!(
            "EQUIPOISE {} SHA256 {}",
            self.name,
            digits(self.sha256, HEADER_DIGITS)
        )
    }
}

/// The first digits of a hash.
fn digits(sha256: &str, count: usize) -> &str {
    sha256.get(..count).unwrap_or(sha256)
}

/// The side of a text's code in modules with its quiet rim, and the dark modules as an SVG path;
/// none where the text is too long for a code (2 kB).
pub(super) fn path(text: &str) -> Option<(usize, String)> {
    let code = QrCode::with_error_correction_level(text, EcLevel::M).ok()?;
    let width = code.width();
    let dark = code
        .to_colors()
        .into_iter()
        .enumerate()
        .filter(|(_, color)| *color == Color::Dark);
    let module = |(at, _): (usize, Color)| {
        format!(
            "M{} {}h1v1h-1z",
            at % width + QUIET_MODULES,
            at / width + QUIET_MODULES
        )
    };
    Some((width + 2 * QUIET_MODULES, dark.map(module).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_has_the_finder_of_its_corner_and_a_free_rim() {
        let (side, path) = path("EQUIPOISE box SHA256 abcdef").unwrap();
        // Version v has 4v + 17 modules; this text takes the second.
        assert_eq!(side, 25 + 8);
        // The upper left finder: seven dark modules, then a light one.
        for x in 4..11 {
            assert!(path.contains(&format!("M{x} 4h")), "{x}");
        }
        assert!(!path.contains("M11 4h") && !path.contains("M3 "));
    }

    #[test]
    fn the_id_is_the_name_with_the_first_digits_of_the_hash() {
        let hash = "0123456789abcdef".repeat(4);
        let job = JobId {
            name: "box",
            sha256: &hash,
        };
        assert_eq!(job.short(), "box-01234567");
        assert!(job.text().ends_with(&hash) && job.header_text().ends_with(" 0123456789abcdef"));
    }

    #[test]
    fn a_name_too_long_for_a_code_gets_none() {
        assert!(path(&"x".repeat(5000)).is_none());
    }
}
