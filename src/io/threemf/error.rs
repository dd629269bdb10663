//! The faults of a 3MF package, each with its place.

/// The bounds on a package, so that a small file cannot take all memory or time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// Unpacked bytes for each packed byte.
    Unpacked,
    /// Files that hold models.
    Models,
    /// Components within components.
    Depth,
    /// Objects, counted once for each of their places.
    Places,
    /// Triangles, counted once for each of their places.
    Triangles,
}

impl Limit {
    /// Returns the largest number allowed.
    ///
    /// * Unpacked: the most regular meshes compress to a fortieth, while blanks compress to a
    ///   thousandth.
    /// * Depth: drawing programs nest a few assemblies; a thousand would overflow the stack.
    /// * Places and triangles: more than any printer's job, yet all fit in memory (4 GB).
    pub const fn most(self) -> u64 {
        match self {
            Self::Unpacked => 200,
            Self::Models => 10_000,
            Self::Depth => 64,
            Self::Places => 100_000,
            Self::Triangles => 50_000_000,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Unpacked => "its parts unpack to more than 200 times their size",
            Self::Models => "it is spread over more than 10000 models",
            Self::Depth => "its components are nested more than 64 deep",
            Self::Places => "its components put objects in more than 100000 places",
            Self::Triangles => "its components add up to more than 50 million triangles",
        }
    }
}

/// The reason that bytes are not a usable 3MF model, with the place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThreeMfError {
    /// The archive cannot be unpacked.
    #[error("{part}: {reason}; the file was cut off or damaged: copy or export it again")]
    Archive {
        /// The file in the archive.
        part: String,
        /// The message of the archive reader.
        reason: String,
    },
    /// There is no model in the archive.
    #[error(
        "there is no model in it (looked for {part}); is this another kind of ZIP archive? export the model as 3MF"
    )]
    NoModel {
        /// The name of the missing file.
        part: String,
    },
    /// The text is not XML.
    #[error("{part}, line {line}: {reason}; export the model again")]
    Xml {
        /// The file in the archive.
        part: String,
        /// The line, from 1.
        line: usize,
        /// The message of the parser.
        reason: String,
    },
    /// The text declares a document type, which may declare entities.
    #[error(
        "{part}, line {line}: it declares a document type, which 3MF forbids; do not trust this file, or export the model again"
    )]
    DocumentType {
        /// The file in the archive.
        part: String,
        /// The line, from 1.
        line: usize,
    },
    /// An attribute is missing, or is not what it should be.
    #[error(
        "{part}, line {line}: <{element}> needs {attribute} to be {expected}, found {found:?}; export the model again"
    )]
    Attribute {
        /// The file in the archive.
        part: String,
        /// The line, from 1.
        line: usize,
        /// The element.
        element: &'static str,
        /// Its attribute.
        attribute: &'static str,
        /// The value it should have, in words.
        expected: &'static str,
        /// The value it has; empty if it is missing.
        found: String,
    },
    /// A triangle names a vertex that does not exist.
    #[error(
        "object {object}: triangle {triangle} names vertex {vertex}, but there are {vertices} vertices from 0 on; export the model again"
    )]
    IndexOutOfRange {
        /// The object's identifier.
        object: u32,
        /// Index of the triangle, from 0.
        triangle: usize,
        /// The vertex index that it names.
        vertex: u32,
        /// Number of vertices of the object.
        vertices: usize,
    },
    /// Two objects have the same identifier.
    #[error("{part}: there are two objects {object}; export the model again")]
    Twice {
        /// The file in the archive.
        part: String,
        /// The identifier.
        object: u32,
    },
    /// An item or a component names an object that does not exist.
    #[error(
        "{part}: there is no object {object} where one is to be placed; export the model again"
    )]
    NoObject {
        /// The file in the archive that should hold it.
        part: String,
        /// The identifier.
        object: u32,
    },
    /// An object is a component of itself.
    #[error("{part}: object {object} is a component of itself; export the model again")]
    Circle {
        /// The file in the archive.
        part: String,
        /// The identifier.
        object: u32,
    },
    /// The model needs an extension that changes the shape.
    #[error(
        "the model needs the extension {extension}, which is not understood; export it as plain triangles"
    )]
    Extension {
        /// Its namespace or prefix.
        extension: String,
    },
    /// An object is placed so far away that a coordinate overflows.
    #[error(
        "object {object}: a coordinate is not a finite number where it is placed; export the model again"
    )]
    NotFinite {
        /// The identifier.
        object: u32,
    },
    /// The build holds no triangles.
    #[error("its build holds no triangles; put the model on the plate and export it again")]
    NoTriangles,
    /// A plate does not order what a slicer must know of an object.
    #[error("it does not say {key} of {object} as a slicer reads it; prepare the kit again")]
    NoOrder {
        /// The object's name.
        object: String,
        /// The setting.
        key: &'static str,
    },
    /// The package exceeds a bound.
    #[error("{}; do not trust this file, or export the model again as STL", limit.words())]
    TooMuch {
        /// The bound.
        limit: Limit,
    },
}

/// Makes the fault of a part whose text is not XML.
pub(super) fn xml_fault(part: &str, line: usize, reason: &str) -> ThreeMfError {
    ThreeMfError::Xml {
        part: part.to_owned(),
        line,
        reason: reason.to_owned(),
    }
}
