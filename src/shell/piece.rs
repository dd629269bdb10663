//! The convex pieces of which the wall is made. A column meets each piece in one stretch.

use super::ball::{Ball, BallRow};
use super::cylinder::{Cylinder, CylinderRow};
use super::footprint::Footprint;
use super::slab::{Reach, Slab, SlabRow, prism_corners};
use crate::geom::{Point, Vector};

/// A convex piece of the wall or of a keep-solid region, in the goal frame.
///
/// The piece is the part of a prism, cylinder or ball that stands over a footprint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    footprint: Footprint,
    z_min_mm: f64,
    shape: Shape,
}

/// The shape of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Slab(Slab),
    Cylinder(Cylinder),
    Ball(Ball),
}

/// A piece cut by one row of columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowForm {
    /// The wall behind a face.
    Slab(SlabRow),
    /// The wall about an edge.
    Cylinder(CylinderRow),
    /// The wall about a vertex.
    Ball(BallRow),
}

impl Piece {
    /// Returns the slab of the wall behind a face with this outer unit normal.
    pub(super) fn of_face(corners: &[Point; 3], normal: &Vector, reach: Reach) -> Self {
        let hull = prism_corners(corners, normal, reach);
        Self {
            footprint: Footprint::of_points(&hull, 0.0),
            z_min_mm: hull.iter().map(|p| p.z).fold(f64::INFINITY, f64::min),
            shape: Shape::Slab(Slab::new(corners, normal, reach)),
        }
    }

    /// Returns the whole cylinder, its footprint widened by `margin_mm`.
    pub(super) fn of_cylinder(cylinder: Cylinder, margin_mm: f64) -> Self {
        Self::of_cylinder_over(cylinder, &cylinder.square(), margin_mm)
    }

    /// Returns a piece that holds the part of the cylinder within the hull of its segment's ends
    /// moved by `offsets`.
    pub(super) fn of_cylinder_over(cylinder: Cylinder, offsets: &[Vector], margin_mm: f64) -> Self {
        Self {
            footprint: cylinder.footprint(offsets, margin_mm),
            z_min_mm: cylinder.z_min_mm(),
            shape: Shape::Cylinder(cylinder),
        }
    }

    /// Returns the whole ball, its footprint widened by `margin_mm`.
    pub(super) fn of_ball(ball: Ball, margin_mm: f64) -> Self {
        Self::of_ball_over(ball, &ball.square(), margin_mm)
    }

    /// Returns a piece that holds the part of the ball within the hull of its centre moved by
    /// `offsets`.
    pub(super) fn of_ball_over(ball: Ball, offsets: &[Vector], margin_mm: f64) -> Self {
        Self {
            footprint: ball.footprint(offsets, margin_mm),
            z_min_mm: ball.z_min_mm(),
            shape: Shape::Ball(ball),
        }
    }

    /// Returns the y-range, mm.
    pub fn y_range_mm(&self) -> [f64; 2] {
        self.footprint.y_range_mm()
    }

    /// Returns a lower bound of the piece's heights, mm.
    pub fn z_min_mm(&self) -> f64 {
        self.z_min_mm
    }

    /// Returns the x-range, mm, of the piece over the row at `y_mm` and its form there; `None` if
    /// the row misses it.
    pub fn on_row(&self, y_mm: f64) -> Option<([f64; 2], RowForm)> {
        let x_range_mm = self.footprint.on_row(y_mm)?;
        let form = match &self.shape {
            Shape::Slab(slab) => RowForm::Slab(slab.on_row(y_mm)),
            Shape::Cylinder(cylinder) => RowForm::Cylinder(cylinder.on_row(y_mm)),
            Shape::Ball(ball) => RowForm::Ball(ball.on_row(y_mm)),
        };
        Some((x_range_mm, form))
    }
}
