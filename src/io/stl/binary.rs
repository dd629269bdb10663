//! Reads binary STL: 80 bytes of header, the triangle count, 50 bytes for each triangle.

use std::io::Cursor;

use super::error::StlError;
use super::layout::{HEADER_BYTES, PREFIX_BYTES, TRIANGLE_BYTES};
use crate::geom::Point;

/// Returns true if the file is exactly as long as its triangle count requires.
pub(crate) fn is_binary(bytes: &[u8]) -> bool {
    promised_count(bytes)
        .is_some_and(|count| bytes.len() - PREFIX_BYTES == count as usize * TRIANGLE_BYTES)
}

/// Returns the triangle count after the header; `None` if the file is too short.
fn promised_count(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER_BYTES..PREFIX_BYTES)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

/// Returns the corners of all triangles, three for each.
pub(super) fn decode(bytes: &[u8]) -> Result<Vec<Point>, StlError> {
    let promised_count = promised_count(bytes).ok_or(StlError::HeaderCut { bytes: bytes.len() })?;
    if !is_binary(bytes) {
        let body = bytes.len() - PREFIX_BYTES;
        let (found, spare_bytes) = (body / TRIANGLE_BYTES, body % TRIANGLE_BYTES);
        return Err(StlError::WrongLength {
            promised: promised_count,
            found,
            spare_bytes,
        });
    }
    read_triangles(bytes)
}

/// Reads the triangles with the header blanked, because `stl_io` takes a header that begins with
/// "solid" for ASCII.
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
