//! Writes binary STL.

use std::path::{Path, PathBuf};

use super::layout::{HEADER_BYTES, PREFIX_BYTES, TRIANGLE_BYTES};
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// First words of every header. Readers take a header that begins with "solid" for ASCII.
const HEADER_START: &str = "binary STL, mm: ";

/// The reason that a file could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: the file cannot be written; check that the folder exists and has room, and your permissions", path.display())]
pub struct WriteError {
    /// The path asked for.
    pub path: PathBuf,
    /// The error of the operating system.
    pub source: std::io::Error,
}

/// Returns the bytes of a binary STL file with `name` in the header (cut at 64 bytes).
///
/// Coordinates are rounded to f32. Normals are computed from the rounded corners;
/// they are zero for a triangle without area. Leaves out triangles whose corners coincide in single
/// precision. Their neighbours then meet along the edge that remains, so a closed mesh stays
/// closed. The same mesh gives the same bytes. A coordinate of −0.0 is written as 0.0, so equal
/// places have equal bytes.
pub fn encode(mesh: &TriMesh, name: &str) -> Vec<u8> {
    let triangles: Vec<[[f32; 3]; 3]> = mesh
        .iter_corners()
        .map(|corners| corners.map(round_to_single))
        .filter(has_distinct_corners)
        .collect();
    let mut bytes = Vec::with_capacity(PREFIX_BYTES + TRIANGLE_BYTES * triangles.len());
    bytes.extend(HEADER_START.bytes().chain(name.bytes()).take(HEADER_BYTES));
    bytes.resize(HEADER_BYTES, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in &triangles {
        for number in normal(*corners).iter().chain(corners.as_flattened()) {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    bytes
}

/// Rounds a point to single precision, without −0.0.
fn round_to_single(p: Point) -> [f32; 3] {
    [p.x, p.y, p.z].map(|x| x as f32 + 0.0)
}

fn has_distinct_corners(&[a, b, c]: &[[f32; 3]; 3]) -> bool {
    a != b && b != c && c != a
}

/// Returns the unit normal of a triangle; zero if it has no area.
fn normal(corners: [[f32; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(|p| Point::from(p.map(f64::from)));
    let normal = (b - a)
        .cross(&(c - a))
        .try_normalize(0.0)
        .unwrap_or_else(Vector::zeros);
    [normal.x, normal.y, normal.z].map(|x| x as f32 + 0.0)
}

/// Writes `mesh` to `path` as binary STL ([`encode`]) and replaces an existing file.
pub fn write(path: &Path, mesh: &TriMesh, name: &str) -> Result<(), WriteError> {
    std::fs::write(path, encode(mesh, name)).map_err(|source| WriteError {
        path: path.to_path_buf(),
        source,
    })
}
