//! The kit as a folder that is written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

/// The files of a kit, in memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Kit {
    files: Vec<(String, Vec<u8>)>,
}

/// The treatment of an existing target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Leave it and fail.
    Keep,
    /// Replace it, once the new kit is completely written.
    Replace,
}

impl Existing {
    /// Returns an error if a kit cannot be written to `target`. The test makes a hidden folder
    /// beside it and removes it again, so that a run can stop before its work; see [`Kit::write`].
    pub fn allows(self, target: &Path) -> Result<(), KitError> {
        check_target(target, self)?;
        Staging::beside(target).map(drop)
    }
}

/// The reason why a kit was not written; nothing is left behind.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum KitError {
    /// The folder exists already.
    #[error("{target} exists; choose another with --out, or replace it with --force")]
    Exists {
        /// The folder.
        target: PathBuf,
    },
    /// The target exists and is no folder.
    #[error("{target} is a file, not a folder; choose another with --out")]
    NotAFolder {
        /// The file.
        target: PathBuf,
    },
    /// The folder to be replaced does not look like a kit.
    #[error(
        "{target} holds no checklist.json, so it is not a kit and will not be replaced; choose another with --out"
    )]
    NotAKit {
        /// The folder.
        target: PathBuf,
    },
    /// The target has no name, such as `/` or `..`.
    #[error("{target} does not name a folder that can be made; give --out a name")]
    NoName {
        /// The target as given.
        target: PathBuf,
    },
    /// A file of the kit would lie outside it.
    #[error(
        "`{file}` is not a path inside the kit; this is a fault of the program, please report it"
    )]
    Outside {
        /// The path as given.
        file: String,
    },
    /// The system refused.
    #[error("cannot write {path}; is there room, and may you write there?")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

impl Kit {
    /// Adds a file, by its path relative to the kit with `/` between folders.
    pub fn add(&mut self, file: &str, bytes: Vec<u8>) {
        self.files.push((file.to_owned(), bytes));
    }

    /// Returns the files in the order they were added.
    pub fn files(&self) -> impl ExactSizeIterator<Item = (&str, &[u8])> {
        self.files
            .iter()
            .map(|(file, bytes)| (file.as_str(), bytes.as_slice()))
    }

    /// Writes the kit as the folder `target` and makes missing parents.
    ///
    /// The files are written and synced in a hidden folder beside the target, which is then
    /// renamed. Another program sees the old kit or the new one, never a part of one. After an
    /// error the old kit is in its place and nothing else is left.
    pub fn write(&self, target: &Path, existing: Existing) -> Result<(), KitError> {
        check_target(target, existing)?;
        let staging = Staging::beside(target)?;
        for (file, bytes) in self.files() {
            write_file(&staging.path, file, bytes)?;
        }
        staging.sync()?;
        staging.replace(target)
    }
}

/// The file by which a set of coupons is recognised.
pub const COUPON_FILE: &str = "coupon.json";

/// The files by which a folder is recognised as a kit or a set of coupons.
const SIGNS: [&str; 2] = ["checklist.json", COUPON_FILE];

/// Returns an error if the target may not be written.
fn check_target(target: &Path, existing: Existing) -> Result<(), KitError> {
    let target_path = target.to_owned();
    match (fs::symlink_metadata(target), existing) {
        (Err(source), _) if source.kind() == io::ErrorKind::NotFound => Ok(()),
        (Err(source), _) => Err(KitError::Write {
            path: target_path,
            source,
        }),
        (Ok(found), _) if !found.is_dir() => Err(KitError::NotAFolder {
            target: target_path,
        }),
        (Ok(_), Existing::Keep) if !is_empty(target) => Err(KitError::Exists {
            target: target_path,
        }),
        (Ok(_), _)
            if !is_empty(target) && !SIGNS.iter().any(|sign| target.join(sign).is_file()) =>
        {
            Err(KitError::NotAKit {
                target: target_path,
            })
        }
        (Ok(_), _) => Ok(()),
    }
}

/// Returns whether a folder can be read and is empty.
fn is_empty(folder: &Path) -> bool {
    fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none())
}

