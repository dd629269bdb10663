//! The error of a kit that cannot be judged.

use std::path::{Path, PathBuf};

use super::files::{CHECKLIST_FILE, is_checklist_damaged};
use super::{Change, FileChange, SCHEMA};
use crate::base::watch::Cancelled;
use crate::io::ReadError;

/// A kit cannot be judged at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// A file of the kit cannot be read.
    #[error("cannot read {path}; is this the folder of a whole kit?")]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The checklist is not one that this program writes.
    #[error(
        "{path} is not a checklist this program can read; write the kit again with `equipoise prepare`"
    )]
    Checklist {
        /// The file.
        path: PathBuf,
        /// The fault and its line.
        source: serde_json::Error,
    },
    /// The checklist has another schema.
    #[error(
        "{path} has schema {found}, this program reads schema {SCHEMA}; use the version that wrote it"
    )]
    Schema {
        /// The file.
        path: PathBuf,
        /// Its schema.
        found: u64,
    },
    /// The checklist names a file outside the kit.
    #[error("the checklist names `{file}`, which lies outside the kit; do not trust this kit")]
    Outside {
        /// The path in the checklist.
        file: String,
    },
    /// Meshes that the judgement needs are missing.
    #[error(
        "{} missing from {folder}: {}; remedy: copy the kit again, or prepare its {folder}/job.toml again",
        if files.len() == 1 { "a file is" } else { "files are" },
        files.join(", "),
        folder = folder.display()
    )]
    Missing {
        /// The folder of the kit.
        folder: PathBuf,
        /// The files, by their paths in it.
        files: Vec<String>,
    },
    /// A mesh of the kit cannot be read.
    #[error("{path} holds no mesh")]
    Mesh {
        /// The file.
        path: PathBuf,
        /// The fault.
        source: ReadError,
    },
    /// The caller stopped the judge.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl VerifyError {
    /// Returns the changed files without which the kit in `folder` cannot be measured: its promises
    /// are broken as well. Empty if there is no kit to judge.
    pub fn changes(&self, folder: &Path) -> Vec<FileChange> {
        match self {
            Self::Missing { files, .. } => files
                .iter()
                .map(|file| FileChange {
                    file: file.clone(),
                    change: Change::Missing,
                })
                .collect(),
            // A model beside the kit is none of its files.
            Self::Mesh { path, source } if path.starts_with(folder) => {
                let causes =
                    std::iter::successors(Some(source as &dyn std::error::Error), |e| e.source());
                let why = causes.last().map(ToString::to_string).unwrap_or_default();
                let file = path.strip_prefix(folder).unwrap_or(path);
                vec![FileChange {
                    file: file.display().to_string(),
                    change: Change::Unreadable(why),
                }]
            }
            Self::File { path, .. } if *path == folder.join(CHECKLIST_FILE) => {
                let is_damaged = is_checklist_damaged(folder, None);
                let change = FileChange {
                    file: CHECKLIST_FILE.to_owned(),
                    change: Change::Missing,
                };
                is_damaged.then_some(change).into_iter().collect()
            }
            Self::Checklist { path, .. } | Self::Schema { path, .. } => {
                let bytes = std::fs::read(path).unwrap_or_default();
                let change = FileChange {
                    file: CHECKLIST_FILE.to_owned(),
                    change: Change::Altered,
                };
                let is_damaged = is_checklist_damaged(folder, Some(&bytes));
                is_damaged.then_some(change).into_iter().collect()
            }
            _ => Vec::new(),
        }
    }
}
