//! The space around which triangles of any kind wind, as a function: positive where the generalised
//! winding number is above one half.

use super::field::{Field, Known, Sample, nearest};
use crate::geom::{Bvh, Point, Vector};
use crate::mesh::WindingNumbers;

/// The winding number that separates inside from outside.
const LEVEL: f64 = 0.5;

/// Slope of the function where the winding number leaves the level, in distances to the triangles.
/// Two would make it the distance on a closed surface, but for the error of the winding number; a
/// little more takes that up.
const SLOPE: f64 = 2.2;

/// Ratio of the function to the radius of a ball that certainly holds no zero. In a ball without
/// triangles the winding number is harmonic. If it lies between 0 and 1, it changes by
/// less than 1.05 times the share of the radius. That holds up to one half of the radius.
const FREE_RATIO: f64 = 2.4;

/// Share of the sum of two empty balls' radii below which the balls certainly overlap. Balls on
/// both sides of a surface may touch, and rounding must not join them.
const OVERLAP_RATIO: f64 = 1.0 - 1e-6;

/// Step for the slope of the winding number, as a share of the distance to the triangles.
const STEP_RATIO: f64 = 0.02;

/// The distance to the nearest triangle, times how surely the point is inside or outside.
///
/// Zero on triangles that separate inside from outside, and on the membranes that the winding
/// number draws across holes.
pub(super) struct SoupField<'a> {
    /// The triangles.
    pub surface: &'a Bvh,
    /// Their winding numbers.
    pub winding: &'a WindingNumbers,
    /// True if the triangles form a closed, oriented surface: the winding number is the same all
    /// over a ball that no triangle enters.
    pub is_closed: bool,
    /// Largest cell that may hold the surface, mm.
    pub coarse_mm: f64,
    /// Smallest cell that is divided because its triangles are bent, mm.
    pub usual_mm: f64,
}

impl SoupField<'_> {
    /// Returns whether a point is inside if a point nearby, whose empty ball overlaps that of the
    /// point, tells it of a closed surface.
    fn known_side(&self, p: &Point, distance_mm: f64, nearby: &[Known]) -> Option<bool> {
        let reach_mm = |known: &Known| (known.sample.clearance_mm + distance_mm) * OVERLAP_RATIO;
        let overlaps = |known: &&Known| (known.at - p).norm() < reach_mm(known);
        let known = nearby.iter().filter(|_| self.is_closed).find(overlaps)?;
        Some(known.sample.inside)
    }

    /// Returns the direction in which the winding number grows; zero if there is none.
    fn slope(&self, p: &Point, distance_mm: f64) -> Vector {
        let step_mm = STEP_RATIO * distance_mm;
        let slope = Vector::from_fn(|axis, _| {
            let step = Vector::ith(axis, step_mm);
            self.winding.at(&(p + step)) - self.winding.at(&(p - step))
        });
        slope.try_normalize(0.0).unwrap_or_else(Vector::zeros)
    }
}

impl Field for SoupField<'_> {
    fn sample(&self, p: &Point, nearby: &[Known]) -> Sample {
        let Some(nearest) = nearest(self.surface, p, nearby) else {
            return Sample::plain(f64::NEG_INFINITY, Vector::zeros());
        };
        let distance_mm = nearest.distance_squared.sqrt();
        let known = self.known_side(p, distance_mm, nearby);
        let excess = match known {
            Some(true) => LEVEL,
            Some(false) => -LEVEL,
            None if self.is_closed => f64::from(self.surface.winding(p)) - LEVEL,
            None => self.winding.at(p) - LEVEL,
        };
        let inside = excess > 0.0;
        let side = if inside { 1.0 } else { -1.0 };
        let sureness = (SLOPE * excess.abs()).min(1.0);
        let gradient = if sureness < 1.0 {
            self.slope(p, distance_mm)
        } else {
            (p - nearest.point) * (side / distance_mm.max(f64::MIN_POSITIVE))
        };
        Sample {
            value: side * distance_mm * sureness,
            gradient,
            clearance_mm: distance_mm,
            inside,
            hint: nearest.hint,
        }
    }

    fn is_free(&self, center: &Known, radius_mm: f64) -> bool {
        let ratio = if self.is_closed { 1.0 } else { FREE_RATIO };
        center.sample.value.abs() > ratio * radius_mm
    }

    fn is_too_coarse(&self, _center: &Known, size_mm: f64) -> bool {
        size_mm > self.coarse_mm * (1.0 + 1e-9)
    }

    fn matters(&self, _center: &Point, size_mm: f64) -> bool {
        size_mm > self.usual_mm * (1.0 + 1e-9)
    }
}
