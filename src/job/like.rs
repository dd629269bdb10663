//! The body that a match is like: a file and its density.

use std::path::PathBuf;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// A closed surface with a material inside, whose mass, centre and inertia are wanted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Like {
    /// The file, in the numbers and axes of the model's.
    pub path: PathBuf,
    /// The SHA-256 of the file's bytes in lower-case hexadecimal; `None` until they have been read.
    pub sha256: Option<String>,
    /// The density inside, g/cm³; positive.
    pub density_g_cm3: f64,
}

/// The greatest density, g/cm³: above that of any metal. A greater number was meant in kg/m³.
const GREATEST_G_CM3: f64 = 25.0;

/// A text that is not a file with a density.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no body to be like; remedy: give a file and its density in g/cm³, above 0 and at \
     most {GREATEST_G_CM3}, such as original.stl@2.70"
)]
pub struct LikeError(String);

impl Like {
    /// Returns the choice as a kit tells it: the name of the file, without the folder in which it
    /// lay.
    pub fn without_folder(&self) -> Self {
        let name = self.path.file_name().map(PathBuf::from);
        Self {
            path: name.unwrap_or_default(),
            ..self.clone()
        }
    }
}

impl FromStr for Like {
    type Err = LikeError;

    fn from_str(text: &str) -> Result<Self, LikeError> {
        let refused = || LikeError(text.to_owned());
        let (path, density) = text.rsplit_once('@').ok_or_else(refused)?;
        let density = density.trim();
        let density = density.strip_suffix("g/cm³").unwrap_or(density).trim_end();
        let density_g_cm3: f64 = density.parse().map_err(|_| refused())?;
        let is_sound = density_g_cm3 > 0.0 && density_g_cm3 <= GREATEST_G_CM3;
        if path.is_empty() || !is_sound {
            return Err(refused());
        }
        Ok(Self {
            path: path.into(),
            sha256: None,
            density_g_cm3,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_is_a_file_and_a_density_after_the_last_at() {
        let like: Like = "a@b/original.stl@2.70".parse().unwrap();
        assert_eq!(like.path, PathBuf::from("a@b/original.stl"));
        assert_eq!(like.density_g_cm3, 2.7);
        assert_eq!(like.without_folder().path, PathBuf::from("original.stl"));
        for text in [
            "a.stl",
            "a.stl@",
            "a.stl@0",
            "a.stl@-1",
            "@2",
            "a.stl@2700",
            "a.stl@nan",
        ] {
            let said = text.parse::<Like>().unwrap_err().to_string();
            assert!(said.contains("original.stl@2.70"), "{said}");
        }
    }
}
