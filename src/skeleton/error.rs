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
    /// Lines that are not one tree or net with an end.
    #[error(
        "the lines are {pieces} pieces, or closed without an end; remedy: join them to one piece \
         that branches or ends somewhere"
    )]
    NotOneLine {
        /// The number of pieces.
        pieces: usize,
    },
    /// The root that was ordered does not exist.
    #[error(
        "the skeleton has no node {node}; remedy: give one of 1 to {last}, or a place X,Y,Z in mm"
    )]
    NoNode {
        /// The number that was ordered.
        node: u32,
        /// The last number there is.
        last: u32,
    },
    /// The caller stopped it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
