//! The reasons why hardware cannot be put into a model.

use super::bore::SeatError;
use crate::base::setting::{Key, Setting};
use crate::goal::Rod;
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
    /// The halves hold an axle over less than its diameter.
    #[error(
        "at the spin point the halves have no room for an axle of {} mm that sits at least as \
         deep in each: it would tear out; remedy: {}",
        axle.diameter.mm(),
        remedy_for_grip(thinner.as_ref())
    )]
    Grip {
        /// The axle that was ordered.
        axle: Rod,
        /// The thickest thinner rod that is held there; `None` if none is.
        thinner: Option<Rod>,
    },
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

/// Returns the remedy for an axle that is not held.
fn remedy_for_grip(thinner: Option<&Rod>) -> String {
    let elsewhere = Setting::open(Key::SpinPoint);
    thinner.map_or_else(
        || {
            format!(
                "give another spin point (`{elsewhere}`) or axis (`{}`)",
                Setting::open(Key::Up)
            )
        },
        |rod| {
            format!(
                "`{}`, or another spin point (`{elsewhere}`)",
                Setting::new(Key::Axle, rod)
            )
        },
    )
}
