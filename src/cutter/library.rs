//! The built-in profiles, and the search for one by its id or its file.

use std::path::Path;

use super::error::{ProfileError, suggest};

/// The text of a profile with its id and the name of its file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Profile<'a> {
    pub id: &'a str,
    pub file: &'a str,
    pub text: &'a str,
}

/// Profiles of one kind that may refer to each other by id; both lists in the order of the ids.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shelf<'a> {
    /// The kind of profile, in words.
    pub kind: &'static str,
    /// Profiles that can be chosen.
    pub profiles: &'a [Profile<'a>],
    /// Profiles that only others inherit from; they may lack values.
    pub families: &'a [Profile<'a>],
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

/// The cutters that come with the program.
pub(super) const CUTTERS: Shelf<'static> = Shelf {
    kind: "cutter",
    profiles: built_in!("cutters":
        "any-co2-laser" "epilog-24" "glowforge" "makerspace-900x600" "speedy-400" "thunder-nova-51"),
    families: built_in!("cutters/families": "co2-laser"),
};

/// The sheets that come with the program.
pub(super) const SHEETS: Shelf<'static> = Shelf {
    kind: "sheet",
    profiles: built_in!("sheets":
        "acrylic-3" "acrylic-5" "birch-3" "birch-5" "birch-6" "mdf-3" "mdf-6"),
    families: built_in!("sheets/families": "acrylic" "birch" "mdf"),
};

/// The fasteners that come with the program.
pub(super) const FASTENERS: &[Profile<'static>] =
    built_in!("fasteners": "dowels" "inserts" "nuts" "screws" "washers");

/// Ending of the file name of a profile.
pub(super) const PROFILE_ENDING: &str = ".toml";

/// Finds the profile of an id.
pub(super) fn by_id<'a>(profiles: &'a [Profile<'a>], id: &str) -> Option<&'a Profile<'a>> {
    profiles.iter().find(|profile| profile.id == id)
}

/// Lists the ids of the profiles, in order.
pub(super) fn ids<'a>(profiles: &[Profile<'a>]) -> Vec<&'a str> {
    profiles.iter().map(|profile| profile.id).collect()
}

/// Returns true if a word stands for a file and not for an id.
pub(super) fn is_path(word: &str) -> bool {
    word.contains(['/', '\\']) || word.ends_with(PROFILE_ENDING)
}

/// Reads the text of a profile.
pub(super) fn read_text(path: &Path) -> Result<String, ProfileError> {
    std::fs::read_to_string(path).map_err(|source| ProfileError::Unreadable {
        path: path.to_owned(),
        source,
    })
}

impl Shelf<'_> {
    /// Returns the ids of the profiles that can be chosen.
    pub fn ids(&self) -> Vec<&str> {
        ids(self.profiles)
    }

    /// Returns the ids of everything that a profile can inherit from.
    pub fn parent_ids(&self) -> Vec<&str> {
        let all = self.families.iter().chain(self.profiles);
        all.map(|profile| profile.id).collect()
    }

    /// Finds the family or profile of an id.
    pub fn parent(&self, id: &str) -> Option<&Profile<'_>> {
        by_id(self.families, id).or_else(|| by_id(self.profiles, id))
    }

    /// Passes the profile of an id, or the file of that path, to a function.
    pub fn find<T>(
        &self,
        id_or_path: &str,
        read: impl Fn(Profile) -> Result<T, ProfileError>,
    ) -> Result<T, ProfileError> {
        if let Some(profile) = by_id(self.profiles, id_or_path) {
            return read(*profile);
        }
        let path = Path::new(id_or_path);
        if is_path(id_or_path) || path.is_file() {
            let text = read_text(path)?;
            return read(Profile {
                id: id_or_path,
                file: id_or_path,
                text: &text,
            });
        }
        Err(ProfileError::Unknown {
            kind: self.kind,
            id: id_or_path.to_owned(),
            remedy: suggest(id_or_path, &self.ids()),
        })
    }
}
