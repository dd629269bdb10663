//! Polyhedra that no connection joins.

use super::inscribe::NoRoom;
use crate::geom::Plane;

/// Two polyhedra on both sides of a plane that no connection joins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unjoined {
    /// The polyhedra, as indices: the one below the plane, and the one above.
    pub polyhedra: [usize; 2],
    /// The plane between them.
    pub plane: Plane,
    /// The radius of the largest disc that faces of both share on the plane, mm; 0 if none do.
    pub disc_mm: f64,
    /// The radius of the widest straight way inside the model between two faces that face each
    /// other, mm; `None` if there are no such faces, or they have no room for rods.
    pub way_mm: Option<f64>,
}

/// The reason that there are not as many polyhedra as asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoPlan {
    /// The model is too thin for any.
    NoRoom(NoRoom),
    /// There is room for one more, but nothing joins it to the others.
    Unjoined {
        /// The polyhedra that would stay apart.
        apart: Unjoined,
        /// The number of polyhedra that are joined.
        joined: usize,
    },
}
