//! The layout of a binary STL file.

/// Size of the header and the triangle count, bytes.
pub(super) const PREFIX_BYTES: usize = HEADER_BYTES + 4;
/// Size of the free text at the start, bytes.
pub(super) const HEADER_BYTES: usize = 80;
/// Size of a triangle, bytes: a normal and three corners (f32), and two bytes of attribute.
pub(super) const TRIANGLE_BYTES: usize = 50;
