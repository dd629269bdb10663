//! The wall about one edge: a cylinder between its end planes, and the stretch of a column in it.

use nalgebra::Unit;

use super::footprint::Footprint;
use super::on_row::OnRow;
use crate::geom::{Point, Vector, orthonormal_basis};

/// Squared horizontal part of an axis below which the axis counts as vertical. With less, the
/// centre of the chord, which is divided by it, would overflow. With more, the lean over the height
/// of a model could exceed rounding.
const VERTICAL_LIMIT: f64 = 1e-24;

/// The points within `radius` of a segment, between the planes through its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cylinder {
    from: Point,
    axis: Vector,
    length: f64,
    radius: f64,
}

impl Cylinder {
    /// Returns the cylinder from `from` to `to`; `None` if the two are the same point.
    pub fn new(from: Point, to: Point, radius: f64) -> Option<Self> {
        let (axis, length) = Unit::try_new_and_get(to - from, 0.0)?;
        Some(Self {
            from,
            axis: axis.into_inner(),
            length,
            radius,
        })
    }

    /// Returns offsets from the axis whose hull about the segment holds the whole cylinder.
    pub fn square(&self) -> [Vector; 4] {
        let (u, v) = orthonormal_basis(&self.axis);
        [u + v, u - v, -u - v, v - u].map(|corner| corner * self.radius)
    }

    /// Returns the shadow of the hull of the segment's ends moved by `offsets`, widened by
    /// `margin_mm`.
    pub fn footprint(&self, offsets: &[Vector], margin_mm: f64) -> Footprint {
        let to = self.to();
        let hull: Vec<Point> = offsets
            .iter()
            .flat_map(|offset| [self.from + offset, to + offset])
            .collect();
        Footprint::of_points(&hull, margin_mm)
    }

    /// Returns a lower bound of the heights, mm.
    pub fn z_min_mm(&self) -> f64 {
        self.from.z.min(self.to().z) - self.radius
    }

    fn to(&self) -> Point {
        self.from + self.axis * self.length
    }

    /// Returns the cylinder cut by the row at `y_mm`.
    pub fn on_row(&self, y_mm: f64) -> CylinderRow {
        let axis = self.axis;
        let dy = y_mm - self.from.y;
        let squared_lean = axis.x * axis.x + axis.y * axis.y;
        CylinderRow {
            x: self.from.x,
            z: self.from.z,
            lean: squared_lean,
            chord: squared_lean * self.radius * self.radius,
            across: [-axis.y, dy * axis.x],
            along: [axis.x, dy * axis.y],
            axis_z: axis.z,
            length: self.length,
            squared_reach: self.radius * self.radius - dy * dy,
        }
    }
}

/// A cylinder cut by a row. In the fields, q is the horizontal offset of a column from the axis's
/// start and u the axis.
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
    /// Returns the stretch in the endless cylinder, relative to the axis's start: the solution of
    /// |q × u + z e × u| ≤ r for z.
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

    /// Returns the stretch between the end planes, relative to the axis's start: 0 ≤ q·u + z u_z ≤
    /// length.
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

/// The stretch that is the whole line.
const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
/// The empty stretch.
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
    use crate::shell::piece::{Piece, RowForm};

    /// Returns whether a point is in the cylinder by the definition.
    fn holds(cylinder: &Cylinder, point: &Point) -> bool {
        let from = point - cylinder.from;
        let along = from.dot(&cylinder.axis);
        (0.0..=cylinder.length).contains(&along)
            && (from - cylinder.axis * along).norm() <= cylinder.radius
    }

    /// Returns the number of random points about the cylinder that its columns find in it. Asserts
    /// that the definition agrees for each.
    fn check(axis: &Vector, random: &mut Random) -> usize {
        let from = Point::new(1.0, -2.0, 0.5);
        let cylinder = Cylinder::new(from, from + axis * 3.0, 1.5).unwrap();
        let piece = Piece::of_cylinder(cylinder, 0.0);
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
    fn columns_meet_cylinders_of_any_direction_as_the_definition_says() {
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
    fn two_equal_ends_make_no_cylinder() {
        assert_eq!(Cylinder::new(Point::origin(), Point::origin(), 1.0), None);
    }
}
