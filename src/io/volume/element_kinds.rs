//! The kinds of cells in files: which are tetrahedra, which fill space otherwise, and which do not.

/// A kind of cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CellKind {
    /// A straight tetrahedron of four corners.
    Tetrahedron,
    /// Another cell that fills space, named in plural.
    Solid(&'static str),
    /// A cell of lower dimension, named in plural.
    Flat(&'static str),
}

use CellKind::{Flat, Solid, Tetrahedron};

/// Gmsh's kinds by number from 1, with the nodes of each.
const GMSH: [(CellKind, usize); 31] = [
    (Flat("lines"), 2),
    (Flat("triangles"), 3),
    (Flat("quadrangles"), 4),
    (Tetrahedron, 4),
    (Solid("hexahedra"), 8),
    (Solid("prisms"), 6),
    (Solid("pyramids"), 5),
    (Flat("lines"), 3),
    (Flat("triangles"), 6),
    (Flat("quadrangles"), 9),
    (Solid("curved tetrahedra"), 10),
    (Solid("hexahedra"), 27),
    (Solid("prisms"), 18),
    (Solid("pyramids"), 14),
    (Flat("points"), 1),
    (Flat("quadrangles"), 8),
    (Solid("hexahedra"), 20),
    (Solid("prisms"), 15),
    (Solid("pyramids"), 13),
    (Flat("triangles"), 9),
    (Flat("triangles"), 10),
    (Flat("triangles"), 12),
    (Flat("triangles"), 15),
    (Flat("triangles"), 15),
    (Flat("triangles"), 21),
    (Flat("lines"), 4),
    (Flat("lines"), 5),
    (Flat("lines"), 6),
    (Solid("curved tetrahedra"), 20),
    (Solid("curved tetrahedra"), 35),
    (Solid("curved tetrahedra"), 56),
];

/// A kind of element of Gmsh.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElementKind {
    pub cell: CellKind,
    /// Number of its nodes.
    pub nodes: usize,
}

/// Returns a kind of Gmsh by its number; `None` for an unknown one.
pub(super) fn of_gmsh(number: u64) -> Option<ElementKind> {
    let index = usize::try_from(number).ok()?.checked_sub(1)?;
    let (cell, nodes) = GMSH.get(index).copied()?;
    Some(ElementKind { cell, nodes })
}

/// Returns the corners of a plain kind of VTK; `None` for kinds whose corners vary.
pub(super) fn corners_of_vtk(number: u64) -> Option<usize> {
    match number {
        1 => Some(1),
        3 => Some(2),
        5 => Some(3),
        8..=10 => Some(4),
        _ => None,
    }
}

/// Returns a kind of VTK by its number; `None` for an unknown one.
pub(super) fn of_vtk(number: u64) -> Option<CellKind> {
    Some(match number {
        10 => Tetrahedron,
        0 => Flat("empty cells"),
        1 | 2 => Flat("points"),
        3 | 4 | 21 | 35 | 68 | 75 => Flat("lines"),
        5 | 6 | 22 | 34 | 69 | 76 => Flat("triangles"),
        7 | 36 => Flat("polygons"),
        8 | 9 | 23 | 28 | 30 | 70 | 77 => Flat("quadrangles"),
        11 | 12 | 25 | 29 | 33 | 72 | 79 => Solid("hexahedra"),
        13 | 26 | 31 | 32 | 73 | 80 => Solid("prisms"),
        14 | 27 | 37 | 74 | 81 => Solid("pyramids"),
        15 | 16 | 42 => Solid("polyhedra"),
        24 | 71 | 78 => Solid("curved tetrahedra"),
        _ => return None,
    })
}
