//! The faults of a G-code file, each with its line.

use std::path::PathBuf;

use crate::base::watch::Cancelled;

/// The bounds on a file, so that a hostile one cannot take all memory or time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// Bytes of a line that is a command.
    Line,
    /// Named objects.
    Objects,
    /// Tallies: one for each object, feature and tool that meet.
    Tallies,
    /// Unpacked bytes for each packed byte, beyond the first 16 MiB.
    Unpacked,
    /// Plates in a package.
    Plates,
    /// Cubes that hold support.
    Cells,
}

impl Limit {
    /// Returns the largest number allowed.
    ///
    /// * Line: commands of firmware have 96 bytes; an outline of an object may have some thousand.
    /// * Objects and tallies: far more than fit on a plate, yet less than 100 MB.
    /// * Unpacked: G-code compresses to a tenth, blanks to a thousandth.
    pub const fn most(self) -> u64 {
        match self {
            Self::Line => 1 << 16,
            Self::Objects => 10_000,
            Self::Tallies => 100_000,
            Self::Unpacked => 200,
            Self::Plates => 1000,
            Self::Cells => 2_000_000,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Line => "the line is longer than 65536 bytes",
            Self::Objects => "it names more than 10000 objects",
            Self::Tallies => "it mixes too many objects, features and tools",
            Self::Unpacked => "it unpacks to more than 200 times its size",
            Self::Plates => "it holds more than 1000 plates",
            Self::Cells => "its support fills more than 2000000 places",
        }
    }
}

/// The reason that G-code gives no toolpath. Lines are counted from 1; those of a packed file are
/// the lines of its text.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GcodeError {
    /// A command holds bytes that no text has.
    #[error("line {line}: it is no text; remedy: give G-code, or slice the model again")]
    NotText {
        /// The line.
        line: u64,
    },
    /// A word of a command has no number.
    #[error(
        "line {line}: `{letter}` is followed by {found:?}, not by a number; remedy: slice the model again"
    )]
    Number {
        /// The line.
        line: u64,
        /// The letter of the word.
        letter: char,
        /// The text in the place of the number.
        found: String,
    },
    /// A word has a number beyond any machine.
    #[error(
        "line {line}: {letter} of {value:e} is beyond any printer; remedy: slice the model again"
    )]
    TooFar {
        /// The line.
        line: u64,
        /// The letter of the word.
        letter: char,
        /// The number.
        value: f64,
    },
    /// A line holds a second command, which firmware would pass over.
    #[error("line {line}: a second command follows at {found:?}; remedy: write one command a line")]
    TwoCommands {
        /// The line.
        line: u64,
        /// The text of the second command.
        found: String,
    },
    /// An arc that lays material has no centre, or ends off its circle.
    #[error("line {line}: the arc {reason}; remedy: slice the model again, without arc fitting")]
    Arc {
        /// The line.
        line: u64,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// Material is laid by a command that is not understood.
    #[error(
        "line {line}: {command} lays material in a way that is not understood; remedy: slice without it"
    )]
    Unknown {
        /// The line.
        line: u64,
        /// The command.
        command: &'static str,
    },
    /// The file exceeds a bound.
    #[error("line {line}: {}; remedy: do not trust this file, or slice the model again", limit.words())]
    TooMuch {
        /// The line.
        line: u64,
        /// The bound.
        limit: Limit,
    },
    /// No material is laid anywhere.
    #[error("no move in its {lines} lines lays material; remedy: give the G-code of a print")]
    NoBeads {
        /// Number of lines.
        lines: u64,
    },
    /// There are no bytes.
    #[error("it is empty; remedy: export the G-code again")]
    Empty,
    /// The bytes cannot be read to the end.
    #[error("line {line}: it cannot be read further: {source}; remedy: copy or export it again")]
    Unreadable {
        /// The line.
        line: u64,
        /// The error of the system or of the unpacking.
        source: std::io::Error,
    },
    /// The package cannot be unpacked.
    #[error("{part}: {reason}; remedy: copy or export it again")]
    Package {
        /// The file in the package, or the block of a binary file.
        part: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The package holds no sliced plate.
    #[error("no plate in this 3MF is sliced; remedy: export it as a sliced file (.gcode.3mf)")]
    NoPlate,
    /// The caller has stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The reason that a file gives no toolpath. The message names the file, its source the fault.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadGcodeError {
    /// The file cannot be opened.
    #[error("{}: the file cannot be opened; remedy: check the path and its permissions", path.display())]
    Unopened {
        /// The path asked for.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The content is no G-code that can be used.
    #[error("{}: the file holds no usable G-code", path.display())]
    Content {
        /// The path asked for.
        path: PathBuf,
        /// The fault and its place.
        source: GcodeError,
    },
}

/// Makes the fault of a package.
pub(super) fn package_fault(part: &str, reason: impl ToString) -> GcodeError {
    GcodeError::Package {
        part: part.to_owned(),
        reason: reason.to_string(),
    }
}

/// Wraps a fault, so that it passes through a reader of bytes.
pub(super) fn through_io(error: GcodeError) -> std::io::Error {
    std::io::Error::other(error)
}

/// Unwraps a fault that came through a reader of bytes.
pub(super) fn from_io(error: std::io::Error, line: u64) -> GcodeError {
    match error.downcast::<GcodeError>() {
        Ok(GcodeError::TooMuch { limit, .. }) => GcodeError::TooMuch { line, limit },
        Ok(fault) => fault,
        Err(source) => GcodeError::Unreadable { line, source },
    }
}
