//! The reasons that bytes are no volume mesh.

use std::fmt;

use crate::base::setting::{Key, Setting};
use crate::tets::TetsError;

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A line of text, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// A reason why the content of a file is no volume mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VolumeError {
    /// The bytes are of no known format.
    #[error(
        "it begins neither as a Gmsh file ($MeshFormat) nor as a VTK file (# vtk DataFile); \
         remedy: export it as .msh, as legacy .vtk, or as .node and .ele"
    )]
    Foreign,
    /// Something else stands where a number or a word is expected.
    #[error("{place}: expected {expected}, found {found:?}; remedy: export it again")]
    Expected {
        /// The place.
        place: Place,
        /// What is expected there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// The file ends too early.
    #[error(
        "{place}: the file ends where it should hold {expected}; it was cut off: copy or export it \
         again"
    )]
    Cut {
        /// The place.
        place: Place,
        /// What is missing.
        expected: &'static str,
    },
    /// The file claims more than its bytes can hold.
    #[error(
        "{place}: {claimed} {what} are claimed, and the file has {bytes} more bytes; it was cut \
         off: copy or export it again"
    )]
    Claims {
        /// The place.
        place: Place,
        /// What is claimed.
        what: &'static str,
        /// The number of them.
        claimed: u64,
        /// The bytes that are left.
        bytes: usize,
    },
    /// The file is of another version or kind.
    #[error("{place}: it is {found}; remedy: {remedy}")]
    Unsupported {
        /// The place.
        place: Place,
        /// What it is.
        found: String,
        /// What to export instead.
        remedy: &'static str,
    },
    /// The file has cells that fill space and are no tetrahedra.
    #[error(
        "{place}: it is one of {count} {kind} in the file; remedy: mesh with straight tetrahedra \
         of 4 corners only"
    )]
    OtherCells {
        /// The place of the first.
        place: Place,
        /// Their kind.
        kind: &'static str,
        /// Number of them.
        count: usize,
    },
    /// The file has no tetrahedra, but others.
    #[error(
        "it has no tetrahedra, only {found}; remedy: mesh the volume too (3D in the mesher), then \
         export again"
    )]
    NoCells {
        /// What it has, in words.
        found: String,
    },
    /// A number names a node or cell that is not there.
    #[error("{place}: there is no {thing} {number}; remedy: export it again")]
    Unknown {
        /// The place.
        place: Place,
        /// The kind of thing.
        thing: &'static str,
        /// Its number.
        number: u64,
    },
    /// Two things have the same number, or two data the same name.
    #[error("{place}: there are two with the name {name}; remedy: leave one of them in the file")]
    Twice {
        /// The place of the second.
        place: Place,
        /// The number or the name.
        name: String,
    },
    /// Several data could be the density.
    #[error(
        "it holds {}, and none is named density; remedy: say which one is, such as `{}`, or \
         `{}` for a solid one",
        names.join(", "), Setting::new(Key::Data, &names[0]), Setting::new(Key::Data, "none")
    )]
    Ambiguous {
        /// The names of the data.
        names: Vec<String>,
    },
    /// Data at corners and data in cells have one name.
    #[error(
        "{name} is there both at the corners and in the cells; remedy: leave one of them in the \
         file"
    )]
    BothKinds {
        /// The name.
        name: String,
    },
    /// The data asked for is not there.
    #[error("it holds no data named {name}; remedy: {}", data_words(names))]
    NoData {
        /// The name asked for.
        name: String,
        /// The names of the data that are there.
        names: Vec<String>,
    },
    /// A value of the density is missing.
    #[error("{place}: {data} has no value for {thing} {number}; remedy: export it again")]
    NoValue {
        /// The place of the data.
        place: Place,
        /// Name of the data.
        data: String,
        /// The kind of thing.
        thing: &'static str,
        /// Its number.
        number: u64,
    },
    /// The tetrahedra do not fill a solid once, or a value is no density.
    #[error("{}{source}", place.map_or(String::new(), |place| format!("{place}: ")))]
    Mesh {
        /// The place; `None` if it is no single one.
        place: Option<Place>,
        /// The fault.
        source: TetsError,
    },
}

/// Returns what to ask for in place of data that is not there.
fn data_words(names: &[String]) -> String {
    match names.first() {
        Some(first) => format!(
            "it has {}; say `{}`",
            names.join(", "),
            Setting::new(Key::Data, first)
        ),
        None => format!(
            "it holds no data at all; say `{}` for a solid one",
            Setting::new(Key::Data, "none")
        ),
    }
}
