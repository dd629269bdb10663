//! Files that a command writes: under other names first, so that nothing half-written is left.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::base::setting::{Key, Setting};

/// A reason why a file was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NewFileError {
    /// A file exists already.
    #[error(
        "{} exists; remedy: choose another (`{}`), or replace it (`{}`)",
        .0.display(),
        Setting::open(Key::Out),
        Setting::open(Key::Force)
    )]
    Exists(PathBuf),
    /// The system refused.
    #[error("cannot write {}; remedy: check the folder and your permissions", path.display())]
    Write {
        /// The path that cannot be written.
        path: PathBuf,
        /// The fault that the system reports.
        source: io::Error,
    },
}

/// Refuses a file that exists, unless it may be replaced.
pub(super) fn check_free(path: &Path, may_replace: bool) -> Result<(), NewFileError> {
    if path.exists() && !may_replace {
        return Err(NewFileError::Exists(path.to_owned()));
    }
    Ok(())
}

/// Writes all files, or none.
pub(super) fn write_all<const N: usize>(files: [(&Path, &str); N]) -> Result<(), NewFileError> {
    write_checked(files, || Ok(()))
}

/// Writes all files, or none. The drafts of them, named by [`draft`], are checked before they take
/// their places.
pub(super) fn write_checked<const N: usize, T, E: From<NewFileError>>(
    files: [(&Path, &str); N],
    check: impl FnOnce() -> Result<T, E>,
) -> Result<T, E> {
    let drafts = files.map(|(path, _)| draft(path));
    let mut pairs = files.iter().zip(&drafts);
    let written = pairs.try_for_each(|((path, text), draft)| {
        fs::write(draft, text).map_err(|source| refused(path, source))
    });
    let checked = written.map_err(E::from).and_then(|()| check());
    let placed = checked.and_then(|value| {
        let mut pairs = files.iter().zip(&drafts);
        let placed = pairs.try_for_each(|((path, _), draft)| {
            fs::rename(draft, path).map_err(|source| refused(path, source))
        });
        placed.map(|()| value).map_err(E::from)
    });
    if placed.is_err() {
        // The fault that matters is reported, not that of removing the drafts.
        drafts.iter().for_each(|draft| _ = fs::remove_file(draft));
    }
    placed
}

/// Returns the name under which a file is written before it takes its place.
pub(super) fn draft(path: &Path) -> PathBuf {
    let mut name: OsString = path.file_name().unwrap_or_default().to_owned();
    name.push(".new");
    path.with_file_name(name)
}

fn refused(path: &Path, source: io::Error) -> NewFileError {
    NewFileError::Write {
        path: path.to_owned(),
        source,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<OsString> {
        let entries = fs::read_dir(folder).unwrap();
        entries.map(|entry| entry.unwrap().file_name()).collect()
    }

    #[test]
    fn all_files_are_written_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let [one, other] = ["one.txt", "other.txt"].map(|name| folder.path().join(name));
        let refuse = || Err(NewFileError::Exists(PathBuf::new()));
        let refused: Result<(), _> = write_checked([(&one, "1"), (&other, "2")], refuse);
        assert!(refused.is_err() && names(folder.path()).is_empty());
        let lost = folder.path().join("no folder/lost.txt");
        assert!(write_all([(&one, "1"), (&lost, "2")]).is_err());
        assert!(names(folder.path()).is_empty());
        write_all([(&one, "1"), (&other, "2")]).unwrap();
        assert_eq!(fs::read_to_string(&other).unwrap(), "2");
        assert_eq!(names(folder.path()).len(), 2);
    }

    #[test]
    fn a_file_that_exists_is_free_only_if_it_may_be_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("kept.txt");
        check_free(&file, false).unwrap();
        fs::write(&file, "1").unwrap();
        let error = check_free(&file, false).unwrap_err().to_string();
        assert!(error.contains("kept.txt exists"), "{error}");
        check_free(&file, true).unwrap();
    }
}
