//! The faults of an STL file, each with its place.

use super::layout::PREFIX_BYTES;

/// The reason that bytes are not an STL mesh, with the place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StlError {
    /// A binary file shorter than its own header.
    #[error(
        "the file ends after {bytes} bytes, within the header of {}; copy or export it again",
        PREFIX_BYTES
    )]
    HeaderCut {
        /// Length of the file, bytes.
        bytes: usize,
    },
    /// A binary file whose length does not match its triangle count.
    #[error(
        "the header promises {promised} triangles, but there are bytes for {found}{}; the file was cut off or \
         badly written: copy or export it again",
        if *spare_bytes > 0 { format!(" and {spare_bytes} bytes more") } else { String::new() }
    )]
    WrongLength {
        /// The triangle count in the header.
        promised: u32,
        /// Number of whole triangles in the file.
        found: usize,
        /// Number of bytes left after them.
        spare_bytes: usize,
    },
    /// There are no triangles.
    #[error("there are no triangles in it; export the model again with its faces")]
    NoTriangles,
    /// A coordinate is NaN or infinite.
    #[error("facet {facet}: a coordinate is not a finite number; export the model again")]
    NotFinite {
        /// Number of the facet, from 1.
        facet: usize,
    },
    /// An unexpected word in an ASCII file.
    #[error(
        "line {line}, facet {facet}: expected {expected}, found {found:?}; export the model again, or as binary STL"
    )]
    Unexpected {
        /// The line, from 1.
        line: usize,
        /// Number of the facet, from 1.
        facet: usize,
        /// The text expected there.
        expected: &'static str,
        /// The text found there.
        found: String,
    },
    /// An ASCII file that ends within its last solid.
    #[error(
        "the file ends at line {line}, in or after facet {facet}, without {expected}; it was cut off: copy or \
         export it again"
    )]
    Cut {
        /// The last line, from 1.
        line: usize,
        /// The last facet begun, from 1.
        facet: usize,
        /// The text expected next.
        expected: &'static str,
    },
    /// The library that reads binary files reports a fault.
    #[error("facet {facet}: {reason}; export the model again")]
    Facet {
        /// Number of the facet, from 1.
        facet: usize,
        /// The message of the reader.
        reason: String,
    },
}
