//! STL: reads the binary and the ASCII form, writes the binary one.

mod ascii;
mod binary;
mod error;
mod layout;
mod write;

pub use error::StlError;
pub use write::{WriteError, encode, write};
pub(super) use {ascii::is_ascii as is_ascii_stl, binary::is_binary as is_binary_stl};

use crate::geom::Point;
use crate::mesh::TriMesh;

/// Returns the triangles of an STL file as a soup, three vertices for each.
///
/// The content decides if the file is binary or ASCII. All solids of an ASCII file are read, in
/// double precision. Facet normals and attributes are ignored. Every coordinate is finite and there
/// is at least one triangle.
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

/// Makes a triangle of every three consecutive points.
fn soup(corners: Vec<Point>) -> TriMesh {
    let triangles = (0..corners.len() as u32 / 3)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .collect();
    TriMesh::from_parts(corners, triangles)
}
