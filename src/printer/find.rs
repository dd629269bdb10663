//! The search for a printer by its id or its file.

use std::path::Path;

use super::{
    Printer, ProfileError,
    library::{BUILT_IN, Library, PROFILE_ENDING, Profile, by_id, ids},
    resolve::resolve,
};
use crate::base::toml_text::{nearest_name, only_name_with};

impl Printer {
    /// Finds the built-in printer of that id, or reads the one that a TOML file describes.
    pub fn find(id_or_path: &str) -> Result<Self, ProfileError> {
        BUILT_IN.find(id_or_path)
    }

    /// Returns every built-in printer, in the order of their ids.
    pub fn all() -> Result<Vec<Self>, ProfileError> {
        BUILT_IN.all()
    }

    /// Reads the printer that the TOML file at `path` describes, even if a built-in one has that
    /// name.
    pub fn read(path: &Path) -> Result<Self, ProfileError> {
        BUILT_IN.read(path)
    }
}

impl Library<'_> {
    /// Finds the printer of that id, or reads the one in that file.
    pub fn find(&self, id_or_path: &str) -> Result<Printer, ProfileError> {
        if let Some(profile) = by_id(self.printers, id_or_path) {
            return resolve(self, *profile);
        }
        let is_path = id_or_path.contains(['/', '\\']) || id_or_path.ends_with(PROFILE_ENDING);
        if is_path || Path::new(id_or_path).is_file() {
            self.read(Path::new(id_or_path))
        } else {
            Err(self.unknown(id_or_path))
        }
    }

    /// Returns every printer.
    pub fn all(&self) -> Result<Vec<Printer>, ProfileError> {
        self.printers
            .iter()
            .map(|profile| resolve(self, *profile))
            .collect()
    }

    /// Reads the printer in that file.
    pub fn read(&self, path: &Path) -> Result<Printer, ProfileError> {
        let text = std::fs::read_to_string(path).map_err(|source| ProfileError::Unreadable {
            path: path.to_owned(),
            source,
        })?;
        let file = path.to_string_lossy();
        resolve(
            self,
            Profile {
                id: &file,
                file: &file,
                text: &text,
            },
        )
    }

    fn unknown(&self, id: &str) -> ProfileError {
        let known = ids(self.printers);
        let named = only_name_with(id, known.iter().copied());
        let remedy = match named.or_else(|| nearest_name(id, known.iter().copied())) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "see `equipoise printers list`, or give the path of a profile".to_owned(),
        };
        ProfileError::Unknown {
            id: id.to_owned(),
            remedy,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_printer_loads_under_the_id_of_its_file() {
        let printers = Printer::all().unwrap();
        assert_eq!(
            printers
                .iter()
                .map(|printer| printer.id.as_str())
                .collect::<Vec<_>>(),
            ids(BUILT_IN.printers)
        );
        for list in [BUILT_IN.printers, BUILT_IN.processes, BUILT_IN.materials] {
            assert!(list.is_sorted_by_key(|profile| profile.id));
        }
    }

    #[test]
    fn every_profile_in_the_folder_is_built_in_under_the_id_of_its_file() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("profiles");
        for (folder, list) in [
            ("printers", BUILT_IN.printers),
            ("processes", BUILT_IN.processes),
            ("materials", BUILT_IN.materials),
        ] {
            let mut files: Vec<String> = std::fs::read_dir(root.join(folder))
                .unwrap()
                .map(|entry| {
                    entry
                        .unwrap()
                        .path()
                        .file_stem()
                        .unwrap()
                        .to_str()
                        .unwrap()
                        .to_owned()
                })
                .collect();
            files.sort();
            assert_eq!(files, ids(list), "{folder}");
            for profile in list {
                assert!(
                    profile.text.contains(&format!("id = \"{}\"\n", profile.id)),
                    "{}",
                    profile.file
                );
            }
        }
    }

    #[test]
    fn the_error_for_an_unknown_printer_names_the_nearest_or_the_list() {
        let error = Printer::find("objet").unwrap_err().to_string();
        let expected = "there is no printer `objet`; remedy: did you mean `objet-connex350`?";
        assert_eq!(error, expected);
        let error = Printer::find("mk4").unwrap_err().to_string();
        assert!(error.ends_with("did you mean `prusa-mk4`?"), "{error}");
        let error = Printer::find("makerbot").unwrap_err().to_string();
        let list = "remedy: see `equipoise printers list`, or give the path of a profile";
        assert!(error.ends_with(list), "{error}");
    }

    #[test]
    fn a_profile_in_a_file_inherits_a_process_and_a_missing_file_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("shop.toml");
        let text = by_id(BUILT_IN.printers, "objet-connex350")
            .unwrap()
            .text
            .replace("objet-connex350", "shop-jet");
        std::fs::write(&path, text).unwrap();
        let printer = Printer::find(path.to_str().unwrap()).unwrap();
        assert_eq!(
            (printer.id.as_str(), printer.process.as_deref()),
            ("shop-jet", Some("polyjet"))
        );
        let error = Printer::find("no/such/shop.toml").unwrap_err();
        assert!(matches!(error, ProfileError::Unreadable { .. }), "{error}");
    }
}
