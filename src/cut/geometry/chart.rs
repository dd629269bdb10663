//! Conversion between points in space and coordinates in a plane.

use crate::geom::{Plane, Point, Vector};

/// A point of the cutting plane in the coordinates of [`Plane::basis`], mm.
pub type Point2 = nalgebra::Point2<f64>;

/// The coordinate system of a plane: the two vectors of [`Plane::basis`].
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

    /// Returns the point of `plane` with these coordinates.
    pub(crate) fn lift(&self, plane: &Plane, point: &Point2) -> Point {
        plane.foot() + self.u * point.x + self.v * point.y
    }
}
