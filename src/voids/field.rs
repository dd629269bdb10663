//! The interface between a surface extractor and the function whose positive region it bounds.

use crate::geom::{Bvh, NO_HINT, Nearest, Point, Vector};

/// The function's value and what was learnt at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// Value, mm: near the zero surface about the distance to it; positive inside the region.
    pub value: f64,
    /// Unit vector in which the value grows; zero if the value has no direction.
    pub gradient: Vector,
    /// Radius of a ball about the point that the model's surface does not enter, mm.
    pub clearance_mm: f64,
    /// True if the point lies inside the model.
    pub inside: bool,
    /// Token of the nearest triangle, which speeds up queries nearby.
    pub hint: u32,
}

impl Sample {
    /// Returns a sample of a function that knows no model.
    pub fn plain(value: f64, gradient: Vector) -> Self {
        Self {
            value,
            gradient,
            clearance_mm: 0.0,
            inside: false,
            hint: NO_HINT,
        }
    }

    /// Returns whether the point belongs to the region.
    #[inline]
    pub fn is_positive(&self) -> bool {
        self.value > 0.0
    }
}

/// A point with its sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Known {
    /// The point.
    pub at: Point,
    /// The sample taken there.
    pub sample: Sample,
}

/// Returns the triangle nearest to a point; the hints of points nearby save time. `None` if there
/// are no triangles.
pub(super) fn nearest(surface: &Bvh, p: &Point, nearby: &[Known]) -> Option<Nearest> {
    let mut hints = [NO_HINT; 2];
    let known = hints.iter_mut().zip(nearby);
    known.for_each(|(hint, known)| *hint = known.sample.hint);
    surface.closest(p, f64::INFINITY, &hints)
}

/// A continuous function whose positive region is bounded by triangles.
pub(super) trait Field: Sync {
    /// Returns the function at `p`. Samples from nearby save time.
    fn sample(&self, p: &Point, nearby: &[Known]) -> Sample;

    /// Returns whether the ball about a sampled point certainly holds no zero of the function.
    fn is_free(&self, center: &Known, radius_mm: f64) -> bool;

    /// Returns whether the function falls and rises along its gradient by as much as the way.
    /// Gradients then lead to its zeros.
    fn is_distance(&self) -> bool {
        false
    }

    /// Returns whether a cell that may hold the surface must be divided, whatever its triangles are
    /// like.
    fn is_too_coarse(&self, center: &Known, size_mm: f64) -> bool;

    /// Returns whether the surface must be within tolerance in this ball. Elsewhere any closed
    /// surface will do.
    fn matters(&self, center: &Point, radius_mm: f64) -> bool;
}

/// Cell sizes and tolerances of a drawn surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Resolution {
    /// Smallest cell, mm.
    pub finest_mm: f64,
    /// Smallest cell at sharp outward creases, mm.
    pub crease_mm: f64,
    /// Largest distance of a chord outside the region, mm.
    pub outside_mm: f64,
    /// Largest distance of a chord inside the region, mm.
    pub inside_mm: f64,
}
