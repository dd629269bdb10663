//! Finds where a closed mesh meets itself, or comes nearer to itself than the rounding of a file
//! keeps apart.
//!
//! [`crate::mesh::Crossings`] judges coordinates as they stand; this test has a margin.

use std::ops::ControlFlow;

use super::runs::flat_map_in_runs;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::triangle::{
    segment_triangle_distance_squared, triangle_triangle_distance_squared,
};
use crate::geom::{Aabb, Bvh, Point, Vector};
use crate::mesh::TriMesh;

/// Distance below which parts of a surface count as meeting, mm: above the rounding of coordinates,
/// below anything that a file's `f32` tells apart.
const TOUCH_MM: f64 = 1e-7;

/// Cosine of the angle between two triangles at a shared side above which they count as folded onto
/// each other.
const FOLD_COSINE: f64 = 1.0 - 1e-10;

/// Returns the triangles that meet another one elsewhere than at a shared corner or side, in
/// ascending order. Only pairs with at least one triangle marked in `is_marked` are tested.
///
/// Every such pair whose boxes overlap is measured exactly.
pub(super) fn find_crossings_among(
    mesh: &TriMesh,
    is_marked: &[bool],
    watch: &Watch,
) -> Result<Vec<u32>, Cancelled> {
    let bvh = Bvh::new(mesh.iter_corners());
    let marked = |&i: &u32| is_marked[i as usize];
    let marked: Vec<u32> = (0..mesh.triangles().len() as u32).filter(marked).collect();
    let meetings_of = |index: usize| {
        let i = marked[index];
        let corners = mesh.corners(i as usize);
        let mut meeting = Vec::new();
        bvh.visit_overlapping(&Aabb::of_points(&corners).inflated(TOUCH_MM), |j, _| {
            let is_due = j > i || !is_marked[j as usize];
            if is_due && meet(mesh, i as usize, j as usize) {
                meeting.extend([i, j]);
            }
            ControlFlow::Continue(())
        });
        meeting
    };
    let mut crossing = flat_map_in_runs(marked.len(), watch, meetings_of)?;
    crossing.sort_unstable();
    crossing.dedup();
    Ok(crossing)
}

/// Returns whether two triangles have a point in common that is not on a shared corner or side.
fn meet(mesh: &TriMesh, i: usize, j: usize) -> bool {
    let (s, t) = (mesh.triangles()[i], mesh.triangles()[j]);
    let (a, b) = (mesh.corners(i), mesh.corners(j));
    let shared: Vec<usize> = (0..3).filter(|&k| t.contains(&s[k])).collect();
    if shared.len() < 2 && (is_beside(&a, &b) || is_beside(&b, &a)) {
        return false;
    }
    let limit_squared = TOUCH_MM * TOUCH_MM;
    match shared[..] {
        [] => triangle_triangle_distance_squared(&a, &b) < limit_squared,
        [k] => {
            let l = (0..3).find(|&l| t[l] == s[k]).unwrap_or(0);
            let opposite = |c: &[Point; 3], k: usize, other: &[Point; 3]| {
                segment_triangle_distance_squared(&c[(k + 1) % 3], &c[(k + 2) % 3], other)
                    < limit_squared
            };
            opposite(&a, k, &b) || opposite(&b, l, &a)
        }
        [k, l] => {
            let far = (0..3).find(|&m| !s.contains(&t[m])).unwrap_or(0);
            is_fold(&a[k], &a[l], &a[3 - k - l], &b[far])
        }
        _ => true,
    }
}

/// Returns whether a triangle lies on one side of the other's plane. One corner may lie in the
/// plane if it is a corner of the other triangle.
fn is_beside(a: &[Point; 3], plane: &[Point; 3]) -> bool {
    let normal = (plane[1] - plane[0]).cross(&(plane[2] - plane[0]));
    let margin = TOUCH_MM * normal.norm();
    let heights = a.map(|p| normal.dot(&(p - plane[0])));
    let above = heights.iter().filter(|&&h| h > margin).count();
    let below = heights.iter().filter(|&&h| h < -margin).count();
    let in_plane = heights.iter().filter(|&&h| h.abs() <= margin).count();
    above == 3
        || below == 3
        || (in_plane == 1 && (above == 2 || below == 2) && is_corner_of(a, plane, &heights, margin))
}

