//! The hidden folder in which a kit is written, and the sweep of those that killed runs left.
//!
//! A staging folder lies beside its target as `.NAME.equipoise-STAMP`. It holds a lock file, the
//! new kit, and for a moment the old one. Its writer keeps the file locked as long as it lives. The
//! system frees the lock of a dead writer, so a folder whose lock can be taken is left over.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use super::error::{KitError, write_error};

/// The part of a staging folder's name between the target's name and the stamp.
const MARK: &str = ".equipoise-";
/// The lock file.
const LOCK: &str = "lock";
/// The folder of the new kit.
const NEW: &str = "new";
/// The old kit, while the new one takes its place.
const OLD: &str = "old";

/// A staging folder. Dropping it, on a panic too, removes it and the parents made for it.
#[derive(Debug)]
pub(super) struct Staging {
    path: PathBuf,
    target: PathBuf,
    /// The locked file. A file system without locks is safe too: no sweep can take them.
    _lock: File,
    /// Dropped after the folder in them is removed.
    _parents: MadeParents,
}

impl Drop for Staging {
    fn drop(&mut self) {
        // What cannot be removed now is swept by the next run.
        let _ = clear(&self.path, &self.target);
    }
}

impl Staging {
    /// Makes a staging folder beside the target, and the target's parents if they are missing.
    pub(super) fn beside(target: &Path) -> Result<Self, KitError> {
        let name = target.file_name().ok_or_else(|| KitError::NoName {
            target: target.to_owned(),
        })?;
        let parent = folder_of(target);
        let parents = MadeParents::of(parent)?;
        let path = make_unused(parent, name)?;
        let lock = prepare_inside(&path).map_err(|error| {
            let _ = fs::remove_dir_all(&path);
            write_error(&path)(error)
        })?;
        Ok(Self {
            path,
            target: target.to_owned(),
            _lock: lock,
            _parents: parents,
        })
    }

    /// Returns the folder that takes the place of the target.
    pub(super) fn kit(&self) -> PathBuf {
        self.path.join(NEW)
    }

    /// Puts the new kit in the place of the target. On an error the old kit is back in it.
    pub(super) fn replace_target(self) -> Result<(), KitError> {
        sync_folder(&self.kit())?;
        let target = &self.target;
        if target.exists() {
            fs::rename(target, self.path.join(OLD)).map_err(write_error(target))?;
        }
        // If this fails, dropping the staging folder puts the old kit back.
        fs::rename(self.kit(), target).map_err(write_error(target))?;
        sync_folder(folder_of(target))
    }
}

/// The parents that were made for a target; dropping them removes those that are empty.
#[derive(Debug)]
struct MadeParents(Vec<PathBuf>);

impl MadeParents {
    fn of(parent: &Path) -> Result<Self, KitError> {
        let ancestors = parent.ancestors();
        let missing = ancestors.take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        let made = Self(missing.map(Path::to_owned).collect());
        fs::create_dir_all(parent).map_err(write_error(parent))?;
        Ok(made)
    }
}

impl Drop for MadeParents {
    fn drop(&mut self) {
        for parent in &self.0 {
            // Only an empty folder can be removed so.
            let _ = fs::remove_dir(parent);
        }
    }
}

/// Makes a hidden folder whose name no run used before: a sweep must never mistake a new folder
/// for the one it looked at.
fn make_unused(parent: &Path, name: &OsStr) -> Result<PathBuf, KitError> {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let mut stamp = now.map_or(0, |since| since.as_nanos());
    loop {
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(format!("{MARK}{stamp:x}"));
        let path = parent.join(hidden);
        match fs::create_dir(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => stamp += 1,
            made => return made.map(|()| path.clone()).map_err(write_error(&path)),
        }
    }
}

/// Makes the lock file and the folder of the new kit; returns the locked file.
fn prepare_inside(staging: &Path) -> io::Result<File> {
    // The file gets its name only when it is locked, so that no sweep finds it free.
    let draft = staging.join("lock.new");
    let lock = File::create_new(&draft)?;
    // A file system without locks refuses it to every sweep too.
    let _ = lock.try_lock();
    fs::rename(draft, staging.join(LOCK))?;
    fs::create_dir(staging.join(NEW))?;
    Ok(lock)
}

/// Removes the staging folders in `folder` whose writers are dead, and puts an old kit back whose
/// place is empty. What cannot be removed stays.
pub(super) fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    let folders = entries
        .flatten()
        .filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    for staging in folders.map(|entry| entry.path()) {
        let Some(target) = target_of(&staging) else {
            continue;
        };
        // Some systems lock only a file that is opened for writing.
        let lock = fs::OpenOptions::new()
            .read(true)
            .write(true)
            .open(staging.join(LOCK));
        // The lock is kept until the folder is removed.
        if let Ok(lock) = lock
            && lock.try_lock().is_ok()
        {
            let _ = clear(&staging, &target);
        }
    }
}

