//! A side of a polyhedron: a plane, and whether it may move.

use crate::geom::Plane;

/// A plane that bounds a polyhedron; the polyhedron lies below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    /// The plane; its normal points outward.
    pub plane: Plane,
    /// True for a plane that parts two polyhedra: it stays.
    pub is_locked: bool,
}
