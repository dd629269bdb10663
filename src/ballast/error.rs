//! What can be wrong with the catalogue of stock parts, or with an order from it.

use crate::base::toml_text::TextFault;
use crate::interior::BuildError;
use crate::shell::ShellError;

/// A part of a catalogue that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StockFault {
    /// The text is no catalogue.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// A number of unknown origin.
    #[error(
        "{file}: [{table}] names no source; remedy: say in `source` where the numbers are from"
    )]
    Unsourced {
        /// The catalogue.
        file: String,
        /// Which numbers: `size` or `mass`.
        table: &'static str,
    },
    /// A size or mass that is none.
    #[error(
        "{file}: {key} of `{part}` is not positive and finite; remedy: give it in the unit its name ends in"
    )]
    NotPositive {
        /// The catalogue.
        file: String,
        /// The part.
        part: String,
        /// Which number.
        key: &'static str,
    },
    /// A part lighter or heavier than anything of its size.
    #[error(
        "{file}: `{part}` would be of {density:.1} g/cm³; remedy: give its mass in g and its sizes in mm"
    )]
    Implausible {
        /// The catalogue.
        file: String,
        /// The part.
        part: String,
        /// Mass over volume, g/cm³.
        density: f64,
    },
    /// An id that is given twice.
    #[error("{file}: the id `{part}` is given twice; remedy: rename one")]
    Twice {
        /// The catalogue.
        file: String,
        /// The id.
        part: String,
    },
}

/// Why an order for ballast cannot be met. That no place or number of parts will do is an answer,
/// not an error.
#[derive(Debug, thiserror::Error)]
pub enum BallastError {
    /// A built-in catalogue is at fault.
    #[error(transparent)]
    Stock(#[from] StockFault),
    /// No such part.
    #[error("there is no stock part `{id}`; remedy: {remedy}")]
    Unknown {
        /// What was asked for.
        id: String,
        /// The nearest id, or all of them.
        remedy: String,
    },
    /// The shell cannot be built.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// The columns cannot be built.
    #[error(transparent)]
    Columns(#[from] BuildError),
}
