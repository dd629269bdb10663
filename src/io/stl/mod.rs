//! STL: reading both kinds, writing the binary one.

mod ascii;
mod binary;
mod write;

pub use write::{WriteError, encode, write};
pub(super) use {ascii::is_ascii as is_ascii_stl, binary::is_binary as is_binary_stl};

use crate::geom::Point;
use crate::mesh::TriMesh;

/// Why bytes are not an STL mesh, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StlError {
    /// A binary file shorter than its own header.
    #[error(
        "the file ends after {bytes} bytes, within the header of {}; copy or export it again",
        binary::PREFIX_BYTES
    )]
    HeaderCut {
        /// How many bytes there are.
        bytes: usize,
    },
    /// A binary file whose length does not fit its triangle count.
    #[error(
        "the header promises {promised} triangles, but there are bytes for {found}{}; the file was cut off or \
         badly written: copy or export it again",
        if *spare_bytes > 0 { format!(" and {spare_bytes} bytes more") } else { String::new() }
    )]
    WrongLength {
        /// The triangle count in the header.
        promised: u32,
        /// How many whole triangles there are.
        found: usize,
        /// How many bytes are left after them.
        spare_bytes: usize,
    },
    /// There are no triangles.
    #[error("there are no triangles in it; export the model again with its faces")]
    NoTriangles,
    /// A coordinate is NaN or infinite.
    #[error("facet {facet}: a coordinate is not a finite number; export the model again")]
    NotFinite {
        /// Which facet, from 1.
        facet: usize,
    },
    /// A word that does not belong where it stands in an ASCII file.
    #[error(
        "line {line}, facet {facet}: expected {expected}, found {found:?}; export the model again, or as binary STL"
    )]
    Unexpected {
        /// The line, from 1.
        line: usize,
        /// Which facet, from 1.
        facet: usize,
        /// What should stand there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// An ASCII file that ends before its last solid does.
    #[error(
        "the file ends at line {line}, in or after facet {facet}, without {expected}; it was cut off: copy or \
         export it again"
    )]
    Cut {
        /// The last line, from 1.
        line: usize,
        /// The last facet begun, from 1.
        facet: usize,
        /// What should have come.
        expected: &'static str,
    },
    /// The reader for binary files met a fault of its own.
    #[error("facet {facet}: {reason}; export the model again")]
    Facet {
        /// Which facet, from 1.
        facet: usize,
        /// What the reader says.
        reason: String,
    },
}

/// The triangles of an STL file, binary or ASCII as its content shows, as a soup of three vertices
/// each.
///
/// All solids of an ASCII file are read; facet normals and attributes are ignored. Every coordinate
/// is finite and there is at least one triangle. ASCII coordinates keep their double precision.
pub fn decode(bytes: &[u8]) -> Result<TriMesh, StlError> {
    let is_ascii = !binary::is_binary(bytes) && ascii::is_ascii(bytes);
    let corners = if is_ascii {
        ascii::decode(bytes)?
    } else {
        binary::decode(bytes)?
    };
    if corners.is_empty() {
        return Err(StlError::NoTriangles);
    }
    match corners
        .iter()
        .position(|p| !p.coords.iter().all(|x| x.is_finite()))
    {
        Some(corner) => Err(StlError::NotFinite {
            facet: corner / 3 + 1,
        }),
        None => Ok(soup(corners)),
    }
}

/// Three consecutive points make a triangle.
fn soup(corners: Vec<Point>) -> TriMesh {
    let triangles = (0..corners.len() as u32 / 3)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .collect();
    TriMesh::from_parts(corners, triangles)
}
