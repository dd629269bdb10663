//! The wall about one vertex: a ball, and the stretch of a column in it.

use super::footprint::Footprint;
use super::piece::{OnRow, Piece, RowForm, Shape};
use crate::geom::{Point, Vector};

/// The points within `radius` of `center`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    center: Point,
    radius: f64,
}

impl Ball {
    /// The ball about `center`.
    pub fn new(center: Point, radius: f64) -> Self {
        Self { center, radius }
    }

    /// The whole ball as a piece.
    pub fn into_piece(self, margin_mm: f64) -> Piece {
        let r = self.radius;
        let square = [(r, r), (-r, r), (-r, -r), (r, -r)].map(|(x, y)| Vector::new(x, y, 0.0));
        self.into_piece_over(&square, margin_mm)
    }

    /// A piece that holds the part of the ball within the hull of the centre moved by `offsets`.
    pub fn into_piece_over(self, offsets: &[Vector], margin_mm: f64) -> Piece {
        let hull: Vec<Point> = offsets.iter().map(|offset| self.center + offset).collect();
        let z_min_mm = self.center.z - self.radius;
        Piece::new(Footprint::of_points(&hull, margin_mm), z_min_mm, Shape::Ball(self))
    }

    /// The ball cut by the row at `y_mm`.
    pub fn on_row(&self, y_mm: f64) -> RowForm {
        let dy = y_mm - self.center.y;
        let squared_reach = self.radius * self.radius - dy * dy;
        RowForm::Ball(BallRow { x: self.center.x, z: self.center.z, squared_reach })
    }
}

/// A ball cut by a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallRow {
    x: f64,
    z: f64,
    squared_reach: f64,
}

impl OnRow for BallRow {
    #[inline]
    fn stretch(&self, x_mm: f64) -> [f64; 2] {
        let dx = x_mm - self.x;
        let half = (self.squared_reach - dx * dx).sqrt();
        [self.z - half, self.z + half]
    }
}
