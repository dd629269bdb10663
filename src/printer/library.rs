//! The built-in profiles, and the way from an id or a path to a printer.

use std::path::Path;

use super::{Printer, ProfileError, error::suggestion, resolve::resolve};

/// A profile: its id, the name of its file, its text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Profile<'a> {
    pub id: &'a str,
    pub file: &'a str,
    pub text: &'a str,
}

/// A set of profiles that may refer to each other by id; each list is in the order of the ids.
#[derive(Debug, Clone, Copy)]
pub(super) struct Library<'a> {
    pub printers: &'a [Profile<'a>],
    pub processes: &'a [Profile<'a>],
    pub materials: &'a [Profile<'a>],
}

macro_rules! built_in {
    ($folder:literal: $($id:literal)*) => {
        &[$(Profile {
            id: $id,
            file: concat!("profiles/", $folder, "/", $id, ".toml"),
            text: include_str!(concat!("../../profiles/", $folder, "/", $id, ".toml")),
        }),*]
    };
}

/// The profiles that come with the program.
pub(super) const BUILT_IN: Library<'static> = Library {
    printers: built_in!("printers":
        "bambu-x1c" "elegoo-mars-5-ultra" "elegoo-saturn-4-ultra" "eos-p396" "formlabs-form3" "formlabs-form4"
        "formlabs-fuse1" "hp-mjf-5200" "objet-connex350" "projet-mjp-2500" "prusa-mk3s" "prusa-mk4" "prusa-sl1s"
        "ultimaker-s5"),
    processes: built_in!("processes": "fdm" "mjf" "mjp" "polyjet" "sla" "sls"),
    materials: built_in!("materials":
        "abs" "abs-ultimaker" "asa" "formlabs-nylon-12" "formlabs-standard" "hp-pa12" "pa2200" "pc"
        "petg" "pla" "resin" "vero-white" "visijet-m2r"),
};

/// How the name of a profile's file ends.
pub(super) const PROFILE_ENDING: &str = ".toml";

impl Library<'_> {
    /// The printer of that id, or the one in that file.
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

    /// Every printer.
    pub fn all(&self) -> Result<Vec<Printer>, ProfileError> {
        self.printers
            .iter()
            .map(|profile| resolve(self, *profile))
            .collect()
    }

    /// The printer in that file.
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
        let remedy = match suggestion(id, &known) {
            listed if listed.starts_with("use one of") => {
                "use one of these, or the path of a profile".to_owned()
            }
            meant => meant,
        };
        ProfileError::Unknown {
            id: id.to_owned(),
            known: known.join(", "),
            remedy,
        }
    }
}

/// The profile of that id.
pub(super) fn by_id<'a>(profiles: &'a [Profile<'a>], id: &str) -> Option<&'a Profile<'a>> {
    profiles.iter().find(|profile| profile.id == id)
}

/// All ids, in order.
pub(super) fn ids<'a>(profiles: &[Profile<'a>]) -> Vec<&'a str> {
    profiles.iter().map(|profile| profile.id).collect()
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
    fn every_profile_in_the_folder_is_built_in_and_says_the_id_of_its_file() {
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
    fn an_unknown_printer_is_told_with_the_known_ones_and_the_nearest() {
        let error = Printer::find("objet-conex350").unwrap_err().to_string();
        assert!(
            error.contains("hp-mjf-5200, objet-connex350, projet-mjp-2500"),
            "{error}"
        );
        assert!(error.contains("did you mean `objet-connex350`?"), "{error}");
        let error = Printer::find("makerbot").unwrap_err().to_string();
        assert!(error.contains("or the path of a profile"), "{error}");
    }

    #[test]
    fn a_file_of_ones_own_inherits_a_process_and_a_missing_one_is_told() {
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
