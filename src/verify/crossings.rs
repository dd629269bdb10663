//! Where a surface passes through itself.

use rayon::prelude::*;
use robust::{Coord3D, orient3d};

use super::box_tree::BoxTree;
use crate::geom::{Aabb, Point};
use crate::mesh::TriMesh;

/// The pairs of triangles (i < j) of which an edge of one pierces the other, ascending.
///
/// Piercing is strict and decided exactly (adaptive predicates: Shewchuk 1997), so triangles that only touch, as
/// neighbours do, are not counted, and neither are two that lie in one plane. About 1 s for 200 000 triangles on
/// one core.
pub fn crossings(mesh: &TriMesh) -> Vec<[u32; 2]> {
    let boxes: Vec<Aabb> = mesh.iter_corners().map(|corners| Aabb::of_points(&corners)).collect();
    let tree = BoxTree::new(&boxes);
    let count = boxes.len() as u32;
    (0..count)
        .into_par_iter()
        .flat_map_iter(|i| crossings_of(mesh, i, tree.overlapping(&boxes[i as usize])))
        .collect()
}

/// The pairs of triangle `i` with those of the `candidates` that come after it.
fn crossings_of(mesh: &TriMesh, i: u32, candidates: Vec<u32>) -> impl Iterator<Item = [u32; 2]> + '_ {
    candidates
        .into_iter()
        .filter(move |&j| j > i && (pierces(mesh, i, j) || pierces(mesh, j, i)))
        .map(move |j| [i, j])
}

/// Whether an edge of triangle `i` passes strictly through the inside of triangle `j`.
fn pierces(mesh: &TriMesh, i: u32, j: u32) -> bool {
    let (edges_of, target) = (mesh.triangles()[i as usize], mesh.triangles()[j as usize]);
    let side = edges_of.map(|v| if target.contains(&v) { 0.0 } else { side_of(mesh, target, v) });
    [(0, 1), (1, 2), (2, 0)].into_iter().any(|(from, to)| {
        opposite(side[from], side[to]) && runs_through(mesh, [edges_of[from], edges_of[to]], target)
    })
}

/// Whether two signed distances are strictly on opposite sides.
fn opposite(a: f64, b: f64) -> bool {
    (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)
}

/// On which side of the plane of a triangle vertex `v` lies.
fn side_of(mesh: &TriMesh, [a, b, c]: [u32; 3], v: u32) -> f64 {
    let at = |index: u32| coordinates(&mesh.vertices()[index as usize]);
    orient3d(at(a), at(b), at(c), at(v))
}

/// Whether the line through an edge passes the three sides of a triangle on the same side.
fn runs_through(mesh: &TriMesh, [from, to]: [u32; 2], [a, b, c]: [u32; 3]) -> bool {
    let turns = [(a, b), (b, c), (c, a)].map(|(start, end)| side_of(mesh, [from, to, start], end));
    turns.iter().all(|&turn| turn > 0.0) || turns.iter().all(|&turn| turn < 0.0)
}

fn coordinates(p: &Point) -> Coord3D<f64> {
    Coord3D { x: p.x, y: p.y, z: p.z }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::test_meshes::{ball, block};

    #[test]
    fn a_block_and_a_ball_do_not_cross_themselves() {
        assert!(crossings(&block(Point::origin(), [1.0, 2.0, 3.0])).is_empty());
        assert!(crossings(&ball(Point::new(0.1, 0.2, 0.3), 5.0, 24)).is_empty());
    }

    #[test]
    fn a_ball_inside_another_does_not_cross_it() {
        let mesh = ball(Point::origin(), 5.0, 16).joined(&ball(Point::origin(), 3.0, 16).reversed());
        assert!(crossings(&mesh).is_empty());
    }

    #[test]
    fn overlapping_blocks_cross_and_touching_blocks_do_not() {
        let first = block(Point::origin(), [2.0, 2.0, 2.0]);
        let shifted = |x, y, z| first.clone().joined(&block(Point::new(x, y, z), [2.0, 2.0, 2.0]));
        assert!(!crossings(&shifted(1.1, 0.7, 0.9)).is_empty());
        assert!(crossings(&shifted(2.0, 0.0, 0.0)).is_empty());
        assert!(crossings(&shifted(2.0, 2.0, 2.0)).is_empty());
    }

    #[test]
    fn one_vertex_pushed_through_the_far_side_is_found() {
        let ball = ball(Point::origin(), 5.0, 16);
        let pole = ball.vertices()[0];
        let bad = ball.map_vertices(|p| {
            if *p == pole { Point::from(-pole.coords * 1.1 + pole.coords.yzx() * 0.01) } else { *p }
        });
        assert!(!crossings(&bad).is_empty());
    }

    #[test]
    fn every_pair_is_found_that_brute_force_finds() {
        let mesh = ball(Point::origin(), 5.0, 10).joined(&ball(Point::new(3.0, 0.5, 0.2), 4.0, 10));
        let count = mesh.triangles().len() as u32;
        let brute: Vec<[u32; 2]> =
            (0..count).flat_map(|i| crossings_of(&mesh, i, (0..count).collect())).collect();
        assert!(!brute.is_empty());
        assert_eq!(crossings(&mesh), brute);
    }
}
