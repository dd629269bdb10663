//! The choice of a model file.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::Scaling;

/// The model file and its size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelChoice {
    /// The file.
    pub path: PathBuf,
    /// The SHA-256 of the file's bytes in lower-case hexadecimal; `None` until they have been read.
    pub sha256: Option<String>,
    /// The conversion of the file's numbers to mm.
    pub scaling: Scaling,
}

impl ModelChoice {
    /// Returns the choice as a kit tells it: the name of the file, without the folder in which it
    /// lay.
    pub fn without_folder(&self) -> Self {
        let name = self.path.file_name().map(PathBuf::from);
        Self {
            path: name.unwrap_or_default(),
            ..self.clone()
        }
    }

    /// Returns the name under which a kit holds a copy of the file: `name`, with the ending of the
    /// file.
    pub fn copy_name(path: &Path, name: &str) -> String {
        let ending = path.extension();
        let ending = ending.map(|ending| ending.to_string_lossy().to_lowercase());
        let ending = ending.filter(|ending| ending.chars().all(|c| c.is_ascii_alphanumeric()));
        ending.map_or_else(|| name.to_owned(), |ending| format!("{name}.{ending}"))
    }
}
