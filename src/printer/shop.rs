//! A shop's defaults: `equipoise.toml` beside the job or in the user's configuration folder.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;

use super::library::{BUILT_IN, PROFILE_ENDING, by_id};
use crate::base::toml_text::{self, TextFault};

/// What the file is called, wherever it stands.
pub const SHOP_FILE: &str = "equipoise.toml";

/// The folder of the program in a user's configuration folder.
pub const CONFIGURATION: &str = "equipoise";

/// A shop's defaults.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shop {
    /// The file they are from.
    pub file: PathBuf,
    /// The id of a built-in printer, or the path of a profile, from the file's own folder.
    pub printer: String,
    /// The material's id; the printer's default where none is given.
    pub material: Option<String>,
}

/// Why a shop's defaults cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ShopError {
    /// The file is there, but cannot be read.
    #[error("cannot read {}; remedy: check its permissions", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Its text is not a shop's.
    #[error(transparent)]
    Text(#[from] TextFault),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShopText {
    printer: Spanned<String>,
    material: Option<String>,
}

impl Shop {
    /// The defaults in the first of these folders that has the file; none where none has.
    pub fn of_folders(folders: &[PathBuf]) -> Result<Option<Self>, ShopError> {
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
        let said = shop.printer.into_inner();
        let is_path = by_id(BUILT_IN.printers, &said).is_none() && said.ends_with(PROFILE_ENDING);
        let beside = || file.with_file_name(&said).to_string_lossy().into_owned();
        let printer = if is_path { beside() } else { said };
        Ok(Self {
            file: file.to_owned(),
            printer,
            material: shop.material,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_folder_with_the_file_decides_and_a_profile_is_taken_from_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let [near, far] = ["near", "far"].map(|name| folder.path().join(name));
        for path in [&near, &far] {
            std::fs::create_dir(path).unwrap();
        }
        assert_eq!(
            Shop::of_folders(&[near.clone(), far.clone()]).unwrap(),
            None
        );
        std::fs::write(
            far.join(SHOP_FILE),
            "printer = \"prusa-mk4\"\nmaterial = \"petg\"\n",
        )
        .unwrap();
        let shop = Shop::of_folders(&[near.clone(), far.clone()])
            .unwrap()
            .unwrap();
        assert_eq!(
            (shop.printer.as_str(), shop.material.as_deref()),
            ("prusa-mk4", Some("petg"))
        );
        std::fs::write(near.join(SHOP_FILE), "printer = \"ours/jet.toml\"\n").unwrap();
        let shop = Shop::of_folders(&[near.clone(), far]).unwrap().unwrap();
        assert_eq!(Path::new(&shop.printer), near.join("ours/jet.toml"));
    }

    #[test]
    fn a_misspelt_key_is_told_with_its_place() {
        let error = Shop::parse(Path::new("s/equipoise.toml"), "printr = \"x\"\n")
            .unwrap_err()
            .to_string();
        assert!(
            error.starts_with("s/equipoise.toml:1:1: ") && error.contains("did you mean `printer`"),
            "{error}"
        );
        assert!(Shop::parse(Path::new("e.toml"), "material = \"x\"\n").is_err());
    }
}
