//! Welding: merges vertices at the same or nearly the same place.

use std::collections::HashMap;

use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::mesh::edges::{EdgeKind, EdgeTable};
use crate::mesh::union_find::UnionFind;

/// Merges the vertices whose coordinates are equal numbers (−0.0 equals 0.0; NaN equals its own
/// bits).
///
/// The vertices keep the order of their first appearance and the triangles keep theirs, so a second
/// weld changes nothing. Costs time linear in the vertices. No file makes it slower: nobody can
/// foretell the hashes of the standard library.
#[must_use]
pub fn weld(mesh: &TriMesh) -> TriMesh {
    let mut firsts: HashMap<[u64; 3], u32> = HashMap::with_capacity(mesh.vertices().len());
    let keys = (0..).zip(mesh.vertices().iter().map(place_key));
    let same_as: Vec<u32> = keys
        .map(|(v, key)| *firsts.entry(key).or_insert(v))
        .collect();
    merge_vertices(mesh, &same_as)
}

/// Returns a key that is equal for equal places: the bits of the coordinates, with 0.0 for −0.0.
fn place_key(p: &Point) -> [u64; 3] {
    [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())
}

/// Merges every vertex on an open edge with the first one within `tolerance_mm` of it. Vertices
/// inside a surface stay separate however near they are.
///
/// A chain of near vertices becomes one vertex, so the caller judges the result.
pub(super) fn weld_open_edges(mesh: &TriMesh, tolerance_mm: f64) -> TriMesh {
    let mut sets = UnionFind::new(mesh.vertices().len());
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    for v in rim_vertices(mesh) {
        let place = &mesh.vertices()[v as usize];
        let cell = [place.x, place.y, place.z].map(|x| (x / tolerance_mm).floor() as i64);
        for other in neighbour_cells(cell)
            .iter()
            .filter_map(|near| cells.get(near))
            .flatten()
        {
            if (mesh.vertices()[*other as usize] - place).norm() <= tolerance_mm {
                sets.merge(v, *other);
            }
        }
        cells.entry(cell).or_default().push(v);
    }
    let same_as: Vec<u32> = (0..mesh.vertices().len() as u32)
        .map(|v| sets.root(v))
        .collect();
    merge_vertices(mesh, &same_as)
}

/// Returns the cell and the 26 around it.
fn neighbour_cells([x, y, z]: [i64; 3]) -> [[i64; 3]; 27] {
    std::array::from_fn(|i| {
        let step = |stride: usize| (i / stride % 3) as i64 - 1;
        [
            x.saturating_add(step(1)),
            y.saturating_add(step(3)),
            z.saturating_add(step(9)),
        ]
    })
}

/// Returns the vertices on open edges, ascending.
fn rim_vertices(mesh: &TriMesh) -> Vec<u32> {
    let table = EdgeTable::of(mesh);
    let mut rim: Vec<u32> = table
        .of_kind(EdgeKind::Open)
        .flat_map(|sides| [sides[0].low, sides[0].high])
        .collect();
    rim.sort_unstable();
    rim.dedup();
    rim
}

/// Replaces every vertex v by its representative `same_as[v]` and leaves out the others.
fn merge_vertices(mesh: &TriMesh, same_as: &[u32]) -> TriMesh {
    let mut new_index = vec![0u32; same_as.len()];
    let mut vertices = Vec::with_capacity(same_as.len());
    for (v, &first) in same_as.iter().enumerate() {
        if first as usize == v {
            new_index[v] = vertices.len() as u32;
            vertices.push(mesh.vertices()[v]);
        }
    }
    let triangles = mesh
        .triangles()
        .iter()
        .map(|t| t.map(|v| new_index[same_as[v as usize] as usize]))
        .collect();
    TriMesh::from_parts(vertices, triangles)
}

/// Drops the vertices that no triangle uses; the others keep their order.
pub(super) fn drop_unused_vertices(mesh: TriMesh) -> TriMesh {
    let mut used = vec![false; mesh.vertices().len()];
    mesh.triangles()
        .iter()
        .flatten()
        .for_each(|&v| used[v as usize] = true);
    if used.iter().all(|&u| u) {
        return mesh;
    }
    let mut new_index = vec![0u32; used.len()];
    let mut vertices = Vec::new();
    for (v, _) in used.iter().enumerate().filter(|&(_, &used)| used) {
        new_index[v] = vertices.len() as u32;
        vertices.push(mesh.vertices()[v]);
    }
    let triangles = mesh
        .triangles()
        .iter()
        .map(|t| t.map(|v| new_index[v as usize]))
        .collect();
    TriMesh::from_parts(vertices, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::ball;

    /// Gives every triangle three corners of its own, as an STL file does.
    pub fn soup(mesh: &TriMesh) -> TriMesh {
        let vertices: Vec<Point> = mesh.iter_corners().flatten().collect();
        let triangles = (0..mesh.triangles().len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect();
        TriMesh::new(vertices, triangles).unwrap()
    }

    #[test]
    fn welding_a_soup_gives_the_mesh_back() {
        let mesh = ball(&Point::new(1.0, 2.0, 3.0), 5.0, 2);
        let welded = weld(&soup(&mesh));
        assert_eq!(welded.vertices().len(), mesh.vertices().len());
        let corners = |m: &TriMesh| m.iter_corners().collect::<Vec<_>>();
        assert_eq!(corners(&welded), corners(&mesh));
        assert_eq!(weld(&welded), welded);
    }

    #[test]
    fn minus_zero_and_zero_are_one_place() {
        let at = |x: f64| Point::new(x, 1.0, -x);
        let mesh = TriMesh::new(vec![at(0.0), at(-0.0), at(1.0)], vec![[0, 2, 1]]).unwrap();
        assert_eq!(weld(&mesh).vertices().len(), 2);
    }

    #[test]
    fn only_rims_are_merged() {
        let mesh = ball(&Point::origin(), 1.0, 1);
        assert_eq!(weld_open_edges(&mesh, 10.0), mesh);
        let soup = soup(&mesh)
            .map_vertices(|p| p + crate::geom::Vector::new(1e-9, 0.0, 0.0) * p.y.signum());
        assert_eq!(
            weld_open_edges(&soup, 1e-8).vertices().len(),
            mesh.vertices().len()
        );
    }

    #[test]
    fn unused_vertices_go_and_the_order_stays() {
        let points = (0..5).map(|i| Point::new(f64::from(i), 0.0, 0.0)).collect();
        let mesh = drop_unused_vertices(TriMesh::new(points, vec![[4, 1, 3]]).unwrap());
        assert_eq!(mesh.triangles(), [[2, 0, 1]]);
        assert_eq!(
            mesh.vertices().iter().map(|p| p.x).collect::<Vec<_>>(),
            [1.0, 3.0, 4.0]
        );
    }
}