/// Returns the target of a staging folder; `None` if its name is not that of one.
fn target_of(staging: &Path) -> Option<PathBuf> {
    let hidden = staging.file_name()?.to_str()?.strip_prefix('.')?;
    let (name, stamp) = hidden.rsplit_once(MARK)?;
    let is_stamp = !stamp.is_empty() && stamp.bytes().all(|byte| byte.is_ascii_hexdigit());
    (is_stamp && !name.is_empty()).then(|| staging.with_file_name(name))
}

/// Removes a staging folder. An old kit in it first goes back, if the new one did not take its
/// place; if it cannot, the folder stays.
fn clear(staging: &Path, target: &Path) -> io::Result<()> {
    let old = staging.join(OLD);
    if old.exists() && staging.join(NEW).exists() && !target.exists() {
        fs::rename(old, target)?;
    }
    fs::remove_dir_all(staging)
}

/// Returns the folder a path lies in.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Asks the system to put a folder's entries on the disk, on systems that can.
fn sync_folder(folder: &Path) -> Result<(), KitError> {
    if cfg!(unix) {
        File::open(folder)
            .and_then(|opened| opened.sync_all())
            .map_err(write_error(folder))
    } else {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::{Existing, Kit};

    fn kit(text: &str) -> Kit {
        let mut kit = Kit::default();
        kit.add("checklist.json", text.into());
        kit
    }

    /// Makes the folder that a killed run leaves: the lock file is there, but nobody holds it.
    fn leave_behind(room: &Path, name: &str) -> PathBuf {
        let staging = room.join(name);
        fs::create_dir_all(staging.join(NEW)).unwrap();
        fs::write(staging.join(LOCK), "").unwrap();
        fs::write(staging.join(NEW).join("half.stl"), "half").unwrap();
        staging
    }

    fn entries(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn the_next_run_sweeps_what_killed_runs_left() {
        let room = tempfile::tempdir().unwrap();
        leave_behind(room.path(), ".kit.equipoise-1a");
        leave_behind(room.path(), ".other.equipoise-2b");
        kit("one")
            .write(&room.path().join("kit"), Existing::Keep)
            .unwrap();
        assert_eq!(entries(room.path()), ["kit"]);
    }

    #[test]
    fn the_folder_of_a_living_run_is_never_swept() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        let living = Staging::beside(&target).unwrap();
        kit("one").write(&target, Existing::Keep).unwrap();
        assert!(living.kit().is_dir());
        drop(living);
        assert_eq!(entries(room.path()), ["kit"]);
    }

    #[test]
    fn folders_that_are_not_ours_are_never_swept() {
        let room = tempfile::tempdir().unwrap();
        let names = [
            ".kit.equipoise-",
            ".kit.equipoise-xyz",
            ".kit.old-1",
            "kit.equipoise-1",
        ];
        for name in names {
            leave_behind(room.path(), name);
        }
        fs::create_dir(room.path().join(".kit.equipoise-1")).unwrap();
        sweep(room.path());
        assert_eq!(entries(room.path()).len(), names.len() + 1);
    }

    #[test]
    fn an_old_kit_goes_back_if_its_run_was_killed_before_the_new_one_took_its_place() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        let staging = leave_behind(room.path(), ".kit.equipoise-1");
        kit("old")
            .write(&staging.join(OLD), Existing::Keep)
            .unwrap();
        let refused = Existing::Keep.allows(&target);
        assert!(matches!(refused, Err(KitError::Exists { .. })));
        let read = fs::read_to_string(target.join("checklist.json"));
        assert_eq!(read.unwrap(), "old");
        assert_eq!(entries(room.path()), ["kit"]);
    }

    #[test]
    fn an_old_kit_that_was_replaced_does_not_come_back() {
        let room = tempfile::tempdir().unwrap();
        let staging = leave_behind(room.path(), ".kit.equipoise-1");
        fs::rename(staging.join(NEW), staging.join(OLD)).unwrap();
        sweep(room.path());
        assert_eq!(entries(room.path()), Vec::<String>::new());
    }

    #[test]
    fn a_replacement_that_fails_puts_the_old_kit_back() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("kit");
        kit("old").write(&target, Existing::Keep).unwrap();
        let staging = Staging::beside(&target).unwrap();
        fs::rename(&target, staging.path.join(OLD)).unwrap();
        drop(staging);
        assert!(target.join("checklist.json").is_file());
        assert_eq!(entries(room.path()), ["kit"]);
    }

    #[test]
    fn a_panic_half_way_leaves_nothing() {
        let room = tempfile::tempdir().unwrap();
        let target = room.path().join("deep/er/kit");
        let panicked = std::panic::catch_unwind(|| {
            let _staging = Staging::beside(&target).unwrap();
            panic!("half way");
        });
        assert!(panicked.is_err());
        assert_eq!(entries(room.path()), Vec::<String>::new());
    }
}
