//! What a file says of a volume mesh, not yet checked.

use crate::geom::Point;

/// The density of a volume mesh, relative to the solid material: 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Densities {
    /// Solid everywhere.
    Solid,
    /// A value for each vertex, linear in each tetrahedron.
    Corners(Vec<f64>),
    /// A value for each tetrahedron, constant in it.
    Cells(Vec<f64>),
}

/// Vertices, tetrahedra that name four of them each, and densities.
#[derive(Debug, Clone, PartialEq)]
pub struct TetsParts {
    /// Vertices, mm; some may be named by no tetrahedron.
    pub vertices: Vec<Point>,
    /// The corners of each tetrahedron, in either order of turning.
    pub cells: Vec<[u32; 4]>,
    /// The densities.
    pub densities: Densities,
}
