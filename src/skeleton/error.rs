//! The reasons that a solid has no skeleton.

use crate::base::watch::Cancelled;

/// The reason that no skeleton was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonError {
    /// The surface has several closed pieces: cavities or separate bodies.
    #[error(
        "the model's surface has {shells} separate closed pieces, and a skeleton is that of one; \
         remedy: fill its hollows, or export one body a file"
    )]
    SeveralShells {
        /// The number of closed pieces.
        shells: usize,
    },
    /// The caller stopped it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
