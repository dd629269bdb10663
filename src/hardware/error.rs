//! The reasons why hardware cannot be put into a model.

use super::bore::SeatError;
use crate::base::setting::{Key, Setting};
use crate::mesh::{ClipError, Defects};

/// A reason why hardware cannot be put in.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The model does not hold a socket.
    #[error(transparent)]
    Seat(#[from] SeatError),
    /// The axis misses the model.
    #[error(
        "the spin axis passes through no part of the model, so that nothing can hold a {0}; give \
         another point"
    )]
    NoAxis(&'static str),
    /// The cut would leave loose pieces besides the two halves.
    #[error(
        "cut across the axis through the spin point, the model falls into {pieces} pieces that \
         cannot stay with either half; \
         remedy: give another point (`{}`) or axis (`{}`)",
        Setting::open(Key::SpinPoint),
        Setting::open(Key::Up)
    )]
    Loose {
        /// The number of pieces, with the two halves.
        pieces: usize,
    },
    /// A boolean failed.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// The result is not a solid.
    #[error("the model with its sockets is not a solid: {0}")]
    NotSolid(#[from] Defects),
}
