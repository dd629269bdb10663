//! A density that depends on the depth below the surface, from skin to core.

use super::density::{Density, Form};
use crate::geom::{Aabb, Point};
use crate::mesh::Solid;

/// The fall of the density with the depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Falls along a line, and reaches the lower density at the given depth.
    Linear,
    /// Falls as exp(−(depth/σ)²/2), with the given depth as σ.
    Gauss,
}

/// A density that falls from the surface inward.
///
/// Its kinks are the medial axis and, for a line, the depth at which it ends. They are not planes,
/// so the integral is by pieces, and its error is told.
#[derive(Debug, Clone)]
pub struct Skin {
    solid: Solid,
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
            solid: solid.clone(),
            depth_mm,
            profile,
            densities,
        })
    }

    /// Returns the distance to the surface, mm.
    fn depth_mm(&self, point: &Point) -> f64 {
        let nearest = self.solid.bvh().closest(point, f64::INFINITY, &[]);
        nearest.map_or(0.0, |nearest| nearest.distance_squared.sqrt())
    }
}

impl Density for Skin {
    fn at(&self, point: &Point) -> f64 {
        let depth = self.depth_mm(point) / self.depth_mm;
        let share = match self.profile {
            Profile::Linear => 1.0 - depth.min(1.0),
            Profile::Gauss => (-0.5 * depth * depth).exp(),
        };
        let [core, surface] = self.densities;
        core + (surface - core) * share
    }

    fn bounds(&self, _: &Aabb) -> [f64; 2] {
        let [one, other] = self.densities;
        [f64::min(one, other), f64::max(one, other)]
    }

    fn form(&self) -> Form<'_> {
        Form::Any { kinks: Vec::new() }
    }
}