/// Returns whether each corner in the plane is also a corner of the triangle there.
fn is_corner_of(a: &[Point; 3], plane: &[Point; 3], heights: &[f64; 3], margin: f64) -> bool {
    (0..3)
        .filter(|&k| heights[k].abs() <= margin)
        .all(|k| plane.contains(&a[k]))
}

/// Returns whether the triangles a, b, c and a, b, d are folded onto each other.
fn is_fold(a: &Point, b: &Point, c: &Point, d: &Point) -> bool {
    let side = (b - a).normalize();
    let across = |p: &Point| {
        let offset: Vector = p - a;
        offset - side * side.dot(&offset)
    };
    let (u, v) = (across(c), across(d));
    u.dot(&v) > FOLD_COSINE * u.norm() * v.norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voids::shapes::{ball, block};

    fn find_crossings_among(mesh: &TriMesh, is_marked: &[bool]) -> Vec<u32> {
        super::find_crossings_among(mesh, is_marked, &Watch::silent()).unwrap()
    }

    fn crossing_triangles(mesh: &TriMesh) -> Vec<u32> {
        find_crossings_among(mesh, &vec![true; mesh.triangles().len()])
    }

    #[test]
    fn only_pairs_with_a_marked_triangle_are_found() {
        let two = block([0.0; 3], [2.0; 3]).joined(&block([1.0; 3], [3.0; 3]));
        let all = crossing_triangles(&two);
        let mut marked = vec![false; two.triangles().len()];
        assert!(find_crossings_among(&two, &marked).is_empty());
        marked[..12].fill(true);
        assert_eq!(find_crossings_among(&two, &marked), all);
        marked.fill(false);
        marked[all[0] as usize] = true;
        let met = find_crossings_among(&two, &marked);
        assert!(met.contains(&all[0]) && met.len() > 1 && met.iter().all(|i| all.contains(i)));
    }

    #[test]
    fn a_ball_and_a_box_do_not_meet_themselves() {
        assert!(crossing_triangles(&ball(Point::origin(), 2.0, 4)).is_empty());
        assert!(crossing_triangles(&block([0.0; 3], [1.0, 2.0, 3.0])).is_empty());
    }

    #[test]
    fn overlapping_bodies_meet_where_their_surfaces_cross() {
        let two = block([0.0; 3], [2.0; 3]).joined(&block([1.0; 3], [3.0; 3]));
        assert!(crossing_triangles(&two).len() >= 12);
        let apart = block([0.0; 3], [2.0; 3]).joined(&block([2.1, 0.0, 0.0], [3.0; 3]));
        assert!(crossing_triangles(&apart).is_empty());
    }

    #[test]
    fn a_corner_pushed_through_the_far_side_is_found() {
        let solid = block([0.0; 3], [2.0; 3]);
        let pushed = solid.map_vertices(|p| {
            if *p == Point::new(2.0, 2.0, 2.0) {
                Point::new(-0.5, 0.9, 1.0)
            } else {
                *p
            }
        });
        assert!(!crossing_triangles(&pushed).is_empty());
    }

    #[test]
    fn triangles_folded_onto_each_other_are_found() {
        let vertices = vec![
            Point::origin(),
            Point::new(1.0, 0.0, 0.0),
            Point::new(0.3, 1.0, 0.0),
            Point::new(0.6, 0.5, 0.0),
        ];
        let folded = TriMesh::new(vertices, vec![[0, 1, 2], [1, 0, 3]]).unwrap();
        assert_eq!(crossing_triangles(&folded), [0, 1]);
    }
}
