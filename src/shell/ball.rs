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
        Piece::new(
            Footprint::of_points(&hull, margin_mm),
            z_min_mm,
            Shape::Ball(self),
        )
    }

    /// The ball cut by the row at `y_mm`.
    pub fn on_row(&self, y_mm: f64) -> RowForm {
        let dy = y_mm - self.center.y;
        let squared_reach = self.radius * self.radius - dy * dy;
        RowForm::Ball(BallRow {
            x: self.center.x,
            z: self.center.z,
            squared_reach,
        })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_off_the_centre_meets_a_ball_in_the_chord_of_pythagoras_and_beside_it_not_at_all() {
        let piece = Ball::new(Point::new(1.0, 2.0, 3.0), 5.0).into_piece(0.0);
        assert_eq!((piece.y_range_mm(), piece.z_min_mm()), ([-3.0, 7.0], -2.0));
        let Some((x_range, RowForm::Ball(row))) = piece.on_row(2.0) else {
            panic!("a ball")
        };
        assert_eq!((x_range, row.stretch(4.0)), ([-4.0, 6.0], [-1.0, 7.0]));
        let Some((_, RowForm::Ball(row))) = piece.on_row(5.0) else {
            panic!("a ball")
        };
        assert_eq!(row.stretch(1.0), [-1.0, 7.0]);
        assert!(row.stretch(5.5).iter().all(|z| z.is_nan()));
        assert_eq!(piece.on_row(8.0), None);
    }
}
