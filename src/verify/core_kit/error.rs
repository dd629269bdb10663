//! The reasons why a kit of an object on a base cannot be judged.

use std::path::PathBuf;

use crate::base::watch::Cancelled;
use crate::io::{DrawingError, ReadError};
use crate::mesh::ClipError;
use crate::verify::VerifyError;

/// The schema of the checklist, the panels and the certificate.
pub const SCHEMA: u32 = 1;

/// A kit of an object on a base cannot be judged at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CoreVerifyError {
    /// A file of the kit cannot be read.
    #[error("cannot read {path}; is this the folder of a whole kit?")]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// A file is not one that this program writes.
    #[error("{path} is not a file this program can read; write the kit again")]
    Json {
        /// The file.
        path: PathBuf,
        /// The fault and its line.
        source: serde_json::Error,
    },
    /// A file has another schema.
    #[error(
        "{path} has schema {found}, this program reads schema {SCHEMA}; use the version that wrote it"
    )]
    Schema {
        /// The file.
        path: PathBuf,
        /// Its schema.
        found: u32,
    },
    /// Files do not belong together.
    #[error("{path} does not belong to this kit: {why}; copy the kit again")]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: &'static str,
    },
    /// A drawing cannot be read.
    #[error("{path} is not a drawing this program can read: {fault}; copy the kit again")]
    Drawing {
        /// The file.
        path: PathBuf,
        /// The fault.
        fault: DrawingError,
    },
    /// A mesh of the kit cannot be read.
    #[error(transparent)]
    Mesh(#[from] ReadError),
    /// A part bounds no solid, so that it cannot be put together with others.
    #[error("the parts cannot be put together")]
    Clip(#[from] ClipError),
    /// The checklist names a file outside the kit.
    #[error("the checklist names `{file}`, which lies outside the kit; do not trust this kit")]
    Outside {
        /// The path in the checklist.
        file: String,
    },
    /// The kit's folder cannot be read.
    #[error(transparent)]
    Folder(#[from] VerifyError),
    /// The caller stopped the judge.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