/// A hidden folder beside the target. Dropping it removes it and the parents made for it, also on a
/// panic.
struct Staging {
    path: PathBuf,
    made_parents: Vec<PathBuf>,
}

impl Drop for Staging {
    fn drop(&mut self) {
        // After the rename the folder is gone and its parents are not empty, so nothing is removed.
        // A failure to remove cannot be reported from here.
        let _ = fs::remove_dir_all(&self.path);
        for parent in &self.made_parents {
            let _ = fs::remove_dir(parent);
        }
    }
}

impl Staging {
    fn beside(target: &Path) -> Result<Self, KitError> {
        let parent = folder_of(target);
        let missing = parent
            .ancestors()
            .take_while(|p| !p.as_os_str().is_empty() && !p.exists());
        let made_parents = missing.map(Path::to_owned).collect();
        let staging = Self {
            path: hidden_sibling(target, "new")?,
            made_parents,
        };
        fs::create_dir_all(parent).map_err(write_error(parent))?;
        fs::create_dir(&staging.path).map_err(write_error(&staging.path))?;
        Ok(staging)
    }

    /// Asks the system to write the folder of the kit to the disk.
    fn sync(&self) -> Result<(), KitError> {
        sync_folder(&self.path)
    }

    /// Renames the hidden folder to the target. An existing target is renamed aside first, and back
    /// if that fails.
    fn replace(self, target: &Path) -> Result<(), KitError> {
        if !target.exists() {
            return self.rename_to(target);
        }
        let aside = hidden_sibling(target, "old")?;
        fs::rename(target, &aside).map_err(write_error(target))?;
        match self.rename_to(target) {
            Ok(()) => fs::remove_dir_all(&aside).map_err(write_error(&aside)),
            Err(error) => {
                fs::rename(&aside, target).map_err(write_error(&aside))?;
                Err(error)
            }
        }
    }

    fn rename_to(&self, target: &Path) -> Result<(), KitError> {
        fs::rename(&self.path, target).map_err(write_error(target))?;
        sync_folder(folder_of(target))
    }
}

/// Returns a hidden path beside the target that no other run uses at the same time.
fn hidden_sibling(target: &Path, purpose: &str) -> Result<PathBuf, KitError> {
    let name = target.file_name().ok_or_else(|| KitError::NoName {
        target: target.to_owned(),
    })?;
    let name = format!(
        ".{}.{purpose}-{}",
        name.to_string_lossy(),
        std::process::id()
    );
    Ok(folder_of(target).join(name))
}

/// Returns the folder that holds a path.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

fn write_file(folder: &Path, file: &str, bytes: &[u8]) -> Result<(), KitError> {
    if file.is_empty()
        || !Path::new(file)
            .components()
            .all(|part| matches!(part, Component::Normal(_)))
    {
        return Err(KitError::Outside {
            file: file.to_owned(),
        });
    }
    let path = folder.join(file);
    fs::create_dir_all(folder_of(&path)).map_err(write_error(&path))?;
    let mut opened = fs::File::create_new(&path).map_err(write_error(&path))?;
    opened
        .write_all(bytes)
        .and_then(|()| opened.sync_all())
        .map_err(write_error(&path))
}

/// Asks the system to write a folder's entries to the disk, if it can do that for folders.
fn sync_folder(folder: &Path) -> Result<(), KitError> {
    if cfg!(unix) {
        fs::File::open(folder)
            .and_then(|opened| opened.sync_all())
            .map_err(write_error(folder))
    } else {
        Ok(())
    }
}

