//! A density that depends on the depth below the surface, from skin to core.

use std::sync::Arc;

use super::density::{Density, Form, OfDepth};
use crate::geom::{Aabb, Point};
use crate::mesh::{MeshDistance, Solid};

/// The fall of the density with the depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Falls along a line, and reaches the lower density at the given depth.
    Linear,
    /// Falls as exp(−(depth/σ)²/2), with the given depth as σ.
    Gauss,
}

/// Depth in σ from which a Gaussian counts as zero: there it is below 1e-14.
const GAUSS_ENDS: f64 = 8.0;

/// A density that falls from the surface inward.
///
/// Its kinks are the medial axis and, for a line, the depth at which it ends. They are not planes,
/// so the integral is over the cells of an octree, and its error is told. It is over the skin's own
/// solid, whatever mesh is measured.
#[derive(Debug, Clone)]
pub struct Skin {
    surface: Arc<MeshDistance>,
    depth_mm: f64,
    profile: Profile,
    densities: [f64; 2],
}

impl Skin {
    /// Returns the density of a solid that falls from the second of the `densities` at its surface
    /// to the first inside. `None` unless the depth is positive and all numbers are finite.
    pub fn new(
        solid: &Solid,
        depth_mm: f64,
        profile: Profile,
        densities: [f64; 2],
    ) -> Option<Self> {
        let is_finite = densities.iter().all(|density| density.is_finite());
        (is_finite && depth_mm.is_finite() && depth_mm > 0.0).then(|| Self {
            surface: Arc::new(MeshDistance::new(solid.mesh())),
            depth_mm,
            profile,
            densities,
        })
    }
}

impl OfDepth for Skin {
    fn depth_mm(&self, point: &Point) -> f64 {
        self.surface.signed(point)
    }

    fn of_depth(&self, depth_mm: f64) -> f64 {
        let depth = depth_mm / self.depth_mm;
        let share = match self.profile {
            Profile::Linear => 1.0 - depth.min(1.0),
            Profile::Gauss => (-0.5 * depth * depth).exp(),
        };
        let [core, surface] = self.densities;
        core + (surface - core) * share
    }

    fn constant_from_mm(&self) -> f64 {
        match self.profile {
            Profile::Linear => self.depth_mm,
            Profile::Gauss => GAUSS_ENDS * self.depth_mm,
        }
    }
}

impl Density for Skin {
    fn at(&self, point: &Point) -> f64 {
        self.of_depth(self.depth_mm(point).abs())
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        // The depth changes by no more than the way, and the density falls or rises with it.
        let middle_mm = self.depth_mm(&region.center()).abs();
        let reach_mm = 0.5 * region.size().norm();
        let ends_mm = [(middle_mm - reach_mm).max(0.0), middle_mm + reach_mm];
        let [one, other] = ends_mm.map(|depth_mm| self.of_depth(depth_mm));
        [f64::min(one, other), f64::max(one, other)]
    }

    fn form(&self) -> Form<'_> {
        Form::Depth(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::geom::Vector;
    use crate::mesh::primitives::cuboid;

    #[test]
    fn bounds_hold_over_a_box_inside_outside_and_across_the_surface() {
        let cube = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let solid = Solid::new(cube).unwrap();
        let mut random = Random::new(5);
        for profile in [Profile::Linear, Profile::Gauss] {
            let skin = Skin::new(&solid, 2.0, profile, [0.2, 0.8]).unwrap();
            for _ in 0..300 {
                let mut at = |low, high| Vector::from_fn(|_, _| random.between(low, high));
                let min = Point::from(at(-3.0, 11.0));
                let size = at(0.1, 2.0);
                let region = Aabb {
                    min,
                    max: min + size,
                };
                let [low, high] = skin.bounds(&region);
                let inside = min + size.component_mul(&at(0.0, 1.0));
                assert!((low - 1e-12..=high + 1e-12).contains(&skin.at(&inside)));
            }
            let deep = Aabb {
                min: Point::new(4.0, 4.0, 4.0),
                max: Point::new(6.0, 6.0, 6.0),
            };
            assert!(skin.bounds(&deep)[1] < 0.5);
        }
    }
}
