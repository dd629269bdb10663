//! Errors in the catalogue of stock parts, or in an order from it.

use crate::base::toml_text::TextFault;
use crate::base::watch::Cancelled;
use crate::interior::BuildError;
use crate::shell::ShellError;

/// A reason why a catalogue cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StockFault {
    /// The text is not a catalogue.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// A number has no source.
    #[error(
        "{file}: [{table}] names no source; remedy: say in `source` where the numbers are from"
    )]
    Unsourced {
        /// The catalogue's file.
        file: String,
        /// The table of the numbers: `size` or `mass`.
        table: &'static str,
    },
    /// A size or mass is not positive and finite.
    #[error(
        "{file}: {key} of `{part}` is not positive and finite; remedy: give it in the unit its \
         name ends in"
    )]
    NotPositive {
        /// The catalogue's file.
        file: String,
        /// The part.
        part: String,
        /// The key of the number.
        key: &'static str,
    },
    /// A part is lighter or heavier than anything of its size.
    #[error(
        "{file}: `{part}` would be of {density:.1} g/cm³; remedy: give its mass in g and its \
         sizes in mm"
    )]
    Implausible {
        /// The catalogue's file.
        file: String,
        /// The part.
        part: String,
        /// Mass over volume, g/cm³.
        density: f64,
    },
    /// An id is given twice.
    #[error("{file}: the id `{part}` is given twice; remedy: rename one")]
    Twice {
        /// The catalogue's file.
        file: String,
        /// The id.
        part: String,
    },
}

/// A reason why an order for ballast cannot be processed. An order for which no place or number of
/// parts works is an answer, not an error.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BallastError {
    /// A built-in catalogue is at fault.
    #[error(transparent)]
    Stock(#[from] StockFault),
    /// There is no such part.
    #[error("there is no stock part `{id}`; remedy: {remedy}")]
    Unknown {
        /// The id asked for.
        id: String,
        /// The nearest id, or all of them.
        remedy: String,
    },
    /// The shell cannot be built.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// The columns cannot be built.
    #[error(transparent)]
    Columns(BuildError),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<BuildError> for BallastError {
    fn from(error: BuildError) -> Self {
        match error {
            BuildError::Cancelled(cancelled) => cancelled.into(),
            error => Self::Columns(error),
        }
    }
}
