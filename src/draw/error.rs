//! The reasons why a picture is not drawn.

use crate::base::watch::Cancelled;

/// A reason why a picture was not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The picture cannot be encoded.
    #[error("a picture of {width} × {height} pixels cannot be written as PNG")]
    Png {
        /// Pixels per row.
        width: usize,
        /// Number of rows.
        height: usize,
        /// The fault that the encoder reports.
        source: png::EncodingError,
    },
    /// The view that can be turned cannot be packed.
    #[error("the 3D view cannot be written as JSON")]
    View(#[from] serde_json::Error),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
