//! The reasons that tetrahedra make no volume mesh.

use std::fmt;

use crate::geom::Point;

/// A reason why tetrahedra with densities fill no solid. Cells and corners are numbered from 0, and
/// from 1 in the messages.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TetsError {
    /// There are no tetrahedra.
    #[error(
        "there are no tetrahedra in it; remedy: mesh the volume, not only its surface, and export \
         it again"
    )]
    Empty,
    /// There are more than can be numbered.
    #[error("{count} tetrahedra are more than can be read; remedy: export a coarser mesh")]
    TooMany {
        /// Number of tetrahedra.
        count: usize,
    },
    /// A tetrahedron names a corner that does not exist.
    #[error(
        "{} names corner {}, and there are {corners} corners; remedy: export it again",
        Cell(*cell), corner + 1
    )]
    NoCorner {
        /// The tetrahedron.
        cell: usize,
        /// The corner.
        corner: u32,
        /// Number of corners.
        corners: usize,
    },
    /// A tetrahedron names one corner twice.
    #[error(
        "{} names corner {} twice, so it has no volume; remedy: leave it out",
        Cell(*cell), corner + 1
    )]
    RepeatedCorner {
        /// The tetrahedron.
        cell: usize,
        /// The corner.
        corner: u32,
    },
    /// A coordinate is NaN or infinite.
    #[error("corner {} of {}: a coordinate is no finite number; remedy: export it again", corner + 1, Cell(*cell))]
    NotFinite {
        /// The tetrahedron.
        cell: usize,
        /// The corner, numbered in the whole mesh.
        corner: u32,
    },
    /// A tetrahedron has no volume but rounding.
    #[error(
        "{} near {} is flat: its volume is nothing but rounding; remedy: mesh again, and let the \
         mesher optimise what it made",
        Cell(*cell), Near(*at)
    )]
    Flat {
        /// The tetrahedron.
        cell: usize,
        /// Its middle, mm.
        at: Point,
    },
    /// Two tetrahedra have the same corners.
    #[error(
        "{} and {} near {} have the same corners; remedy: leave one of them in the file, such as \
         by one physical group for each volume",
        Cell(cells[0]), Cell(cells[1]), Near(*at)
    )]
    Twice {
        /// The tetrahedra.
        cells: [usize; 2],
        /// The middle of one of their faces, mm.
        at: Point,
    },
    /// Two neighbours lie on the same side of the face that they share.
    #[error(
        "{} and {} near {} lie on the same side of the face that they share: the mesh folds over \
         itself; remedy: mesh again, or deform the mesh less",
        Cell(cells[0]), Cell(cells[1]), Near(*at)
    )]
    SameSide {
        /// The tetrahedra.
        cells: [usize; 2],
        /// The middle of their face, mm.
        at: Point,
    },
    /// A face belongs to more than two tetrahedra.
    #[error(
        "{count} tetrahedra share one face near {}, among them {}; remedy: leave each of them in \
         the file once",
        Near(*at), Cell(*cell)
    )]
    CrowdedFace {
        /// One of the tetrahedra.
        cell: usize,
        /// Number of tetrahedra.
        count: usize,
        /// The middle of the face, mm.
        at: Point,
    },
    /// The surface of the mesh crosses itself.
    #[error(
        "the surface of the mesh passes through itself, or faces lie on each other, in {pairs} \
         places, first near {}; remedy: unite the parts before meshing, so that they share faces",
        Near(*at)
    )]
    Crossing {
        /// Number of pairs of faces.
        pairs: usize,
        /// The middle of the first such face, mm.
        at: Point,
    },
    /// Two parts fill the same space.
    #[error(
        "{} near {} lies inside another part of the mesh: the space is filled twice; remedy: cut \
         one part out of the other before meshing",
        Cell(*cell), Near(*at)
    )]
    FilledTwice {
        /// A tetrahedron there.
        cell: usize,
        /// Its middle, mm.
        at: Point,
    },
    /// There are too few or too many densities.
    #[error("there are {found} densities for {wanted} {things}; remedy: export it again")]
    DensityCount {
        /// Number of densities.
        found: usize,
        /// Number of things that have one.
        wanted: usize,
        /// What has one.
        things: &'static str,
    },
    /// A value is no density.
    #[error(
        "the density of {what} {} is {value}, and a density lies from 0 to 1, as a share of the \
         solid material; remedy: write a number, and divide values above 1 by the density of the \
         material",
        index + 1
    )]
    Density {
        /// What has it: a corner or a tetrahedron.
        what: &'static str,
        /// The corner or the tetrahedron.
        index: usize,
        /// The value.
        value: f64,
    },
}

impl TetsError {
    /// Returns the tetrahedron at fault, from 0; `None` if it is no single one.
    pub fn cell(&self) -> Option<usize> {
        match self {
            Self::NoCorner { cell, .. }
            | Self::RepeatedCorner { cell, .. }
            | Self::NotFinite { cell, .. }
            | Self::Flat { cell, .. }
            | Self::CrowdedFace { cell, .. }
            | Self::FilledTwice { cell, .. } => Some(*cell),
            Self::SameSide { cells, .. } | Self::Twice { cells, .. } => Some(cells[1]),
            _ => None,
        }
    }
}

/// A tetrahedron in words, counted from 1.
struct Cell(usize);

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tetrahedron {}", self.0 + 1)
    }
}

/// A place in the coordinates of the file.
struct Near(Point);

impl fmt::Display for Near {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Point { coords } = self.0;
        write!(f, "({:.4}, {:.4}, {:.4})", coords.x, coords.y, coords.z)
    }
}
