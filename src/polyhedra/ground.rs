//! A model made ready: rounded as its file is, with its distances and its pieces.

use super::obstacles::Obstacles;
use crate::mesh::{Defects, MeshDistance, Solid};

/// The longest edge of a piece over the size of the model.
///
/// Longer pieces keep polyhedra small beside large facets; shorter ones cost time.
const LONGEST_EDGE_RATIO: f64 = 1.0 / 25.0;

/// A model in which polyhedra grow.
///
/// Its corners are rounded to single precision, so that what is proved of it holds for its file.
#[derive(Debug, Clone)]
pub struct Ground {
    solid: Solid,
    distance: MeshDistance,
    obstacles: Obstacles,
    volume_mm3: f64,
}

impl Ground {
    /// Rounds a model and prepares it; fails if the rounded surface bounds no solid.
    ///
    /// The surface must not cross itself: distances would have the wrong sign. Takes some 50 ms
    /// for 10 000 triangles.
    pub fn new(solid: &Solid) -> Result<Self, Defects> {
        let mesh = solid.mesh();
        let solid = Solid::new(mesh.map_vertices(|p| p.map(|x| f64::from(x as f32))))?;
        let mesh = solid.mesh();
        Ok(Self {
            distance: MeshDistance::new(mesh),
            obstacles: Obstacles::of_mesh(mesh, LONGEST_EDGE_RATIO * mesh.longest_side_mm()),
            volume_mm3: mesh.signed_volume_mm3(),
            solid,
        })
    }

    /// Returns the rounded model.
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Returns the distances from the surface.
    pub fn distance(&self) -> &MeshDistance {
        &self.distance
    }

    /// Returns the pieces of the surface.
    pub fn obstacles(&self) -> &Obstacles {
        &self.obstacles
    }

    /// Returns the volume, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.volume_mm3
    }
}
