//! A triangle whose distance is queried, and the bounds that spare exact distances.

use crate::geom::triangle::{
    closest_on_triangle, disjoint_triangles_distance_squared, tangent_bound,
    triangle_triangle_distance_squared,
};
use crate::geom::{Aabb, Point, Vector};

/// A triangle whose distance is queried, with its centre for cheap bounds.
pub(super) struct Probe<'a> {
    corners: &'a [Point; 3],
    center: Point,
}

impl<'a> Probe<'a> {
    #[inline]
    pub(super) fn new(corners: &'a [Point; 3]) -> Self {
        let center = Point::from((corners[0].coords + corners[1].coords + corners[2].coords) / 3.0);
        Self { corners, center }
    }

    /// Returns a lower bound of the distance to a box.
    #[inline]
    pub(super) fn bound(&self, aabb: &Aabb) -> f64 {
        let nearest = self
            .center
            .coords
            .sup(&aabb.min.coords)
            .inf(&aabb.max.coords);
        self.tangent_bound_from(self.center.coords - nearest)
    }

    /// Returns a lower bound of the distance to a triangle.
    #[inline]
    fn triangle_bound(&self, other: &[Point; 3]) -> f64 {
        self.tangent_bound_from(self.center - closest_on_triangle(&self.center, other).point)
    }

    /// Returns true if another triangle is nearer than `limit_mm`.
    #[inline]
    pub(super) fn is_within(&self, other: &[Point; 3], limit_mm: f64) -> bool {
        let bound = self.triangle_bound(other);
        if bound >= limit_mm {
            return false;
        }
        let gap = if bound > 0.0 {
            disjoint_triangles_distance_squared
        } else {
            triangle_triangle_distance_squared
        };
        limit_mm > 0.0 && gap(self.corners, other) < limit_mm * limit_mm
    }

    /// Returns the tangent bound of a convex set whose nearest point is at `center - offset`.
    #[inline]
    fn tangent_bound_from(&self, offset: Vector) -> f64 {
        let distance = offset.norm();
        if distance <= 0.0 {
            return 0.0;
        }
        tangent_bound(&self.center, distance, &(offset / distance), self.corners)
    }
}
