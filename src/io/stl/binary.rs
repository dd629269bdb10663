//! Binary STL: 80 bytes of header, the triangle count, 50 bytes a triangle.

use std::io::Cursor;

use super::StlError;
use crate::geom::Point;

/// The header and the triangle count.
pub(super) const PREFIX_BYTES: usize = HEADER_BYTES + 4;
/// The free text at the start.
pub(super) const HEADER_BYTES: usize = 80;
/// A normal, three corners (f32) and two bytes of attribute.
pub(super) const TRIANGLE_BYTES: usize = 50;

/// Whether the length of the file is the one its triangle count asks for.
pub(crate) fn is_binary(bytes: &[u8]) -> bool {
    promised(bytes)
        .is_some_and(|count| bytes.len() - PREFIX_BYTES == count as usize * TRIANGLE_BYTES)
}

/// The triangle count in the header, if there is one.
fn promised(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER_BYTES..PREFIX_BYTES)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

/// The corners of all triangles.
pub(super) fn decode(bytes: &[u8]) -> Result<Vec<Point>, StlError> {
    let promised = promised(bytes).ok_or(StlError::HeaderCut { bytes: bytes.len() })?;
    if !is_binary(bytes) {
        let body = bytes.len() - PREFIX_BYTES;
        let (found, spare_bytes) = (body / TRIANGLE_BYTES, body % TRIANGLE_BYTES);
        return Err(StlError::WrongLength {
            promised,
            found,
            spare_bytes,
        });
    }
    read_triangles(bytes)
}

/// Reads the triangles, the header blanked: the reader takes a header that begins with "solid" for
/// ASCII.
fn read_triangles(bytes: &[u8]) -> Result<Vec<Point>, StlError> {
    let mut input = Cursor::new(bytes.to_vec());
    input.get_mut()[..HEADER_BYTES].fill(0);
    let failed = |facet: usize| {
        move |error: std::io::Error| StlError::Facet {
            facet,
            reason: error.to_string(),
        }
    };
    let reader = stl_io::create_stl_reader(&mut input).map_err(failed(1))?;
    let mut corners = Vec::with_capacity(3 * (bytes.len() - PREFIX_BYTES) / TRIANGLE_BYTES);
    for (index, triangle) in reader.enumerate() {
        let triangle = triangle.map_err(failed(index + 1))?;
        corners.extend(triangle.vertices.map(|v| Point::from(v.0.map(f64::from))));
    }
    Ok(corners)
}
