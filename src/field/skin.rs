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

    fn bounds(&self, _: &Aabb) -> [f64; 2] {
        let [one, other] = self.densities;
        [f64::min(one, other), f64::max(one, other)]
    }

    fn form(&self) -> Form<'_> {
        Form::Depth(self)
    }
}
