//! An oriented plane.

use super::{Point, Vector};

/// The plane { x : normal·x = offset_mm }, with a unit normal. On its positive side normal·x is
/// larger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// The unit normal.
    pub normal: Vector,
    /// The signed distance of the plane from the origin along the normal, mm.
    pub offset_mm: f64,
}

impl Plane {
    /// Makes the plane through `point` perpendicular to `normal` (any length but zero).
    pub fn through(point: &Point, normal: &Vector) -> Self {
        let normal = normal.normalize();
        Self {
            normal,
            offset_mm: normal.dot(&point.coords),
        }
    }

    /// Returns the same plane, seen from its other side.
    #[must_use]
    pub fn flipped(&self) -> Self {
        Self {
            normal: -self.normal,
            offset_mm: -self.offset_mm,
        }
    }

    /// Returns the signed distance of `point`, mm: positive on the side to which the normal
    /// points.
    pub fn distance(&self, point: &Point) -> f64 {
        self.normal.dot(&point.coords) - self.offset_mm
    }

    /// Returns true if some of the points lie above the plane and others do not.
    pub fn passes_through(&self, points: &[Point]) -> bool {
        let mut sides = points.iter().map(|p| self.distance(p) > 0.0);
        sides
            .next()
            .is_some_and(|first| sides.any(|side| side != first))
    }

    /// Returns the point of the plane nearest to the origin.
    pub fn foot(&self) -> Point {
        Point::from(self.normal * self.offset_mm)
    }

    /// Returns two unit vectors that span the plane and make (u, v, normal) right-handed.
    pub fn basis(&self) -> (Vector, Vector) {
        orthonormal_basis(&self.normal)
    }
}

/// Returns unit vectors (u, v) such that (u, v, n) is right-handed and orthonormal, for a unit `n`.
///
/// u is made from the coordinate axis least parallel to n. The choice is stable for nearby normals
/// except where two components tie.
pub fn orthonormal_basis(n: &Vector) -> (Vector, Vector) {
    let axis = Vector::ith(n.iamin(), 1.0);
    let u = (axis - n * n.dot(&axis)).normalize();
    (u, n.cross(&u))
}
