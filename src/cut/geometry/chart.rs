//! Points of a plane in the plane's own coordinates.

use crate::geom::{Plane, Point, Vector};

/// A point of the cutting plane in the coordinates of [`Plane::basis`], mm.
pub type Point2 = nalgebra::Point2<f64>;

/// The plane's coordinates of a point of space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chart {
    u: Vector,
    v: Vector,
}

impl Chart {
    pub(crate) fn of_plane(plane: &Plane) -> Self {
        let (u, v) = plane.basis();
        Self { u, v }
    }

    pub(crate) fn flat(&self, point: &Point) -> Point2 {
        Point2::new(self.u.dot(&point.coords), self.v.dot(&point.coords))
    }

    /// The point of `plane` with these coordinates.
    pub(crate) fn lift(&self, plane: &Plane, point: &Point2) -> Point {
        plane.foot() + self.u * point.x + self.v * point.y
    }
}
