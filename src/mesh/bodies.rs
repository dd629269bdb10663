//! Splits a closed mesh into its connected shells and into the bodies that they bound.

use super::{TriMesh, union_find::UnionFind};
use crate::geom::{Bvh, Point};

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

/// Returns the shell that comes nearest to any of some points; `None` without shells. Of equally
/// near ones it is the first.
pub fn nearest_shell<'a>(shells: &'a [TriMesh], points: &[Point]) -> Option<&'a TriMesh> {
    if let [only] = shells {
        return Some(only);
    }
    let distance_mm = |shell: &TriMesh| {
        let surface = Bvh::new(shell.iter_corners());
        points.iter().fold(f64::INFINITY, |least_mm, p| {
            let nearer = surface.closest(p, least_mm, &[]);
            nearer.map_or(least_mm, |nearest| (nearest.point - p).norm().min(least_mm))
        })
    };
    let measured = shells.iter().map(|shell| (distance_mm(shell), shell));
    let nearest = measured.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map(|(_, shell)| shell)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mesh::primitives::ball;

    #[test]
    fn the_nearest_shell_is_the_one_that_any_of_the_points_comes_near() {
        let balls = [0.0, 30.0].map(|x| {
            let ball = ball(&Point::origin(), 10.0, 3);
            ball.map_vertices(|p| p + Vector::x() * x)
        });
        let nearest = |points: &[Point]| {
            let shell = nearest_shell(&balls, points).unwrap();
            balls.iter().position(|ball| ball == shell)
        };
        let [left, between, right] = [9.0, 14.0, 20.5].map(|x| Point::new(x, 0.0, 0.0));
        assert_eq!(nearest(&[left]), Some(0));
        assert_eq!(nearest(&[right, between]), Some(1));
        assert_eq!(nearest(&[between]), Some(0));
        assert_eq!(nearest_shell(&[], &[left]), None);
    }
}
