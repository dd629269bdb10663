//! A text as a QR code.

use qrcode::{Color, EcLevel, QrCode};

/// The free margin around a code, modules: ISO/IEC 18004 asks for four, because scanners lose the
/// corners otherwise.
const QUIET_MODULES: usize = 4;

/// Returns the side of a text's QR code with its margin, in modules, and its dark modules as an SVG
/// path. `None` if the text is too long for a code (about 2 kB).
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
    fn a_code_has_its_corner_finder_and_a_free_margin() {
        let (side, path) = code_path("EQUIPOISE box SHA256 abcdef").unwrap();
        // Version v has 4v + 17 modules a side; this text takes version 2.
        assert_eq!(side, 25 + 8);
        // The upper left finder: seven dark modules, then a light one.
        for x in 4..11 {
            assert!(path.contains(&format!("M{x} 4h")), "{x}");
        }
        assert!(!path.contains("M11 4h") && !path.contains("M3 "));
    }

    #[test]
    fn a_text_too_long_for_a_code_gets_none() {
        assert!(code_path(&"x".repeat(5000)).is_none());
    }
}
