//! The search for cutters and sheets by their ids or files.

use std::path::Path;

use super::cutter_layer::complete_cutter;
use super::error::ProfileError;
use super::library::{CUTTERS, Profile, SHEETS, read_text};
use super::machine::Cutter;
use super::stock::StockSheet;
use super::stock_layer::complete_sheet;

impl Cutter {
    /// Finds the built-in cutter of that id, or reads the one that a TOML file describes.
    pub fn find(id_or_path: &str) -> Result<Self, ProfileError> {
        CUTTERS.find(id_or_path, complete_cutter)
    }

    /// Returns every built-in cutter, in the order of their ids.
    pub fn all() -> Result<Vec<Self>, ProfileError> {
        let profiles = CUTTERS.profiles.iter();
        profiles.map(|profile| complete_cutter(*profile)).collect()
    }

    /// Reads the cutter that the TOML file at `path` describes, even if a built-in one has that
    /// name.
    pub fn read(path: &Path) -> Result<Self, ProfileError> {
        read_file(path, complete_cutter)
    }
}

impl StockSheet {
    /// Finds the built-in sheet of that id, or reads the one that a TOML file describes.
    pub fn find(id_or_path: &str) -> Result<Self, ProfileError> {
        SHEETS.find(id_or_path, complete_sheet)
    }

    /// Returns every built-in sheet, in the order of their ids.
    pub fn all() -> Result<Vec<Self>, ProfileError> {
        let profiles = SHEETS.profiles.iter();
        profiles.map(|profile| complete_sheet(*profile)).collect()
    }

    /// Reads the sheet that the TOML file at `path` describes, even if a built-in one has that
    /// name.
    pub fn read(path: &Path) -> Result<Self, ProfileError> {
        read_file(path, complete_sheet)
    }
}

fn read_file<T>(
    path: &Path,
    complete: impl Fn(Profile) -> Result<T, ProfileError>,
) -> Result<T, ProfileError> {
    let (text, file) = (read_text(path)?, path.to_string_lossy());
    complete(Profile {
        id: &file,
        file: &file,
        text: &text,
    })
}
