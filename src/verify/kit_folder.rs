//! The folder of a kit of its own kind, as the judge of that kind reads it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::files::is_inside_kit;
use super::strangers::find_strangers;
use super::{CHECKLIST_FILE, Change, Check, FileChange, SUMS_FILE, VerifyError, files_check};
use crate::base::digest::sha256_hex;
use crate::io::ReadError;

/// The schema of the lists in such kits.
const SCHEMA: u32 = 1;

/// The kinds of kits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KitKind {
    /// A hollowed model.
    Hollowed,
    /// A telescope.
    Telescope,
    /// An object on a laser-cut base.
    Core,
}

impl KitKind {
    /// Returns the kind of the kit in a folder, by the word in its checklist.
    pub fn of(folder: &Path) -> Self {
        let bytes = std::fs::read(folder.join(CHECKLIST_FILE)).unwrap_or_default();
        let sheet: Option<Value> = serde_json::from_slice(&bytes).ok();
        match sheet.as_ref().and_then(|sheet| sheet["kind"].as_str()) {
            Some("telescope" | "network") => Self::Telescope,
            Some("core") => Self::Core,
            _ => Self::Hollowed,
        }
    }
}

/// The judgement of a kit of its own kind.
#[derive(Debug, Clone, PartialEq)]
pub struct KindJudgement {
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// Files that changed since the kit was made.
    pub changes: Vec<FileChange>,
    /// Files in the kit's folder that are not on its list and cannot be printed.
    pub unlisted: Vec<String>,
}

/// A kit cannot be read, so that it cannot be judged at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum KitFolderError {
    /// A file is not one that this program writes.
    #[error("{path} is not a file this program can read; write the kit again")]
    Json {
        /// The file.
        path: PathBuf,
        /// The fault and its line.
        source: serde_json::Error,
    },
    /// A file has the schema of a newer version.
    #[error(
        "{path} has schema {found}, this program reads schema {known}; use the version that wrote it"
    )]
    Schema {
        /// The file.
        path: PathBuf,
        /// Its schema.
        found: u32,
        /// The schema that this version reads.
        known: u32,
    },
    /// A file has the schema of an older version.
    #[error(
        "{path} was made by an older version (schema {found}, this one reads {known}); make it again"
    )]
    Older {
        /// The file.
        path: PathBuf,
        /// Its schema.
        found: u32,
        /// The schema that this version reads.
        known: u32,
    },
    /// Files do not belong together.
    #[error("{path} does not belong to this kit: {why}; copy the kit again")]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: &'static str,
    },
    /// A mesh of the kit cannot be read.
    #[error(transparent)]
    Mesh(#[from] ReadError),
    /// A file of the kit cannot be read, or lies outside of it.
    #[error(transparent)]
    Folder(#[from] VerifyError),
}

/// The key that every list has.
#[derive(Deserialize)]
struct Head {
    schema: u32,
}

/// The folder of a kit.
#[derive(Debug, Clone, Copy)]
pub struct KitFolder<'a> {
    /// Its path.
    pub path: &'a Path,
}

impl KitFolder<'_> {
    /// Returns the bytes of a file.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn bytes(&self, file: &str) -> Result<Vec<u8>, KitFolderError> {
        let path = self.path.join(file);
        Ok(std::fs::read(&path).map_err(|source| VerifyError::File { path, source })?)
    }

    /// Returns a list in the kit, and refuses one of another schema.
    pub fn list<T: DeserializeOwned>(&self, file: &str) -> Result<T, KitFolderError> {
        self.list_of_schema(file, SCHEMA)
    }

    /// Returns a list in the kit, and refuses one of another schema than the one that is `known`.
    pub fn list_of_schema<T: DeserializeOwned>(
        &self,
        file: &str,
        known: u32,
    ) -> Result<T, KitFolderError> {
        // The schema comes first: keys of another version may have another shape.
        let Head { schema: found } = self.parsed(file)?;
        let path = self.path.join(file);
        if found < known {
            return Err(KitFolderError::Older { path, found, known });
        }
        if found > known {
            return Err(KitFolderError::Schema { path, found, known });
        }
        self.parsed(file)
    }

    /// Returns keys of a file, of any schema.
    pub fn parsed<T: DeserializeOwned>(&self, file: &str) -> Result<T, KitFolderError> {
        let path = self.path.join(file);
        let list = serde_json::from_slice(&self.bytes(file)?);
        list.map_err(|source| KitFolderError::Json { path, source })
    }

    /// Returns the error that a file does not belong to the others.
    pub fn mismatch(&self, file: &str, why: &'static str) -> KitFolderError {
        let path = self.path.join(file);
        KitFolderError::Mismatch { path, why }
    }

    /// Judges the files themselves: nothing changed, nothing added. `checks` are those of the
    /// kind; `papers` come after the list, and the hashes name them.
    pub fn judgement(
        &self,
        mut checks: Vec<Check>,
        files: &BTreeMap<String, String>,
        papers: &[&str],
    ) -> Result<KindJudgement, KitFolderError> {
        let mut changes = self.changed_files(files)?;
        changes.extend(self.changed_papers(papers)?);
        let strangers = find_strangers(self.path, files.keys().map(String::as_str))?;
        changes.extend(strangers.changes);
        checks.push(files_check(&changes));
        Ok(KindJudgement {
            checks,
            changes,
            unlisted: strangers.others,
        })
    }

    /// Returns the files whose bytes are not those that the checklist lists.
    fn changed_files(
        &self,
        files: &BTreeMap<String, String>,
    ) -> Result<Vec<FileChange>, KitFolderError> {
        let mut changes = Vec::new();
        for (file, sha256) in files {
            if !self.path.join(file).is_file() {
                changes.push(change(file, Change::Missing));
            } else if sha256_hex(&[&self.bytes(file)?]) != *sha256 {
                changes.push(change(file, Change::Altered));
            }
        }
        Ok(changes)
    }

    /// Returns the papers that do not agree with the list of hashes.
    fn changed_papers(&self, papers: &[&str]) -> Result<Vec<FileChange>, KitFolderError> {
        let list = std::fs::read(self.path.join(SUMS_FILE)).unwrap_or_default();
        let list = String::from_utf8_lossy(&list);
        let mut changes = Vec::new();
        for paper in papers {
            if !self.path.join(paper).is_file() {
                changes.push(change(paper, Change::Missing));
                continue;
            }
            let line = format!("{}  {paper}\n", sha256_hex(&[&self.bytes(paper)?]));
            if !list.contains(&line) {
                changes.push(change(paper, Change::Altered));
            }
        }
        Ok(changes)
    }
}

fn change(file: &str, change: Change) -> FileChange {
    FileChange {
        file: file.to_owned(),
        change,
    }
}

/// Refuses a name of a file that leads out of the kit.
pub fn all_inside_kit<'a>(
    mut files: impl Iterator<Item = &'a String>,
) -> Result<(), KitFolderError> {
    match files.find(|file| !is_inside_kit(file)) {
        Some(file) => Err(VerifyError::Outside { file: file.clone() }.into()),
        None => Ok(()),
    }
}
