//! The shells of a surface: its connected pieces by orientation.

use crate::mass::moments_of_mesh;
use crate::mesh::TriMesh;
use crate::mesh::edges::EdgeTable;

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
}

/// Returns all meshes side by side.
fn join(meshes: &[TriMesh]) -> TriMesh {
    meshes.iter().fold(TriMesh::default(), TriMesh::joined)
}

/// Returns the pieces of a mesh that are connected through shared edges, each with its own
/// vertices.
pub(super) fn connected_pieces(mesh: &TriMesh) -> Vec<TriMesh> {
    let roots = roots(mesh);
    let mut groups: Vec<Vec<[u32; 3]>> = Vec::new();
    let mut group_of = vec![0; roots.len()];
    for (index, (&triangle, root)) in mesh.triangles().iter().zip(roots).enumerate() {
        // A root is the first triangle of its group.
        let root = root as usize;
        if root == index {
            group_of[index] = groups.len();
            groups.push(Vec::new());
        }
        groups[group_of[root]].push(triangle);
    }
    let mut numbers = vec![0; mesh.vertices().len()];
    let groups = groups.into_iter();
    groups
        .map(|triangles| extract(mesh, triangles, &mut numbers))
        .collect()
}

/// Returns for each triangle the least triangle it is connected to.
fn roots(mesh: &TriMesh) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
    let table = EdgeTable::of(mesh);
    for pair in table.edges().flat_map(|sides| sides.windows(2)) {
        let [a, b] = [&pair[0], &pair[1]].map(|side| find(&mut parent, side.triangle() as u32));
        parent[a.max(b) as usize] = a.min(b);
    }
    (0..parent.len() as u32)
        .map(|triangle| find(&mut parent, triangle))
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

/// Returns some triangles of a mesh as a mesh with only the vertices they use. `numbers` is room
/// for a number for each vertex.
fn extract(mesh: &TriMesh, triangles: Vec<[u32; 3]>, numbers: &mut [u32]) -> TriMesh {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    for (number, &v) in used.iter().enumerate() {
        numbers[v as usize] = number as u32;
    }
    let vertices = used.iter().map(|&v| mesh.vertices()[v as usize]).collect();
    let triangles = triangles
        .into_iter()
        .map(|t| t.map(|v| numbers[v as usize]))
        .collect();
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
