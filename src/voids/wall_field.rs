//! The region that may be emptied, as a function: positive inside the model, deeper than the wall
//! and outside the keeps.

use super::field::{Field, Known, Sample, nearest};
use crate::geom::triangle::closest_on_segment;
use crate::geom::{Bvh, Point, Vector};
use crate::shell::Keep;

/// Share of the sum of two empty balls' radii below which the balls certainly overlap. Balls on
/// both sides of a surface may touch, and rounding must not join them.
const OVERLAP_RATIO: f64 = 1.0 - 1e-6;

/// min(d − iso, distance to every keep − its radius), with d the distance to the model's surface,
/// positive inside.
///
/// 1-Lipschitz. Winding numbers tell inside from outside, so the sign is also right for meshes that
/// overlap themselves.
pub(super) struct WallField<'a> {
    /// Triangles of the model.
    pub surface: &'a Bvh,
    /// Regions besides the wall that stay solid.
    pub keeps: &'a [Keep],
    /// Distance at which the surface is drawn, mm: the wall and a little.
    pub iso_mm: f64,
    /// Extra radius of the keeps as drawn, mm.
    pub keep_margin_mm: f64,
    /// Largest cell that may hold the surface, mm.
    pub coarse_mm: f64,
}

impl WallField<'_> {
    /// Returns whether `p`, at distance `clearance_mm` from the surface, is inside. A nearby point
    /// whose empty ball overlaps that of `p` is on the same side; without one, a ray decides.
    fn is_inside(&self, p: &Point, clearance_mm: f64, nearby: &[Known]) -> bool {
        let reach = |k: &Known| (k.sample.clearance_mm + clearance_mm) * OVERLAP_RATIO;
        let overlaps = |k: &&Known| (k.at - p).norm() < reach(k);
        match nearby.iter().find(overlaps) {
            Some(known) => known.sample.inside,
            None => self.surface.winding(p) > 0,
        }
    }

    /// Returns the value and gradient that the keeps alone would give; `None` without keeps.
    fn keep_value(&self, p: &Point) -> Option<(f64, Vector)> {
        let value = |keep: &Keep| {
            let offset = p - closest_on_segment(p, &keep.from, &keep.to);
            let distance = offset.norm();
            (
                distance - keep.radius_mm - self.keep_margin_mm,
                offset / distance.max(f64::MIN_POSITIVE),
            )
        };
        self.keeps
            .iter()
            .map(value)
            .min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

impl Field for WallField<'_> {
    fn sample(&self, p: &Point, nearby: &[Known]) -> Sample {
        let Some(nearest) = nearest(self.surface, p, nearby) else {
            return Sample::plain(f64::NEG_INFINITY, Vector::zeros());
        };
        let clearance_mm = nearest.distance_squared.sqrt();
        let inside = self.is_inside(p, clearance_mm, nearby);
        let side = if inside { 1.0 } else { -1.0 };
        let direction = (p - nearest.point) / clearance_mm.max(f64::MIN_POSITIVE);
        let wall = (side * clearance_mm - self.iso_mm, direction * side);
        let (value, gradient) = match self.keep_value(p) {
            Some(keep) if keep.0 < wall.0 => keep,
            _ => wall,
        };
        Sample {
            value,
            gradient,
            clearance_mm,
            inside,
            hint: nearest.hint,
        }
    }

    fn is_free(&self, center: &Known, radius_mm: f64) -> bool {
        center.sample.value.abs() > radius_mm
    }

    fn is_distance(&self) -> bool {
        true
    }

    fn is_too_coarse(&self, _center: &Known, size_mm: f64) -> bool {
        size_mm > self.coarse_mm * (1.0 + 1e-9)
    }

    fn matters(&self, _center: &Point, _radius_mm: f64) -> bool {
        true
    }
}
