//! A mesh that is proved to bound a solid.

use std::sync::{Arc, OnceLock};

use super::{Defects, TriMesh};
use crate::geom::Bvh;

/// A mesh that is finite, closed, oriented outward, 2-manifold along edges, and of positive volume.
///
/// Surfaces may still touch at a vertex or cross each other. If a surface crosses itself, volume
/// and moments count the overlap twice; [`super::MeshFacts`] tells.
///
/// Clones share the triangles and what has been prepared of them.
#[derive(Debug, Clone)]
pub struct Solid(Arc<Proved>);

/// The triangles, and what is prepared of them when first asked for.
#[derive(Debug)]
struct Proved {
    mesh: TriMesh,
    bvh: OnceLock<Bvh>,
}

impl Solid {
    /// Checks `mesh` and returns it as a solid, or all its defects. Linear in the triangles: 10
    /// to 20 ms for 100 000.
    pub fn new(mesh: TriMesh) -> Result<Self, Defects> {
        let bvh = OnceLock::new();
        match Defects::of(&mesh) {
            None => Ok(Self(Arc::new(Proved { mesh, bvh }))),
            Some(defects) => Err(defects),
        }
    }

    /// Returns the triangles.
    pub fn mesh(&self) -> &TriMesh {
        &self.0.mesh
    }

    /// Returns the tree over the triangles. It is built when first asked for and kept.
    pub fn bvh(&self) -> &Bvh {
        if let Some(known) = self.0.bvh.get() {
            return known;
        }
        // Built outside the lock: while a thread waits for others at the build, it may take up work
        // that asks for the same tree.
        let built = Bvh::new(self.mesh().iter_corners());
        self.0.bvh.get_or_init(|| built)
    }

    /// Returns the triangles and gives up the proof.
    pub fn into_mesh(self) -> TriMesh {
        Arc::try_unwrap(self.0).map_or_else(|shared| shared.mesh.clone(), |proved| proved.mesh)
    }
}

impl PartialEq for Solid {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.mesh() == other.mesh()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{geom::Point, mesh::primitives};

    #[test]
    fn clones_share_the_triangles_and_the_tree() {
        let solid = Solid::new(primitives::ball(&Point::origin(), 10.0, 2)).unwrap();
        let clone = solid.clone();
        assert!(std::ptr::eq(solid.bvh(), clone.bvh()));
        assert_eq!(solid.bvh().len(), solid.mesh().triangles().len());
        assert_eq!(solid, clone);
        let mesh = solid.mesh().clone();
        assert_eq!(solid.into_mesh(), mesh);
        assert_eq!(clone, Solid::new(mesh.clone()).unwrap());
        assert_eq!(clone.into_mesh(), mesh);
    }
}
