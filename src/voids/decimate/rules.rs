//! The rules of a simplification.

use crate::geom::Point;

/// Largest distances of the new surface from the old vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stray {
    /// Distance outside the body, mm.
    pub outside_mm: f64,
    /// Distance inside the body, mm.
    pub inside_mm: f64,
}

/// The conditions that every new triangle must meet.
#[derive(Clone, Copy)]
pub struct Rules<'a> {
    /// Largest distances from the old vertices.
    pub stray: Stray,
    /// A further test of each new triangle.
    pub allows: &'a (dyn Fn(&[Point; 3]) -> bool + Sync),
}
