//! The wall about one edge: a cylinder between its end planes, and the stretch of a column in it.

use nalgebra::Unit;

use super::footprint::Footprint;
use super::piece::{OnRow, Piece, RowForm, Shape};
use crate::geom::{Point, Vector, orthonormal_basis};

/// Axes with a smaller squared horizontal part count as vertical. Below, the centre of the chord
/// (which is divided by it) would overflow; above, the lean over the height of a model could exceed
/// rounding.
const VERTICAL_LIMIT: f64 = 1e-24;

/// The points within `radius` of a segment whose foot on the segment's line lies on the segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cylinder {
    from: Point,
    axis: Vector,
    length: f64,
    radius: f64,
}

impl Cylinder {
    /// The cylinder from `from` to `to`; None if the two are the same point.
    pub fn new(from: Point, to: Point, radius: f64) -> Option<Self> {
        let (axis, length) = Unit::try_new_and_get(to - from, 0.0)?;
        Some(Self {
            from,
            axis: axis.into_inner(),
            length,
            radius,
        })
    }

    /// The whole cylinder as a piece.
    pub fn into_piece(self, margin_mm: f64) -> Piece {
        let (u, v) = orthonormal_basis(&self.axis);
        let square = [u + v, u - v, -u - v, v - u].map(|corner| corner * self.radius);
        self.into_piece_over(&square, margin_mm)
    }

    /// A piece that holds the part of the cylinder within the hull of the segment's ends moved by
    /// `offsets`.
    pub fn into_piece_over(self, offsets: &[Vector], margin_mm: f64) -> Piece {
        let to = self.from + self.axis * self.length;
        let hull: Vec<Point> = offsets
            .iter()
            .flat_map(|offset| [self.from + offset, to + offset])
            .collect();
        let z_min_mm = self.from.z.min(to.z) - self.radius;
        Piece::new(
            Footprint::of_points(&hull, margin_mm),
            z_min_mm,
            Shape::Cylinder(self),
        )
    }

    /// The cylinder cut by the row at `y_mm`.
    pub fn on_row(&self, y_mm: f64) -> RowForm {
        let axis = self.axis;
        let dy = y_mm - self.from.y;
        let squared_lean = axis.x * axis.x + axis.y * axis.y;
        RowForm::Cylinder(CylinderRow {
            x: self.from.x,
            z: self.from.z,
            lean: squared_lean,
            chord: squared_lean * self.radius * self.radius,
            across: [-axis.y, dy * axis.x],
            along: [axis.x, dy * axis.y],
            axis_z: axis.z,
            length: self.length,
            squared_reach: self.radius * self.radius - dy * dy,
        })
    }
}

/// A cylinder cut by a row. With q the horizontal offset of a column from the axis's start and u
/// the axis:
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CylinderRow {
    x: f64,
    z: f64,
    /// u_x² + u_y².
    lean: f64,
    /// (u_x² + u_y²) r².
    chord: f64,
    /// q × u, affine in the offset in x.
    across: [f64; 2],
    /// q · u, affine in the offset in x.
    along: [f64; 2],
    axis_z: f64,
    length: f64,
    /// r² − q_y², for a vertical axis.
    squared_reach: f64,
}

impl CylinderRow {
    /// The stretch in the endless cylinder, relative to the axis's start: |q × u + z e × u| ≤ r
    /// solved for z.
    #[inline]
    fn endless(&self, dx: f64, along: f64) -> [f64; 2] {
        if self.lean < VERTICAL_LIMIT {
            return if dx * dx <= self.squared_reach {
                EVERYWHERE
            } else {
                NOWHERE
            };
        }
        let across = self.across[0] * dx + self.across[1];
        let discriminant = self.chord - across * across;
        if discriminant < 0.0 {
            return NOWHERE;
        }
        let (middle, half) = (
            along * self.axis_z / self.lean,
            discriminant.sqrt() / self.lean,
        );
        [middle - half, middle + half]
    }

    /// The stretch between the end planes, relative to the axis's start: 0 ≤ q·u + z u_z ≤ length.
    #[inline]
    fn between_ends(&self, along: f64) -> [f64; 2] {
        if self.axis_z == 0.0 {
            return if (0.0..=self.length).contains(&along) {
                EVERYWHERE
            } else {
                NOWHERE
            };
        }
        let (a, b) = (-along / self.axis_z, (self.length - along) / self.axis_z);
        [a.min(b), a.max(b)]
    }
}

/// All of a line.
const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
/// Nothing of a line.
const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

impl OnRow for CylinderRow {
    #[inline]
    fn stretch(&self, x_mm: f64) -> [f64; 2] {
        let dx = x_mm - self.x;
        let along = self.along[0] * dx + self.along[1];
        let [low, high] = self.endless(dx, along);
        let [first, last] = self.between_ends(along);
        [self.z + low.max(first), self.z + high.min(last)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::fixtures::Random;

    /// Whether a point is in the cylinder, by the definition.
    fn holds(cylinder: &Cylinder, point: &Point) -> bool {
        let from = point - cylinder.from;
        let along = from.dot(&cylinder.axis);
        (0.0..=cylinder.length).contains(&along)
            && (from - cylinder.axis * along).norm() <= cylinder.radius
    }

    /// How many of random points about the cylinder its columns find in it; each must be so by the
    /// definition.
    fn check(axis: &Vector, random: &mut Random) -> usize {
        let from = Point::new(1.0, -2.0, 0.5);
        let cylinder = Cylinder::new(from, from + axis * 3.0, 1.5).unwrap();
        let piece = cylinder.into_piece(0.0);
        let is_found = |point: &Point| {
            let Some(([low, high], RowForm::Cylinder(row))) = piece.on_row(point.y) else {
                return false;
            };
            let [bottom, top] = row.stretch(point.x);
            low <= point.x && point.x <= high && bottom <= point.z && point.z <= top
        };
        let points =
            (0..2000).map(|_| from + axis * 1.5 + random.direction() * (3.0 * random.unit()));
        let found = points.filter(|point| {
            let found = is_found(point);
            assert_eq!(
                found,
                holds(&cylinder, point),
                "{point} about the axis {axis}"
            );
            found
        });
        found.count()
    }

    #[test]
    fn columns_meet_cylinders_of_any_direction_where_the_definition_says() {
        let mut random = Random::new(1);
        let nearly_up = Vector::new(1e-7, -1e-8, 1.0).normalize();
        let fixed = [
            Vector::x(),
            -Vector::y(),
            Vector::z(),
            -Vector::z(),
            nearly_up,
        ];
        let others: Vec<Vector> = (0..10).map(|_| random.direction()).collect();
        for axis in fixed.iter().chain(&others) {
            assert!(check(axis, &mut random) > 300);
        }
    }

    #[test]
    fn two_ends_in_one_place_make_no_cylinder() {
        assert_eq!(Cylinder::new(Point::origin(), Point::origin(), 1.0), None);
    }
}
