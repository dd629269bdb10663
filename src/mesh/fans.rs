//! Fans, the connected triangles around a vertex, and pinch vertices, in which several fans meet.

use super::TriMesh;
use super::edges::{EdgeKind, EdgeTable, Side, edge_kind};
use super::union_find::UnionFind;

/// The fan of each triangle corner.
#[derive(Debug, Clone)]
pub(crate) struct Fans {
    /// The fan of corner 3 · triangle + corner.
    of_corner: Vec<u32>,
    /// Number of fans.
    count: usize,
}

impl Fans {
    /// Finds the fans of `mesh`. Two corners are in one fan if their triangles share an edge at
    /// the vertex.
    ///
    /// All triangles at an edge of three or more count as neighbours.
    pub fn of(mesh: &TriMesh, table: &EdgeTable) -> Self {
        let sound = table
            .edges()
            .filter(|sides| edge_kind(sides) != EdgeKind::Collapsed);
        Self::of_pairs(
            mesh,
            sound.flat_map(|sides| sides.windows(2).map(|pair| [pair[0], pair[1]])),
        )
    }

    /// Finds the fans of `mesh` if only these pairs of sides count as joined.
    pub fn of_pairs(mesh: &TriMesh, pairs: impl Iterator<Item = [Side; 2]>) -> Self {
        let mut sets = UnionFind::new(mesh.triangles().len() * 3);
        for [a, b] in pairs {
            for (one, other) in a.corners().into_iter().zip(b.corners()) {
                sets.merge(one, other);
            }
        }
        let (of_corner, count) = sets.labels();
        Self { of_corner, count }
    }

    /// Returns the number of fans: the vertex count of the mesh once its pinches are split.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the vertices in which more than one fan meets, ascending.
    pub fn pinches(&self, mesh: &TriMesh) -> Vec<u32> {
        let mut first_fan = vec![u32::MAX; mesh.vertices().len()];
        let mut pinched = Vec::new();
        for (&v, &fan) in mesh.triangles().iter().flatten().zip(&self.of_corner) {
            let first = &mut first_fan[v as usize];
            if *first == u32::MAX {
                *first = fan;
            } else if *first != fan {
                pinched.push(v);
            }
        }
        pinched.sort_unstable();
        pinched.dedup();
        pinched
    }

    /// Splits every pinch vertex into one vertex for each fan, at the same place. Drops the
    /// vertices that no triangle uses.
    pub fn split(&self, mesh: &TriMesh) -> TriMesh {
        let mut vertices = vec![Default::default(); self.count];
        for (&v, &fan) in mesh.triangles().iter().flatten().zip(&self.of_corner) {
            vertices[fan as usize] = mesh.vertices()[v as usize];
        }
        let triangles = self
            .of_corner
            .chunks_exact(3)
            .map(|fans| [fans[0], fans[1], fans[2]])
            .collect();
        TriMesh::from_parts(vertices, triangles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::mesh::primitives::cuboid;
    use crate::repair::weld;

    fn fans(mesh: &TriMesh) -> Fans {
        Fans::of(mesh, &EdgeTable::of(mesh))
    }

    #[test]
    fn two_boxes_that_touch_at_a_corner_pinch_there_and_can_be_split() {
        let cube = cuboid(&Point::origin(), &Point::new(1.0, 1.0, 1.0));
        let other = cube.map_vertices(|p| p + Vector::new(1.0, 1.0, 1.0));
        let touching = weld(&cube.clone().joined(&other));
        assert_eq!(touching.vertices().len(), 15);
        let pinches = fans(&touching).pinches(&touching);
        assert_eq!(pinches.len(), 1);
        assert_eq!(
            touching.vertices()[pinches[0] as usize],
            Point::new(1.0, 1.0, 1.0)
        );
        let split = fans(&touching).split(&touching);
        assert_eq!(split.vertices().len(), 16);
        assert!(fans(&split).pinches(&split).is_empty());
        assert_eq!(split.signed_volume_mm3(), 2.0);
    }

    #[test]
    fn a_sound_mesh_has_as_many_fans_as_vertices() {
        let cube = cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0));
        assert_eq!(fans(&cube).count(), 8);
        assert!(fans(&cube).pinches(&cube).is_empty());
    }
}
