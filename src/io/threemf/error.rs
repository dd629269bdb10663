//! What can be wrong with a 3MF package, and where.

/// What of a package is bounded, so that a small file cannot take all memory or time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// Unpacked bytes, for each packed one.
    Unpacked,
    /// Files that hold models.
    Models,
    /// Components within components.
    Depth,
    /// Objects, counted at each of their places.
    Places,
    /// Triangles, counted at each of their places.
    Triangles,
}

impl Limit {
    /// The most there may be.
    ///
    /// Unpacked: the most regular meshes are packed to a fortieth, while blanks are packed to a
    /// thousandth. Depth: drawing programs nest a few assemblies; a thousand would overflow the
    /// stack. Places and triangles: more than any printer's job, and all of them still fit in
    /// memory (4 GB).
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

/// Why bytes are not a 3MF model that can be used, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ThreeMfError {
    /// The archive cannot be unpacked.
    #[error("{part}: {reason}; the file was cut off or damaged: copy or export it again")]
    Archive {
        /// Which file in the archive.
        part: String,
        /// What the archive says.
        reason: String,
    },
    /// There is no model in the archive.
    #[error(
        "there is no model in it (looked for {part}); is this another kind of ZIP archive? export the model as 3MF"
    )]
    NoModel {
        /// The file that was looked for.
        part: String,
    },
    /// The text is not XML.
    #[error("{part}, line {line}: {reason}; export the model again")]
    Xml {
        /// Which file in the archive.
        part: String,
        /// The line, from 1.
        line: usize,
        /// What the parser says.
        reason: String,
    },
    /// The text declares entities.
    #[error(
        "{part}, line {line}: it declares a document type, which 3MF forbids; do not trust this file, or export the model again"
    )]
    DocumentType {
        /// Which file in the archive.
        part: String,
        /// The line, from 1.
        line: usize,
    },
    /// An attribute is missing, or is not what it should be.
    #[error(
        "{part}, line {line}: <{element}> needs {attribute} to be {expected}, found {found:?}; export the model again"
    )]
    Attribute {
        /// Which file in the archive.
        part: String,
        /// The line, from 1.
        line: usize,
        /// The element.
        element: &'static str,
        /// Its attribute.
        attribute: &'static str,
        /// What it should be.
        expected: &'static str,
        /// What it is; empty if it is missing.
        found: String,
    },
    /// A triangle names a vertex that does not exist.
    #[error(
        "object {object}: triangle {triangle} names vertex {vertex}, but there are {vertices} vertices from 0 on; export the model again"
    )]
    IndexOutOfRange {
        /// The object's identifier.
        object: u32,
        /// Which triangle, from 0.
        triangle: usize,
        /// The index it names.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Two objects have one identifier.
    #[error("{part}: there are two objects {object}; export the model again")]
    Twice {
        /// Which file in the archive.
        part: String,
        /// The identifier.
        object: u32,
    },
    /// An item or a component names an object that does not exist.
    #[error(
        "{part}: there is no object {object} where one is to be placed; export the model again"
    )]
    NoObject {
        /// Which file in the archive should have it.
        part: String,
        /// The identifier.
        object: u32,
    },
    /// An object is a component of itself.
    #[error("{part}: object {object} is a component of itself; export the model again")]
    Circle {
        /// Which file in the archive.
        part: String,
        /// The identifier.
        object: u32,
    },
    /// An extension that changes the shape.
    #[error(
        "the model needs the extension {extension}, which is not understood; export it as plain triangles"
    )]
    Extension {
        /// Its namespace or prefix.
        extension: String,
    },
    /// A place is so far away that a coordinate is no number.
    #[error(
        "object {object}: a coordinate is not a finite number where it is placed; export the model again"
    )]
    NotFinite {
        /// The identifier.
        object: u32,
    },
    /// There is nothing to be made.
    #[error("its build holds no triangles; put the model on the plate and export it again")]
    NoTriangles,
    /// The package is larger than its file has any reason to be.
    #[error("{}; do not trust this file, or export the model again as STL", limit.words())]
    TooMuch {
        /// What there is too much of.
        limit: Limit,
    },
}
