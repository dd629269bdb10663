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
    /// The corners seen from the centre.
    steps: [Vector; 3],
    /// Largest distance of a corner from the centre, mm.
    radius_mm: f64,
}

impl<'a> Probe<'a> {
    #[inline]
    pub(super) fn new(corners: &'a [Point; 3]) -> Self {
        let center = Point::from((corners[0].coords + corners[1].coords + corners[2].coords) / 3.0);
        let steps = corners.map(|corner| corner - center);
        let radius_squared = steps.iter().map(Vector::norm_squared).fold(0.0, f64::max);
        Self {
            corners,
            center,
            steps,
            radius_mm: radius_squared.sqrt(),
        }
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

    /// Returns true only if no point of a box is nearer than `limit_mm`; false may be wrong.
    #[inline]
    pub(super) fn is_clear_of_box(&self, aabb: &Aabb, limit_mm: f64) -> bool {
        let center = &self.center.coords;
        let nearest = center.sup(&aabb.min.coords).inf(&aabb.max.coords);
        self.is_clear(&(center - nearest), limit_mm)
    }

    /// Returns true only if a convex set is no nearer than `limit_mm`, by the tangent bound; false
    /// may be wrong. The set's point nearest to the centre is at `center - offset`.
    #[inline]
    fn is_clear(&self, offset: &Vector, limit_mm: f64) -> bool {
        let squared = offset.norm_squared();
        let reach_mm = limit_mm + self.radius_mm;
        if squared >= reach_mm * reach_mm {
            return true;
        }
        let falls = self.steps.map(|step| offset.dot(&step));
        squared > 0.0 && squared + falls[0].min(falls[1]).min(falls[2]) >= limit_mm * squared.sqrt()
    }

    /// Returns true if another triangle is nearer than `limit_mm`.
    #[inline]
    pub(super) fn is_within(&self, other: &[Point; 3], limit_mm: f64) -> bool {
        let offset = self.center - closest_on_triangle(&self.center, other).point;
        if limit_mm <= 0.0 || self.is_clear(&offset, limit_mm) {
            return false;
        }
        let gap = if self.is_clear(&offset, 0.0) {
            disjoint_triangles_distance_squared
        } else {
            triangle_triangle_distance_squared
        };
        gap(self.corners, other) < limit_mm * limit_mm
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
