//! Splits a closed mesh into its connected shells and into the bodies that they bound.

use super::{TriMesh, union_find::UnionFind};
use crate::geom::Point;

/// Returns the connected shells of `mesh`, in the order of their first triangles.
///
/// Vertices and triangles keep their order. Vertices that no triangle names are dropped. Two shells
/// that touch in a vertex without sharing its index are two shells.
pub fn shells(mesh: &TriMesh) -> Vec<TriMesh> {
    let shell_of = shell_of_vertices(mesh);
    let mut shells = Vec::new();
    let mut place = vec![usize::MAX; mesh.vertices().len()];
    let mut parts: Vec<Vec<[u32; 3]>> = Vec::new();
    for &triangle in mesh.triangles() {
        let root = shell_of[triangle[0] as usize] as usize;
        if place[root] == usize::MAX {
            place[root] = parts.len();
            parts.push(Vec::new());
        }
        parts[place[root]].push(triangle);
    }
    let mut new_index = vec![u32::MAX; mesh.vertices().len()];
    for triangles in parts {
        shells.push(extract(mesh, triangles, &mut new_index));
    }
    shells
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

/// Returns some of `mesh`'s triangles as a mesh with only the vertices they name.
///
/// `new_index` is scratch space, `u32::MAX` for every vertex not yet met.
fn extract(mesh: &TriMesh, mut triangles: Vec<[u32; 3]>, new_index: &mut [u32]) -> TriMesh {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    for (new, &old) in used.iter().enumerate() {
        new_index[old as usize] = new as u32;
    }
    for corner in triangles.iter_mut().flatten() {
        *corner = new_index[*corner as usize];
    }
    let vertices = used.iter().map(|&v| mesh.vertices()[v as usize]).collect();
    TriMesh::new(vertices, triangles).unwrap_or_default()
}
