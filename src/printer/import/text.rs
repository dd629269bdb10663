//! Slicers' files and the numbers in them.

use std::path::Path;

use super::ImportError;

/// Reads a file as text.
pub(super) fn read(path: &Path) -> Result<String, ImportError> {
    std::fs::read_to_string(path).map_err(|source| ImportError::Unreadable {
        path: path.to_owned(),
        source,
    })
}

/// Parses a slicer's value: the first number if commas or semicolons separate several; `None` for
/// `0`, `nil` and words.
pub(super) fn first_number(value: &str) -> Option<f64> {
    let first = value.split([',', ';']).next()?.trim();
    first
        .parse::<f64>()
        .ok()
        .filter(|number| number.is_finite() && *number > 0.0)
}
