//! Files of a kit as text, and read back from it: the judge sees what is written.

use std::error::Error;

/// A file that cannot be put into text, or does not read back: a fault of the program.
#[derive(Debug, thiserror::Error)]
#[error("{file} cannot be written: {why}; this is a fault of the program, please report it")]
pub struct Unwritable {
    /// The file.
    pub file: &'static str,
    /// The fault.
    pub why: String,
}

impl Unwritable {
    /// Returns the fault of a file.
    pub fn new(file: &'static str, fault: &dyn Error) -> Self {
        Self {
            file,
            why: fault.to_string(),
        }
    }
}

/// Returns a value as JSON.
///
/// # Errors
/// The value has no JSON, such as a map whose keys are no text.
pub fn json<T: serde::Serialize>(file: &'static str, value: &T) -> Result<String, Unwritable> {
    let text = serde_json::to_string_pretty(value);
    text.map(|text| text + "\n")
        .map_err(|error| Unwritable::new(file, &error))
}

/// Returns a value read from its JSON.
///
/// # Errors
/// The text is not that of such a value.
pub fn read_back<T: serde::de::DeserializeOwned>(
    file: &'static str,
    text: &str,
) -> Result<T, Unwritable> {
    serde_json::from_str(text).map_err(|error| Unwritable::new(file, &error))
}
