//! A shop's defaults: `equipoise.toml` in the job's folder or in the user's configuration folder.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;

use super::Rates;
use super::library::{BUILT_IN, PROFILE_ENDING, by_id};
use crate::base::toml_text::{self, TextFault};

/// Name of the file with a shop's defaults.
pub const SHOP_FILE: &str = "equipoise.toml";

/// Name of the program's folder within a user's configuration folder.
pub const CONFIGURATION: &str = "equipoise";

/// A shop's defaults.
#[derive(Debug, Clone, PartialEq)]
pub struct ShopDefaults {
    /// The file that states them.
    pub file: PathBuf,
    /// The id of a built-in printer, or the path of a profile.
    pub printer: String,
    /// The id of the material; `None` for the printer's default.
    pub material: Option<String>,
    /// What the shop charges; `None` if it does not say.
    pub rates: Option<Rates>,
}

/// An error in a shop's defaults.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShopError {
    /// The file exists, but cannot be read.
    #[error("cannot read {}; remedy: check its permissions", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: std::io::Error,
    },
    /// The file is not TOML, or has unknown keys.
    #[error(transparent)]
    Text(#[from] TextFault),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShopText {
    printer: Spanned<String>,
    material: Option<String>,
    rates: Option<Rates>,
}

impl ShopDefaults {
    /// Reads the defaults from the first of these folders that has [`SHOP_FILE`]; `None` if none
    /// has.
    pub fn find_in(folders: &[PathBuf]) -> Result<Option<Self>, ShopError> {
        let files = folders.iter().map(|folder| folder.join(SHOP_FILE));
        let Some(file) = files.into_iter().find(|file| file.is_file()) else {
            return Ok(None);
        };
        let text = std::fs::read_to_string(&file).map_err(|source| ShopError::Unreadable {
            path: file.clone(),
            source,
        })?;
        Ok(Some(Self::parse(&file, &text)?))
    }

    fn parse(file: &Path, text: &str) -> Result<Self, TextFault> {
        let shop: ShopText = toml_text::read(&file.to_string_lossy(), text)?;
        let printer = shop.printer.into_inner();
        let is_path =
            by_id(BUILT_IN.printers, &printer).is_none() && printer.ends_with(PROFILE_ENDING);
        let printer = if is_path {
            file.with_file_name(&printer).to_string_lossy().into_owned()
        } else {
            printer
        };
        Ok(Self {
            file: file.to_owned(),
            printer,
            material: shop.material,
            rates: shop.rates,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_folder_with_the_file_decides_and_paths_start_from_it() {
        let folder = tempfile::tempdir().unwrap();
        let [near, far] = ["near", "far"].map(|name| folder.path().join(name));
        for path in [&near, &far] {
            std::fs::create_dir(path).unwrap();
        }
        assert_eq!(
            ShopDefaults::find_in(&[near.clone(), far.clone()]).unwrap(),
            None
        );
        std::fs::write(
            far.join(SHOP_FILE),
            "printer = \"prusa-mk4\"\nmaterial = \"petg\"\n",
        )
        .unwrap();
        let shop = ShopDefaults::find_in(&[near.clone(), far.clone()])
            .unwrap()
            .unwrap();
        assert_eq!(
            (shop.printer.as_str(), shop.material.as_deref()),
            ("prusa-mk4", Some("petg"))
        );
        std::fs::write(near.join(SHOP_FILE), "printer = \"ours/jet.toml\"\n").unwrap();
        let shop = ShopDefaults::find_in(&[near.clone(), far])
            .unwrap()
            .unwrap();
        assert_eq!(Path::new(&shop.printer), near.join("ours/jet.toml"));
    }

    #[test]
    fn a_misspelt_key_is_reported_with_its_place() {
        let error = ShopDefaults::parse(Path::new("s/equipoise.toml"), "printr = \"x\"\n")
            .unwrap_err()
            .to_string();
        assert!(
            error.starts_with("s/equipoise.toml:1:1: ") && error.contains("did you mean `printer`"),
            "{error}"
        );
        assert!(ShopDefaults::parse(Path::new("e.toml"), "material = \"x\"\n").is_err());
    }
}
