//! The kit as a folder that is written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

use super::error::{KitError, write_error};
use super::staging::{Staging, folder_of, sweep};
use crate::base::watch::Watch;

/// The files of a kit, in memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Kit {
    files: Vec<(String, Vec<u8>)>,
}

/// The treatment of a target that exists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Leave it and fail.
    Keep,
    /// Replace it, once the new kit is completely written.
    Replace,
}

impl Existing {
    /// Tries, before any work is done, if a kit can be written as `target`; see [`Kit::write`].
    ///
    /// It makes a hidden folder beside the target and removes it again. Folders that killed runs
    /// left beside the target are removed too.
    ///
    /// # Errors
    /// The target is a file, a folder that may not be replaced, or cannot be written.
    pub fn allows(self, target: &Path) -> Result<(), KitError> {
        sweep(folder_of(target));
        check_target(target, self)?;
        Staging::beside(target).map(drop)
    }
}

impl Kit {
    /// Adds a file, by its path relative to the kit with `/` between folders.
    pub fn add(&mut self, file: &str, bytes: Vec<u8>) {
        self.files.push((file.to_owned(), bytes));
    }

    /// Returns the files, in the order they were added.
    pub fn files(&self) -> impl ExactSizeIterator<Item = (&str, &[u8])> {
        self.files
            .iter()
            .map(|(file, bytes)| (file.as_str(), bytes.as_slice()))
    }

    /// Writes the kit as the folder `target`, and makes its parents if they are missing.
    ///
    /// The files are written and synced in a hidden folder beside the target, which is then
    /// renamed. So another program sees the old kit or the new one, never a part of one. The
    /// folder of a run that was killed is removed by the next run.
    ///
    /// # Errors
    /// On any error the old kit is where it was and nothing else is left.
    pub fn write(&self, target: &Path, existing: Existing) -> Result<(), KitError> {
        self.write_watched(target, existing, &Watch::silent())
    }

    /// Writes the kit like [`Kit::write`] until the watch is stopped.
    ///
    /// # Errors
    /// [`KitError::Cancelled`] if the watch was stopped before the kit was whole; then nothing is
    /// written.
    pub fn write_watched(
        &self,
        target: &Path,
        existing: Existing,
        watch: &Watch,
    ) -> Result<(), KitError> {
        let writer = KitWriter::begin(target, existing, watch)?;
        for (file, bytes) in self.files() {
            writer.add(file, bytes)?;
        }
        writer.finish()
    }
}

/// A folder that is written file by file, and takes its place when it is whole. Dropped before, it
/// leaves nothing.
#[derive(Debug)]
pub struct KitWriter<'a> {
    staging: Staging,
    folder: PathBuf,
    watch: &'a Watch,
}

impl<'a> KitWriter<'a> {
    /// Begins a folder beside its place `target`, and makes its parents if they are missing.
    ///
    /// # Errors
    /// The target may not be replaced, or cannot be written.
    pub fn begin(target: &Path, existing: Existing, watch: &'a Watch) -> Result<Self, KitError> {
        sweep(folder_of(target));
        check_target(target, existing)?;
        let staging = Staging::beside(target)?;
        Ok(Self {
            folder: staging.kit(),
            staging,
            watch,
        })
    }

    /// Writes a file, by its path relative to the folder with `/` between folders.
    ///
    /// # Errors
    /// The file cannot be written, or the watch was stopped.
    pub fn add(&self, file: &str, bytes: &[u8]) -> Result<(), KitError> {
        self.watch.check()?;
        write_file(&self.folder, file, bytes)
    }

    /// Puts the folder in its place.
    ///
    /// # Errors
    /// The watch was stopped, or the folder cannot be moved; then the old one stays.
    pub fn finish(self) -> Result<(), KitError> {
        self.watch.check()?;
        self.staging.replace_target()
    }
}

/// The file that marks a folder as a set of coupons.
pub const COUPON_FILE: &str = "coupon.json";

/// The page that marks a folder as plans side by side.
pub const PLANS_FILE: &str = "plans.html";

/// The list that marks a folder as the toolpaths of a kit.
pub const SLICES_FILE: &str = "slices.json";

/// The list that marks a folder as images of layers.
const LAYERS_FILE: &str = "layers.json";

/// The file that marks a folder as the cells of a model.
pub const CELLS_FILE: &str = "cells.vtk";

/// The files that mark a folder as one of ours.
const SIGNS: [&str; 6] = [
    "checklist.json",
    COUPON_FILE,
    PLANS_FILE,
    SLICES_FILE,
    LAYERS_FILE,
    CELLS_FILE,
];

/// Returns an error if the target may not be written.
fn check_target(target: &Path, existing: Existing) -> Result<(), KitError> {
    let is_ours = || SIGNS.iter().any(|sign| target.join(sign).is_file());
    let found = match fs::symlink_metadata(target) {
        Ok(found) => found,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(write_error(target)(error)),
    };
    let target = target.to_owned();
    if !found.is_dir() {
        return Err(KitError::NotAFolder { target });
    }
    if is_empty(&target) {
        return Ok(());
    }
    match existing {
        Existing::Keep => Err(KitError::Exists { target }),
        Existing::Replace if !is_ours() => Err(KitError::NotAKit { target }),
        Existing::Replace => Ok(()),
    }
}

/// Returns true if a folder can be read and holds nothing.
fn is_empty(folder: &Path) -> bool {
    fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none())
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
    fn a_write_that_is_stopped_leaves_nothing_and_the_old_kit_whole() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        kit("one").write(&target, Existing::Keep).unwrap();
        let watch = Watch::silent();
        watch.cancel();
        for target in [&target, &room.path().join("deep/er/kit")] {
            let stopped = kit("two").write_watched(target, Existing::Replace, &watch);
            assert!(matches!(stopped, Err(KitError::Cancelled(_))));
        }
        let read = fs::read_to_string(target.join("checklist.json"));
        assert_eq!(read.unwrap(), "one");
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
}
