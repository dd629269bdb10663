//! Cura's list of settings: a file that belongs to Cura, and that its engine needs.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::words::Pair;
use crate::slicer::error::SlicerError;

/// The name by which the engine finds the folders of its definitions.
pub(super) const SEARCH_PATH: &str = "CURA_ENGINE_SEARCH_PATH";
/// The file of the settings of a printer.
const PRINTER: &str = "fdmprinter.def.json";
/// The file of the settings of an extruder, which the engine looks for beside it.
const EXTRUDER: &str = "fdmextruder.def.json";
/// The folders in which Cura is installed, as a rule.
const USUAL: [&str; 2] = ["/usr", "/usr/local"];
/// The folder of the definitions within such a folder.
const WITHIN: &str = "share/cura/resources/definitions";

/// Cura's list of settings.
#[derive(Debug)]
pub(super) struct Definitions {
    /// The folder of its files.
    pub folder: PathBuf,
    /// The file of the settings of a printer.
    pub printer: PathBuf,
}

impl Definitions {
    /// Finds the list: where the environment says, beside the engine, or where Cura is installed.
    ///
    /// # Errors
    /// There is none.
    pub fn find(command: &str) -> Result<Self, SlicerError> {
        let said = std::env::var_os(SEARCH_PATH);
        let said = said.iter().flat_map(std::env::split_paths);
        let beside = Path::new(command).ancestors().skip(1);
        // A bare command has the folder "" above it, which is where the program was called.
        let beside = beside.filter(|folder| !folder.as_os_str().is_empty());
        let usual = USUAL.into_iter().map(Path::new);
        let installed = beside.take(2).chain(usual);
        let folders = said.chain(installed.map(|folder| folder.join(WITHIN)));
        let mut folders = folders.filter(|folder| {
            let has = |file: &str| folder.join(file).is_file();
            has(PRINTER) && has(EXTRUDER)
        });
        // The engine runs in a folder of its own.
        let folder = folders.find_map(|folder| fs::canonicalize(folder).ok());
        let folder = folder.ok_or(SlicerError::NoDefinitions)?;
        Ok(Self {
            printer: folder.join(PRINTER),
            folder,
        })
    }

    /// Returns the settings of a shop's profile: lines of `key = value`.
    ///
    /// # Errors
    /// Cura has no such setting, or its list cannot be read.
    pub fn check(&self, profile: &str) -> Result<Vec<Pair>, SlicerError> {
        let text = fs::read(&self.printer).map_err(SlicerError::Folder)?;
        let list: Value = serde_json::from_slice(&text).map_err(|_| SlicerError::NoDefinitions)?;
        let mut known = BTreeSet::new();
        collect_keys(&list["settings"], &mut known);
        let lines = profile.lines().map(str::trim);
        let lines = lines.filter(|line| !(line.is_empty() || line.starts_with(['#', ';'])));
        let pairs = lines.filter_map(|line| line.split_once('='));
        let pairs = pairs.map(|(key, value)| {
            let key = key.trim();
            if !known.contains(key) {
                let key = key.to_owned();
                return Err(SlicerError::UnknownSetting { key });
            }
            // Programs of several lines, as at the start of a print, are written in one.
            let value = value.trim().replace("\\n", "\n");
            Ok((key.to_owned(), value))
        });
        pairs.collect()
    }
}

/// Collects the names of settings, which lie within one another.
fn collect_keys(settings: &Value, known: &mut BTreeSet<String>) {
    for (key, setting) in settings.as_object().into_iter().flatten() {
        known.insert(key.clone());
        collect_keys(&setting["children"], known);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slicer::Scratch;

    fn list(text: &str) -> (Scratch, Definitions) {
        let folder = Scratch::new().unwrap();
        let printer = folder.path().join(PRINTER);
        fs::write(&printer, text).unwrap();
        let definitions = Definitions {
            folder: folder.path().to_owned(),
            printer,
        };
        (folder, definitions)
    }

    #[test]
    fn a_profile_may_name_only_settings_that_cura_has() {
        let text = r#"{"settings": {"speed": {"children": {"speed_print": {}}}}}"#;
        let (_folder, definitions) = list(text);
        let pairs = definitions.check("# mine\n\nspeed_print = 50\n").unwrap();
        assert_eq!(pairs, [("speed_print".to_owned(), "50".to_owned())]);
        let wrong = definitions.check("perimeter_speed = 50").unwrap_err();
        assert!(wrong.to_string().contains("perimeter_speed"), "{wrong}");
    }

    #[test]
    fn a_list_lies_beside_the_engine_of_an_installed_cura() {
        let folder = Scratch::new().unwrap();
        let place = folder.path().join(WITHIN);
        fs::create_dir_all(&place).unwrap();
        let command = folder.path().join("bin/CuraEngine");
        for file in [PRINTER, EXTRUDER] {
            fs::write(place.join(file), "{}").unwrap();
        }
        let found = Definitions::find(&command.to_string_lossy()).unwrap();
        let is_said = std::env::var_os(SEARCH_PATH).is_some();
        assert!(is_said || found.folder.ends_with(WITHIN), "{found:?}");
    }
}
