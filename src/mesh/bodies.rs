//! Splits a closed mesh into its connected shells and into the bodies that they bound.

use super::{TriMesh, union_find::UnionFind};
use crate::geom::Point;

/// Returns the connected shells of `mesh`, in the order of their first triangles.
///
/// Vertices and triangles keep their order. Vertices that no triangle names are dropped. Two shells
/// that touch in a vertex without sharing its index are two shells.
pub fn shells(mesh: &TriMesh) -> Vec<TriMesh> {
    const NONE: u32 = u32::MAX;
    let mut shell_of = shell_of_vertices(mesh);
    let mut rank = vec![NONE; mesh.vertices().len()];
    let mut parts: Vec<(Vec<Point>, Vec<[u32; 3]>)> = Vec::new();
    for triangle in mesh.triangles() {
        let root = shell_of[triangle[0] as usize] as usize;
        if rank[root] == NONE {
            rank[root] = parts.len() as u32;
            parts.push(Default::default());
        }
    }
    let mut new_index = vec![NONE; mesh.vertices().len()];
    for (vertex, shell) in shell_of.iter_mut().enumerate() {
        *shell = rank[*shell as usize];
        if *shell != NONE {
            let vertices = &mut parts[*shell as usize].0;
            new_index[vertex] = vertices.len() as u32;
            vertices.push(mesh.vertices()[vertex]);
        }
    }
    for triangle in mesh.triangles() {
        let shell = shell_of[triangle[0] as usize] as usize;
        parts[shell].1.push(triangle.map(|v| new_index[v as usize]));
    }
    let parts = parts.into_iter();
    parts
        .map(|(vertices, triangles)| TriMesh::from_parts(vertices, triangles))
        .collect()
}

/// Returns the bodies that a closed, oriented mesh bounds, in the order of their outward shells.
///
/// A body is an outward shell together with the inward shells (cavities) directly inside it. An
/// inward shell in no body is dropped.
///
/// The cost is linear in the triangles for each pair of an inward and an outward shell.
pub fn bodies(mesh: &TriMesh) -> Vec<TriMesh> {
    let (outward, inward): (Vec<_>, Vec<_>) = shells(mesh)
        .into_iter()
        .map(|s| (s.signed_volume_mm3(), s))
        .partition(|(volume, _)| *volume > 0.0);
    let mut bodies: Vec<TriMesh> = outward.iter().map(|(_, shell)| shell.clone()).collect();
    for (_, cavity) in &inward {
        let holder = (0..outward.len())
            .filter(|&i| winding_number(&outward[i].1, &cavity.vertices()[0]).abs() > 0.5)
            .min_by(|&i, &j| outward[i].0.total_cmp(&outward[j].0));
        if let Some(i) = holder {
            bodies[i] = std::mem::take(&mut bodies[i]).joined(cavity);
        }
    }
    bodies
}

/// Returns the winding number of a closed mesh around `point`: 1 inside an outward shell, 0
/// outside.
///
/// Accurate to rounding for a point off the surface (van Oosterom and Strackee, "The solid angle of
/// a plane triangle", IEEE TBME 30, 1983).
pub fn winding_number(mesh: &TriMesh, point: &Point) -> f64 {
    let solid_angle: f64 = mesh
        .iter_corners()
        .map(|corners| half_solid_angle(corners, point))
        .sum();
    solid_angle / (2.0 * std::f64::consts::PI)
}

/// Returns half the signed solid angle of a triangle seen from `point`.
fn half_solid_angle(corners: [Point; 3], point: &Point) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - point);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let determinant = a.dot(&b.cross(&c));
    determinant.atan2(la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb)
}

/// Returns, for each vertex, the smallest vertex index of its shell.
fn shell_of_vertices(mesh: &TriMesh) -> Vec<u32> {
    let count = mesh.vertices().len();
    let mut sets = UnionFind::new(count);
    for &[a, b, c] in mesh.triangles() {
        sets.merge(a, b);
        sets.merge(b, c);
    }
    (0..count as u32).map(|v| sets.root(v)).collect()
}
