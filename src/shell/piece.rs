//! One convex piece of what must stay solid; a column meets it in one stretch.

use super::ball::{Ball, BallRow};
use super::cylinder::{Cylinder, CylinderRow};
use super::footprint::Footprint;
use super::slab::{Slab, SlabRow};

/// A convex piece of the wall or of a keep-solid region, in the goal frame.
///
/// The piece is the part of a prism, cylinder or ball that stands over a footprint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    footprint: Footprint,
    z_min_mm: f64,
    shape: Shape,
}

/// What a piece is made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shape {
    Slab(Slab),
    Cylinder(Cylinder),
    Ball(Ball),
}

/// A piece cut by one row of columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowForm {
    /// Behind a face.
    Slab(SlabRow),
    /// About an edge.
    Cylinder(CylinderRow),
    /// About a vertex.
    Ball(BallRow),
}

/// A piece cut by a row: one stretch of z for each x.
pub trait OnRow {
    /// The bottom and top, mm, of the stretch in the column at `x_mm`; not bottom < top (and
    /// perhaps not a number) if the column misses the piece. Exact up to rounding.
    fn stretch(&self, x_mm: f64) -> [f64; 2];
}

impl Piece {
    /// The part of `shape` over `footprint`, nowhere lower than `z_min_mm`.
    pub(super) fn new(footprint: Footprint, z_min_mm: f64, shape: Shape) -> Self {
        Self {
            footprint,
            z_min_mm,
            shape,
        }
    }

    /// The y-range, mm.
    pub fn y_range_mm(&self) -> [f64; 2] {
        self.footprint.y_range_mm()
    }

    /// A height, mm, below which nothing of the piece lies.
    pub fn z_min_mm(&self) -> f64 {
        self.z_min_mm
    }

    /// The x-range, mm, of the piece over the row at `y_mm` and its form there; None if the row
    /// misses it.
    pub fn on_row(&self, y_mm: f64) -> Option<([f64; 2], RowForm)> {
        let x_range_mm = self.footprint.on_row(y_mm)?;
        let form = match &self.shape {
            Shape::Slab(slab) => slab.on_row(y_mm),
            Shape::Cylinder(cylinder) => cylinder.on_row(y_mm),
            Shape::Ball(ball) => ball.on_row(y_mm),
        };
        Some((x_range_mm, form))
    }
}
