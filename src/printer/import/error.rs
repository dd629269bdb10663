//! Errors of importing a slicer's files.

use std::path::PathBuf;

use crate::base::setting::{Key, Setting};
use crate::base::toml_text::Place;

/// An error of an import.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// A file cannot be read.
    #[error("cannot read {}; remedy: check the path and its permissions", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: std::io::Error,
    },
    /// A line that such a file cannot have.
    #[error("{place}: {problem}")]
    Line {
        /// Its place in the file.
        place: Place,
        /// The problem.
        problem: &'static str,
    },
    /// A section that is its own ancestor.
    #[error("{place}: the section inherits from itself ({chain})")]
    Cycle {
        /// Its place in the file.
        place: Place,
        /// The chain of parents.
        chain: String,
    },
    /// A missing section.
    #[error("{file} has no [{kind}:{name}]; remedy: {remedy}")]
    NoSection {
        /// The file.
        file: String,
        /// Its kind.
        kind: String,
        /// Its name.
        name: String,
        /// The nearest name, or how to list them.
        remedy: String,
    },
    /// A file that is not JSON, or not a definition.
    #[error("{file}:{line}:{column}: {message}; remedy: give a Cura definition (.def.json)")]
    Json {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The problem.
        message: String,
    },
    /// A file of an unknown kind.
    #[error(
        "{} is none of .ini, .def.json, .inst.cfg and .xml.fdm_material; \
         remedy: give a file written by a slicer",
        path.display()
    )]
    UnknownKind {
        /// The file.
        path: PathBuf,
    },
    /// No printer in the files.
    #[error(
        "there is no printer in {files}; \
         remedy: give a slicer's bundle, an exported configuration or a .def.json"
    )]
    NoPrinter {
        /// The files.
        files: String,
    },
    /// Several printers, of which none is chosen.
    #[error(
        "there are {count} printers in {files}; \
         remedy: choose one (`{}`), or list them (`{}`)",
        Setting::open(Key::Printer),
        Setting::open(Key::List)
    )]
    SeveralPrinters {
        /// Number of printers.
        count: usize,
        /// The files.
        files: String,
    },
}
