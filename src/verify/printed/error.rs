//! The reasons why toolpaths cannot be judged.

use std::path::PathBuf;

use crate::base::watch::Cancelled;
use crate::io::gcode::ReadGcodeError;
use crate::io::layers::ReadLayersError;
use crate::verify::VerifyError;

/// Toolpaths cannot be judged at all. A wrong print is no error.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrintedError {
    /// The kit cannot be read.
    #[error(transparent)]
    Kit(#[from] VerifyError),
    /// A file of toolpaths cannot be read.
    #[error(transparent)]
    Gcode(#[from] ReadGcodeError),
    /// A file of layer images cannot be read.
    #[error(transparent)]
    Layers(#[from] ReadLayersError),
    /// Nothing in a file is of this kit.
    #[error(
        "{file} fits no part of this kit: {reason}; remedy: slice {plates} of this kit again{labels}"
    )]
    Foreign {
        /// The file, with the number of its plate.
        file: String,
        /// What was found instead.
        reason: String,
        /// The plates of the kit.
        plates: String,
        /// The words on labels in the remedy.
        labels: &'static str,
    },
    /// An object fits several parts.
    #[error(
        "{object} in {file} fits {}: which is meant is not clear; remedy: slice again{labels}, or slice each part by itself",
        parts.join(" and ")
    )]
    Ambiguous {
        /// The file, with the number of its plate.
        file: String,
        /// The object.
        object: String,
        /// The parts or plates that it fits.
        parts: Vec<String>,
        /// The words on labels in the remedy.
        labels: &'static str,
    },
    /// Two files print the same part.
    #[error("{part} is printed in {first} and in {second}; remedy: give one of them only")]
    Twice {
        /// The part.
        part: String,
        /// The first file.
        first: String,
        /// The second file.
        second: String,
    },
    /// No file is given.
    #[error("no file of toolpaths is given; remedy: give the G-code of every plate")]
    NoFile,
    /// The outside of the kit is no body.
    #[error("{} holds no body; remedy: prepare the kit again", path.display())]
    NoBody {
        /// The file of the uncut result.
        path: PathBuf,
    },
    /// The caller stopped the judge.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
