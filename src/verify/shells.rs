//! The shells of a surface: its connected pieces by orientation, and the wall between them.

use std::collections::BTreeMap;

use crate::base::watch::{Cancelled, Watch};
use crate::mass::moments_of_mesh;
use crate::mesh::{MeshDistance, TriMesh};

/// The shells of a surface: outward ones bound material, inward ones bound air.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shells {
    /// Shells of positive volume, in the order of their first triangle.
    pub outward: Vec<TriMesh>,
    /// Shells of negative volume (cavities), in the order of their first triangle.
    pub inward: Vec<TriMesh>,
}

impl Shells {
    /// Splits a mesh into pieces connected through shared edges. Pieces that meet in a single
    /// vertex stay apart, so a cavity that touches the outside in a point still counts as a cavity.
    pub fn of_mesh(mesh: &TriMesh) -> Self {
        let (outward, inward) = connected_pieces(mesh)
            .into_iter()
            .partition(|piece| moments_of_mesh(piece).volume() > 0.0);
        Self { outward, inward }
    }

    /// Returns the outer surface alone.
    pub fn outer_mesh(&self) -> TriMesh {
        join(&self.outward)
    }

    /// Returns the cavities alone, still turned inward.
    pub fn inner_mesh(&self) -> TriMesh {
        join(&self.inward)
    }

    /// Returns the smallest wall between the cavities and the outer surface, mm, or `None` if there
    /// is no cavity. It is the distance between triangles, not between samples.
    ///
    /// A cavity of the model itself counts as a void; one that pierces the outside gives 0.
    pub fn smallest_wall_mm(&self, watch: &Watch) -> Result<Option<f64>, Cancelled> {
        if self.inward.is_empty() || self.outward.is_empty() {
            return Ok(None);
        }
        watch.check()?;
        let outside = MeshDistance::new(&self.outer_mesh());
        watch.check()?;
        Ok(Some(outside.min_distance_to(&self.inner_mesh())))
    }
}

/// Returns all meshes side by side.
fn join(meshes: &[TriMesh]) -> TriMesh {
    meshes.iter().fold(TriMesh::default(), TriMesh::joined)
}

/// Returns the pieces of a mesh that are connected through shared edges, each with its own
/// vertices.
pub(super) fn connected_pieces(mesh: &TriMesh) -> Vec<TriMesh> {
    let mut groups: BTreeMap<u32, Vec<[u32; 3]>> = BTreeMap::new();
    for (&triangle, root) in mesh.triangles().iter().zip(roots(mesh)) {
        groups.entry(root).or_default().push(triangle);
    }
    groups
        .into_values()
        .map(|triangles| extract(mesh, &triangles))
        .collect()
}

/// Returns for each triangle the least triangle it is connected to.
fn roots(mesh: &TriMesh) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
    let mut sides = sides_of(mesh);
    sides.sort_unstable();
    for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let (a, b) = (find(&mut parent, pair[0].1), find(&mut parent, pair[1].1));
        parent[a.max(b) as usize] = a.min(b);
    }
    (0..parent.len() as u32)
        .map(|triangle| find(&mut parent, triangle))
        .collect()
}

/// Returns every side of every triangle with the triangle, its vertices ascending.
fn sides_of(mesh: &TriMesh) -> Vec<([u32; 2], u32)> {
    let sides = |(index, &[a, b, c]): (usize, &[u32; 3])| {
        [[a, b], [b, c], [c, a]].map(|[from, to]| ([from.min(to), from.max(to)], index as u32))
    };
    mesh.triangles()
        .iter()
        .enumerate()
        .flat_map(sides)
        .collect()
}

/// Returns the root of a triangle and halves the path to it (Tarjan and van Leeuwen 1984).
fn find(parent: &mut [u32], mut triangle: u32) -> u32 {
    while parent[triangle as usize] != triangle {
        let grandparent = parent[parent[triangle as usize] as usize];
        parent[triangle as usize] = grandparent;
        triangle = grandparent;
    }
    triangle
}

/// Returns some triangles of a mesh as a mesh with only the vertices they use.
fn extract(mesh: &TriMesh, triangles: &[[u32; 3]]) -> TriMesh {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let renumbered = |v: u32| used.partition_point(|&u| u < v) as u32;
    let vertices = used.iter().map(|&v| mesh.vertices()[v as usize]).collect();
    let triangles = triangles.iter().map(|t| t.map(renumbered)).collect();
    TriMesh::new(vertices, triangles).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::verify::test_meshes::block;

    fn box_with_a_cavity() -> TriMesh {
        let cavity = block(Point::new(1.0, 1.0, 1.0), [1.0, 1.0, 1.0]).reversed();
        block(Point::origin(), [3.0, 3.0, 3.0]).joined(&cavity)
    }

    #[test]
    fn a_box_with_a_cavity_has_one_shell_each_way() {
        let shells = Shells::of_mesh(&box_with_a_cavity());
        assert_eq!((shells.outward.len(), shells.inward.len()), (1, 1));
        assert_eq!(moments_of_mesh(&shells.outer_mesh()).volume(), 27.0);
        assert_eq!(moments_of_mesh(&shells.inner_mesh()).volume(), -1.0);
    }

    #[test]
    fn a_cavity_that_touches_the_outside_in_one_vertex_is_still_a_cavity() {
        // Both blocks use vertex 0: the cavity's corner is the box's corner.
        let outer = block(Point::origin(), [3.0, 3.0, 3.0]);
        let cavity = block(Point::origin(), [1.0, 1.0, 1.0]).reversed();
        let joined = outer.clone().joined(&cavity);
        let first_of_cavity = outer.vertices().len() as u32;
        let triangles = joined
            .triangles()
            .iter()
            .map(|t| t.map(|v| if v == first_of_cavity { 0 } else { v }))
            .collect();
        let touching = TriMesh::new(joined.vertices().to_vec(), triangles).unwrap();
        assert_eq!(Shells::of_mesh(&touching).inward.len(), 1);
    }

    #[test]
    fn nothing_has_no_shells() {
        assert_eq!(Shells::of_mesh(&TriMesh::default()), Shells::default());
    }
}