/// Returns a function that adds the path to an error of the system.
fn write_error(path: &Path) -> impl FnOnce(io::Error) -> KitError {
    move |source| KitError::Write {
        path: path.to_owned(),
        source,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kit(text: &str) -> Kit {
        let mut kit = Kit::default();
        kit.add("checklist.json", text.into());
        kit.add("parts/a.stl", vec![1, 2, 3]);
        kit
    }

    fn entries(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_kit_is_written_with_its_folders_and_nothing_beside_it() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("deep/er/kit");
        kit("one").write(&target, Existing::Keep).unwrap();
        assert_eq!(fs::read(target.join("parts/a.stl")).unwrap(), [1, 2, 3]);
        assert_eq!(entries(&room.path().join("deep/er")), ["kit"]);
    }

    #[test]
    fn an_existing_kit_is_kept_unless_it_may_be_replaced() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        kit("one").write(&target, Existing::Keep).unwrap();
        let refused = kit("two").write(&target, Existing::Keep);
        assert!(matches!(refused, Err(KitError::Exists { .. })));
        assert_eq!(
            fs::read_to_string(target.join("checklist.json")).unwrap(),
            "one"
        );
        fs::write(target.join("stale.txt"), "old").unwrap();
        kit("two").write(&target, Existing::Replace).unwrap();
        assert_eq!(
            fs::read_to_string(target.join("checklist.json")).unwrap(),
            "two"
        );
        assert_eq!(entries(&target), ["checklist.json", "parts"]);
        assert_eq!(entries(room.path()), ["kit"]);
    }

    #[test]
    fn a_folder_that_is_no_kit_is_kept_but_an_empty_one_is_filled() {
        let room = tempfile::tempdir().unwrap();
        let home = room.path().join("home");
        fs::create_dir(&home).unwrap();
        kit("one").write(&home, Existing::Keep).unwrap();
        let precious = room.path().join("precious");
        fs::create_dir(&precious).unwrap();
        fs::write(precious.join("thesis.txt"), "years").unwrap();
        let refused = kit("two").write(&precious, Existing::Replace);
        assert!(matches!(refused, Err(KitError::NotAKit { .. })));
        assert_eq!(entries(&precious), ["thesis.txt"]);
    }

    #[test]
    fn a_file_in_the_way_is_kept() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        fs::write(&target, "mine").unwrap();
        let refused = kit("one").write(&target, Existing::Replace);
        assert!(matches!(refused, Err(KitError::NotAFolder { .. })));
        let below = kit("one").write(&target.join("kit"), Existing::Keep);
        assert!(matches!(below, Err(KitError::Write { .. })));
        assert_eq!(fs::read_to_string(&target).unwrap(), "mine");
        assert_eq!(entries(room.path()), ["kit"]);
    }

    #[test]
    fn a_kit_that_fails_leaves_the_old_one_whole() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        kit("one").write(&target, Existing::Keep).unwrap();
        let mut broken = kit("two");
        broken.add("parts", vec![0]);
        assert!(matches!(
            broken.write(&target, Existing::Replace),
            Err(KitError::Write { .. })
        ));
        let mut stray = kit("two");
        stray.add("../stray", vec![0]);
        assert!(matches!(
            stray.write(&target, Existing::Replace),
            Err(KitError::Outside { .. })
        ));
        assert_eq!(
            fs::read_to_string(target.join("checklist.json")).unwrap(),
            "one"
        );
        assert_eq!(entries(room.path()), ["kit"]);
    }

    #[test]
    fn parents_made_for_a_kit_that_fails_are_removed() {
        let room = tempfile::tempdir().unwrap();
        let mut broken = kit("one");
        broken.add("parts", vec![0]);
        assert!(
            broken
                .write(&room.path().join("deep/er/kit"), Existing::Keep)
                .is_err()
        );
        assert_eq!(entries(room.path()), Vec::<String>::new());
    }

    #[test]
    fn a_target_without_a_name_is_refused() {
        let room = tempfile::tempdir().unwrap();
        let refused = kit("one").write(&room.path().join("none/.."), Existing::Keep);
        assert!(refused.is_err());
        assert_eq!(entries(room.path()), Vec::<String>::new());
    }

    #[test]
    fn a_panic_half_way_leaves_nothing() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        let panicked = std::panic::catch_unwind(|| {
            let _staging = Staging::beside(&target).unwrap();
            panic!("half way");
        });
        assert!(panicked.is_err());
        assert_eq!(entries(room.path()), Vec::<String>::new());
    }
}
