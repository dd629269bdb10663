//! The region in which a density is below a value, as a function in model coordinates.

use super::field::{Field, Known, Sample};
use crate::field::Density;
use crate::geom::{Aabb, Bvh, Point, Vector};

/// Distance over which a slope is measured, mm. A kink is rounded by no more.
const STEP_MM: f64 = 1e-4;

/// Largest cell that may hold the surface where that does not matter, in largest cells elsewhere.
const FAR_RATIO: f64 = 4.0;

/// A density, and the value below which it must lie.
#[derive(Debug, Clone, Copy)]
pub struct DensityLevel<'a> {
    /// The density, model coordinates.
    pub density: &'a dyn Density,
    /// The value.
    pub below: f64,
}

/// The value less the density, over the density's slope: near the surface about the distance to it.
///
/// A density may be flat, and its slope may jump. So the distance is bounded, and bounds of the
/// density over boxes tell where there is no surface.
pub(super) struct DensityField<'a> {
    level: DensityLevel<'a>,
    /// Body in which the surface must be drawn within tolerance.
    body: &'a Bvh,
    /// Largest cell that may hold the surface, mm. No distance is told that is greater.
    coarse_mm: f64,
}

impl<'a> DensityField<'a> {
    /// Returns the function of a density, to be drawn in `body`.
    pub fn new(level: DensityLevel<'a>, body: &'a Bvh, coarse_mm: f64) -> Self {
        Self {
            level,
            body,
            coarse_mm,
        }
    }

    /// Returns the slope of the density at a point where it has this value, 1/mm.
    fn slope(&self, p: &Point, value: f64) -> Vector {
        Vector::from_fn(|axis, _| {
            let beside = p + Vector::ith(axis, STEP_MM);
            (self.level.density.at(&beside) - value) / STEP_MM
        })
    }
}

impl Field for DensityField<'_> {
    fn sample(&self, p: &Point, _nearby: &[Known]) -> Sample {
        let value = self.level.density.at(p);
        let lack = self.level.below - value;
        let slope = -self.slope(p, value);
        let steepness = slope.norm();
        if steepness == 0.0 {
            let far_mm = self.coarse_mm.copysign(lack);
            return Sample::plain(if lack == 0.0 { 0.0 } else { far_mm }, slope);
        }
        let distance_mm = (lack / steepness).clamp(-self.coarse_mm, self.coarse_mm);
        Sample::plain(distance_mm, slope / steepness)
    }

    fn is_free(&self, center: &Known, radius_mm: f64) -> bool {
        let region = Aabb::of_points([&center.at]).inflated(radius_mm);
        let [low, high] = self.level.density.bounds(&region);
        low >= self.level.below || high < self.level.below
    }

    fn is_too_coarse(&self, center: &Known, size_mm: f64) -> bool {
        let is_large = |most_mm: f64| size_mm > most_mm * (1.0 + 1e-9);
        is_large(FAR_RATIO * self.coarse_mm)
            || is_large(self.coarse_mm) && self.matters(&center.at, size_mm)
    }

    fn matters(&self, center: &Point, radius_mm: f64) -> bool {
        self.body.closest(center, radius_mm, &[]).is_some() || self.body.winding(center) > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Linear, Ramp};

    #[test]
    fn the_value_of_a_plane_is_the_distance_to_it_and_its_sign_is_right_where_a_ramp_is_flat() {
        let body = Bvh::new(Vec::new());
        let plane = Linear {
            at_origin: 0.2,
            gradient: Vector::new(0.0, 0.0, 0.05),
        };
        let level = DensityLevel {
            density: &plane,
            below: 0.4,
        };
        let field = DensityField::new(level, &body, 2.0);
        for (z, expected) in [(3.5, 0.5), (4.0, 0.0), (5.0, -1.0), (60.0, -2.0)] {
            let sample = field.sample(&Point::new(7.0, -3.0, z), &[]);
            assert!((sample.value - expected).abs() < 1e-9, "{z} {sample:?}");
            assert!(expected == 0.0 || (sample.gradient + Vector::z()).norm() < 1e-9);
        }
        let ramp = Ramp::new(&Vector::z(), [0.0, 1.0], [0.2, 0.6]).unwrap();
        let level = DensityLevel {
            density: &ramp,
            below: 0.4,
        };
        let field = DensityField::new(level, &body, 2.0);
        for (z, value) in [(-9.0, 2.0), (9.0, -2.0)] {
            assert_eq!(field.sample(&Point::new(0.0, 0.0, z), &[]).value, value);
        }
    }
}
