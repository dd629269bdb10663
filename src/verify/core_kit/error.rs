//! The reasons why a kit of an object on a base cannot be judged.

use std::path::PathBuf;

use crate::base::watch::Cancelled;
use crate::io::DrawingError;
use crate::mesh::ClipError;
use crate::verify::KitFolderError;

/// A kit of an object on a base cannot be judged at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CoreVerifyError {
    /// The kit cannot be read.
    #[error(transparent)]
    Folder(#[from] KitFolderError),
    /// A drawing cannot be read.
    #[error("{path} is not a drawing this program can read: {fault}; copy the kit again")]
    Drawing {
        /// The file.
        path: PathBuf,
        /// The fault.
        fault: DrawingError,
    },
    /// A part bounds no solid, so that it cannot be put together with others.
    #[error("the parts cannot be put together")]
    Clip(#[from] ClipError),
    /// The caller stopped the judge.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
