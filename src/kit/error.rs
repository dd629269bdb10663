//! The reasons why a kit is not written.

use std::io;
use std::path::{Path, PathBuf};

use crate::base::setting::{Key, Setting};
use crate::base::watch::Cancelled;

/// A reason why a kit was not written; nothing is left behind.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum KitError {
    /// The folder exists already.
    #[error(
        "{target} exists; choose another (`{}`), or replace it (`{}`)",
        Setting::open(Key::Out),
        Setting::open(Key::Force)
    )]
    Exists {
        /// The folder.
        target: PathBuf,
    },
    /// The target exists and is not a folder.
    #[error(
        "{target} is a file, not a folder; choose another (`{}`)",
        Setting::open(Key::Out)
    )]
    NotAFolder {
        /// The file.
        target: PathBuf,
    },
    /// The folder to be replaced does not look like a kit.
    #[error(
        "{target} holds no checklist.json, so it is not a kit and will not be replaced; choose \
         another (`{}`)",
        Setting::open(Key::Out)
    )]
    NotAKit {
        /// The folder.
        target: PathBuf,
    },
    /// The target has no name, such as `/` or `..`.
    #[error(
        "{target} does not name a folder that can be made; give it a name (`{}`)",
        Setting::open(Key::Out)
    )]
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
        /// The path that cannot be written.
        path: PathBuf,
        /// The fault that the system reports.
        source: io::Error,
    },
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Returns the conversion of a system's fault at `path`.
pub(super) fn write_error(path: &Path) -> impl FnOnce(io::Error) -> KitError {
    move |source| KitError::Write {
        path: path.to_owned(),
        source,
    }
}
