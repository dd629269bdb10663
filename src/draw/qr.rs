//! A text as a QR code.

use qrcode::{Color, EcLevel, QrCode};

/// The free rim around a code, modules: ISO/IEC 18004 asks for four; with less, scanners lose the
/// corners.
const QUIET_MODULES: usize = 4;

/// The side of a text's code in modules with its quiet rim, and the dark modules as an SVG path;
/// none where the text is too long for a code (2 kB).
pub fn code_path(text: &str) -> Option<(usize, String)> {
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
        let (side, path) = code_path("EQUIPOISE box SHA256 abcdef").unwrap();
        // Version v has 4v + 17 modules; this text takes the second.
        assert_eq!(side, 25 + 8);
        // The upper left finder: seven dark modules, then a light one.
        for x in 4..11 {
            assert!(path.contains(&format!("M{x} 4h")), "{x}");
        }
        assert!(!path.contains("M11 4h") && !path.contains("M3 "));
    }

    #[test]
    fn a_name_too_long_for_a_code_gets_none() {
        assert!(code_path(&"x".repeat(5000)).is_none());
    }
}
