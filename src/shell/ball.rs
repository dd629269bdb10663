//! The wall about one vertex: a ball, and the stretch of a column in it.

use super::footprint::Footprint;
use super::on_row::OnRow;
use crate::geom::{Point, Vector};

/// The points within `radius` of `center`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    center: Point,
    radius: f64,
}

impl Ball {
    /// Returns the ball about `center`.
    pub fn new(center: Point, radius: f64) -> Self {
        Self { center, radius }
    }

    /// Returns offsets from the centre whose hull's shadow holds the ball's shadow.
    pub fn square(&self) -> [Vector; 4] {
        let r = self.radius;
        [(r, r), (-r, r), (-r, -r), (r, -r)].map(|(x, y)| Vector::new(x, y, 0.0))
    }

    /// Returns the shadow of the hull of the centre moved by `offsets`, widened by `margin_mm`.
    pub fn footprint(&self, offsets: &[Vector], margin_mm: f64) -> Footprint {
        let hull: Vec<Point> = offsets.iter().map(|offset| self.center + offset).collect();
        Footprint::of_points(&hull, margin_mm)
    }

    /// Returns the height of the lowest point, mm.
    pub fn z_min_mm(&self) -> f64 {
        self.center.z - self.radius
    }

    /// Returns the ball cut by the row at `y_mm`.
    pub fn on_row(&self, y_mm: f64) -> BallRow {
        let dy = y_mm - self.center.y;
        let squared_reach = self.radius * self.radius - dy * dy;
        BallRow {
            x: self.center.x,
            z: self.center.z,
            squared_reach,
        }
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
    use crate::shell::piece::{Piece, RowForm};

    #[test]
    fn a_column_meets_a_ball_in_the_chord_of_pythagoras_and_misses_it_outside() {
        let piece = Piece::of_ball(Ball::new(Point::new(1.0, 2.0, 3.0), 5.0), 0.0);
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
