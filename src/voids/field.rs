//! What a surface extractor asks of a function whose positive region it bounds.

use crate::geom::{NO_HINT, Point, Vector};

/// The function at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// The value, mm: about the distance to the zero surface where that is near, positive inside
    /// the region.
    pub value: f64,
    /// The direction in which the value grows, unit length (zero where it has none).
    pub gradient: Vector,
    /// The radius of a ball about the point that no surface of the model enters, mm.
    pub clearance_mm: f64,
    /// Whether the point lies inside the model.
    pub inside: bool,
    /// The token of the nearest triangle, for queries nearby.
    pub hint: u32,
}

impl Sample {
    /// A sample of a function that knows no model.
    pub fn plain(value: f64, gradient: Vector) -> Self {
        Self {
            value,
            gradient,
            clearance_mm: 0.0,
            inside: false,
            hint: NO_HINT,
        }
    }

    /// Whether the point belongs to the region.
    pub fn is_positive(&self) -> bool {
        self.value > 0.0
    }
}

/// A point with its sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Known {
    /// Where the sample was taken.
    pub at: Point,
    /// What was found.
    pub sample: Sample,
}

/// A continuous function whose positive region is to be bounded by triangles.
pub(super) trait Field: Sync {
    /// The function at `p`; what is already known nearby saves time.
    fn sample(&self, p: &Point, nearby: &[Known]) -> Sample;

    /// Whether the ball about a sampled point is sure to hold no zero of the function.
    fn is_free(&self, center: &Known, radius_mm: f64) -> bool;

    /// Whether a cell that may hold the surface is too large to be looked at closely, whatever its
    /// triangles.
    fn is_too_coarse(&self, center: &Known, size_mm: f64) -> bool;

    /// Whether the surface must be within tolerance in the ball; elsewhere any closed surface will
    /// do.
    fn matters(&self, center: &Point, radius_mm: f64) -> bool;
}

/// How finely a surface is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Resolution {
    /// The smallest cell, mm.
    pub finest_mm: f64,
    /// The smallest cell at sharp outward creases, mm.
    pub crease_mm: f64,
    /// How far a chord may lie outside the region, mm.
    pub outside_mm: f64,
    /// How far a chord may lie inside the region, mm.
    pub inside_mm: f64,
}
