//! The slab of wall behind one face: a convex prism, and the stretch of a column in it.

use super::on_row::OnRow;
use crate::geom::{Point, Vector};

/// Largest number of half-spaces that add_half_space a prism from one side: a cap and the three
/// sides.
const MAX_BOUNDS: usize = 4;

/// Vertical component of a unit normal below which the half-space bounds x and y only, which the
/// footprint does already. With a larger limit, slabs would reach too far by the limit times the
/// height of the model. With a smaller one, the heights lose digits: a add_half_space's error is
/// the rounding of a coordinate divided by the component.
const VERTICAL_LIMIT: f64 = 1e-9;

/// A prism as bounds on z that are affine in x and y, given as the coefficients of (x, y, 1). Each
/// z is ≥ every lower and ≤ every upper add_half_space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slab {
    lower: [[f64; 3]; MAX_BOUNDS],
    upper: [[f64; 3]; MAX_BOUNDS],
}

/// Distances to which a slab reaches from its face, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reach {
    /// Distance into the solid.
    pub inward_mm: f64,
    /// Distance out of it.
    pub outward_mm: f64,
}

impl Slab {
    /// Returns the prism over the triangle with this outer unit normal, as far as `reach` says.
    pub fn new(corners: &[Point; 3], normal: &Vector, reach: Reach) -> Self {
        let mut slab = Self {
            lower: [[0.0, 0.0, f64::NEG_INFINITY]; 4],
            upper: [[0.0, 0.0, f64::INFINITY]; 4],
        };
        let mut used = [0, 0];
        slab.add_half_space(&mut used, normal, &(corners[0] + normal * reach.outward_mm));
        slab.add_half_space(
            &mut used,
            &-normal,
            &(corners[0] - normal * reach.inward_mm),
        );
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let side = (corners[to] - corners[from]).cross(normal).normalize();
            slab.add_half_space(&mut used, &side, &corners[from]);
        }
        slab
    }

    /// Adds the half-space through `point` on the inner side of the outward unit `normal`.
    fn add_half_space(&mut self, used: &mut [usize; 2], normal: &Vector, point: &Point) {
        if normal.z.abs() < VERTICAL_LIMIT {
            return;
        }
        let coefficients = [
            -normal.x / normal.z,
            -normal.y / normal.z,
            normal.dot(&point.coords) / normal.z,
        ];
        if normal.z > 0.0 {
            self.upper[used[0]] = coefficients;
            used[0] += 1;
        } else {
            self.lower[used[1]] = coefficients;
            used[1] += 1;
        }
    }

    /// Returns the prism cut by the row at `y_mm`.
    pub fn on_row(&self, y_mm: f64) -> SlabRow {
        let on_row = |[x, y, c]: [f64; 3]| [x, y * y_mm + c];
        SlabRow {
            lower: self.lower.map(on_row),
            upper: self.upper.map(on_row),
        }
    }
}

/// Returns the six corners of the prism over a triangle, the outer ones first.
pub(super) fn prism_corners(corners: &[Point; 3], normal: &Vector, reach: Reach) -> Vec<Point> {
    let outer = corners.map(|corner| corner + normal * reach.outward_mm);
    let inner = corners.map(|corner| corner - normal * reach.inward_mm);
    [outer, inner].concat()
}

/// A slab cut by a row: bounds on z that are affine in x, as the coefficients of (x, 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlabRow {
    lower: [[f64; 2]; MAX_BOUNDS],
    upper: [[f64; 2]; MAX_BOUNDS],
}

impl OnRow for SlabRow {
    #[inline]
    fn stretch(&self, x_mm: f64) -> [f64; 2] {
        let at = |[slope, offset]: [f64; 2]| slope * x_mm + offset;
        let [a, b, c, d] = self.lower.map(at);
        let [e, f, g, h] = self.upper.map(at);
        [a.max(b).max(c.max(d)), e.min(f).min(g.min(h))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::fixtures::Random;
    use crate::shell::piece::{Piece, RowForm};

    const REACH: Reach = Reach {
        inward_mm: 0.8,
        outward_mm: 0.1,
    };

    /// Returns whether a point is in the prism by the definition: between the caps and inside all
    /// three sides.
    fn holds(corners: &[Point; 3], normal: &Vector, point: &Point) -> bool {
        let height = (point - corners[0]).dot(normal);
        let is_left = |from: usize| {
            (corners[(from + 1) % 3] - corners[from])
                .cross(&(point - corners[from]))
                .dot(normal)
        };
        (-REACH.inward_mm..=REACH.outward_mm).contains(&height)
            && (0..3).all(|side| is_left(side) >= 0.0)
    }

    /// Returns the number of random points about the triangle that the columns find in its slab.
    /// Asserts that the definition agrees for each.
    fn check(corners: &[Point; 3], random: &mut Random) -> usize {
        let normal = (corners[1] - corners[0])
            .cross(&(corners[2] - corners[0]))
            .normalize();
        let piece = Piece::of_face(corners, &normal, REACH);
        let is_found = |point: &Point| {
            let Some(([low, high], RowForm::Slab(row))) = piece.on_row(point.y) else {
                return false;
            };
            let [bottom, top] = row.stretch(point.x);
            low <= point.x && point.x <= high && bottom <= point.z && point.z <= top
        };
        let center = Point::from((corners[0].coords + corners[1].coords + corners[2].coords) / 3.0);
        let points = (0..3000).map(|_| center + random.direction() * (1.5 * random.unit()));
        let found = points.filter(|point| {
            let found = is_found(point);
            assert_eq!(found, holds(corners, &normal, point), "{point}");
            found
        });
        found.count()
    }

    #[test]
    fn columns_meet_slabs_of_any_direction_as_the_definition_says() {
        let mut random = Random::new(4);
        let flat = [
            Point::origin(),
            Point::new(2.0, 0.0, 0.0),
            Point::new(0.0, 2.0, 0.0),
        ];
        let upright = flat.map(|p| Point::new(p.x, 1.0, p.y));
        let skew = flat.map(|p| Point::new(1.0 - p.x, p.y, p.x * 1e-11));
        for corners in [flat, upright, skew] {
            assert!(check(&corners, &mut random) > 200);
        }
        for _ in 0..10 {
            let corners = [0, 1, 2].map(|_| Point::from(random.direction() * 1.5));
            check(&corners, &mut random);
        }
    }
}
