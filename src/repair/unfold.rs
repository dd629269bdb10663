//! Unfolding: flips or collapses the slivers that the rounding of a written file would fold.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Bvh, Point, Vector};
use crate::mesh::TriMesh;
use crate::mesh::crossings::cross;

/// Height of a triangle below which it and its neighbours are examined, mm. Rounding to single
/// precision moves a corner at 300 mm by 1.5e-5 mm, and folds triangles a few times lower than
/// that. A far larger height only costs time.
const SLIVER_HEIGHT_MM: f64 = 1e-3;
/// Longest side of a sliver that may be collapsed, mm. A longer one could be a detail that a
/// printer shows.
const MAX_COLLAPSE_MM: f64 = 0.02;
/// Largest number of rounds. Each mends all folds that do not touch, and a mended fold rarely makes
/// another.
const MAX_ROUNDS: usize = 12;

/// Mends the slivers that would fold into a neighbour when a file's coordinates round to single
/// precision.
///
/// An edge flip at a triangle of height h moves the surface by h at most. The collapse of a short
/// edge moves it by the bend of the surface along 0.02 mm. Returns the mesh unchanged if nothing
/// folds; a fold that neither mends is left. Examines slivers only, so a sound mesh costs little
/// more than its search tree.
///
/// # Errors
/// The watch was stopped.
pub fn unfold(mesh: &TriMesh, watch: &Watch) -> Result<TriMesh, Cancelled> {
    let mut best = (usize::MAX, mesh.clone());
    let mut mended = mesh.clone();
    for _ in 0..MAX_ROUNDS {
        watch.check()?;
        let found = find_folds(&round_to_single(&mended));
        if found.len() < best.0 {
            best = (found.len(), mended.clone());
        }
        let Some(next) = (!found.is_empty())
            .then(|| mend_folds(&mended, &found, watch))
            .transpose()?
            .flatten()
        else {
            break;
        };
        mended = next;
    }
    Ok(best.1)
}

/// Rounds the mesh as a file in single precision does.
fn round_to_single(mesh: &TriMesh) -> TriMesh {
    mesh.map_vertices(|p| p.map(|x| f64::from(x as f32)))
}

/// Returns the crossing pairs of triangles in which one is thin or has a corner of a thin one. The
/// lower index comes first in each pair; pairs are ascending.
fn find_folds(mesh: &TriMesh) -> Vec<[u32; 2]> {
    let candidates = triangles_near_slivers(mesh);
    if candidates.is_empty() {
        return Vec::new();
    }
    let bvh = Bvh::new(mesh.iter_corners());
    let crossed_by = |&i: &u32| {
        let corners = mesh.corners(i as usize);
        let mut pairs = Vec::new();
        bvh.visit_overlapping(&Aabb::of_points(&corners), |j, other| {
            if j != i && cross(&corners, other) {
                pairs.push([i.min(j), i.max(j)]);
            }
            ControlFlow::Continue(())
        });
        pairs
    };
    let mut pairs: Vec<[u32; 2]> = candidates.par_iter().flat_map_iter(crossed_by).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Returns the triangles that share a corner with a thin one. When a sliver turns over, its
/// neighbours pass through each other.
fn triangles_near_slivers(mesh: &TriMesh) -> Vec<u32> {
    let mut is_thin = vec![false; mesh.vertices().len()];
    for (triangle, corners) in mesh.triangles().iter().zip(mesh.iter_corners()) {
        if height(&corners) < SLIVER_HEIGHT_MM {
            triangle.iter().for_each(|&v| is_thin[v as usize] = true);
        }
    }
    let triangles = mesh.triangles().iter().enumerate();
    triangles
        .filter(|(_, t)| t.iter().any(|&v| is_thin[v as usize]))
        .map(|(i, _)| i as u32)
        .collect()
}

/// Mends the thinnest triangle at each fold; `None` if no fold can be mended.
fn mend_folds(
    mesh: &TriMesh,
    folds: &[[u32; 2]],
    watch: &Watch,
) -> Result<Option<TriMesh>, Cancelled> {
    let mut patch = Patch {
        vertices: mesh.vertices().to_vec(),
        triangles: mesh.triangles().to_vec(),
        touched: Vec::new(),
    };
    for pair in folds {
        watch.check()?;
        patch.mend(pair);
    }
    let is_mended = !patch.touched.is_empty();
    patch
        .triangles
        .retain(|[a, b, c]| a != b && b != c && c != a);
    let mended = TriMesh::new(patch.vertices, patch.triangles).ok();
    Ok(mended.filter(|_| is_mended))
}

/// A surface under repair. A removed triangle repeats a corner.
struct Patch {
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    /// Vertices at triangles that changed in this round.
    touched: Vec<u32>,
}

impl Patch {
    /// Mends the fold of two triangles at the thinnest possible of them and their neighbours.
    fn mend(&mut self, pair: &[u32; 2]) {
        let corners: Vec<u32> = pair
            .iter()
            .flat_map(|&t| self.triangles[t as usize])
            .collect();
        if corners.iter().any(|v| self.touched.contains(v)) {
            return;
        }
        let touches = |t: &[u32; 3]| t.iter().filter(|v| corners.contains(v)).count() >= 2;
        let mut at: Vec<usize> = (0..self.triangles.len())
            .filter(|&t| touches(&self.triangles[t]))
            .collect();
        at.sort_by(|&s, &t| self.height(s).total_cmp(&self.height(t)));
        for t in at
            .into_iter()
            .filter(|&t| self.height(t) < SLIVER_HEIGHT_MM)
            .collect::<Vec<_>>()
        {
            if self.flip_edge(t) || self.collapse_edge(t) {
                return;
            }
        }
    }

    fn corners(&self, t: [u32; 3]) -> [Point; 3] {
        t.map(|v| self.vertices[v as usize])
    }

    fn height(&self, t: usize) -> f64 {
        height(&self.corners(self.triangles[t]))
    }

    /// Flips the longest edge of a triangle, so that it joins the opposite corners. Returns
    /// false, with nothing changed, unless both new triangles are higher than the old one and
    /// neither turns over.
    fn flip_edge(&mut self, t: usize) -> bool {
        let [a, b, c] = longest_first(self.triangles[t], &self.corners(self.triangles[t]));
        let Some((u, d)) = self.triangle_across(b, a) else {
            return false;
        };
        let flipped = [[a, d, c], [d, b, c]];
        let facing = normal(&self.corners(self.triangles[u]));
        let low = self.height(t);
        let is_better = |&new: &[u32; 3]| {
            let corners = self.corners(new);
            height(&corners) > low && normal(&corners).dot(&facing) > 0.0
        };
        if self.has_edge(c, d) || !flipped.iter().all(is_better) {
            return false;
        }
        [self.triangles[t], self.triangles[u]] = flipped;
        self.touched.extend([a, b, c, d]);
        true
    }

    /// Returns the triangle with the side from `from` to `to`, and its third corner.
    fn triangle_across(&self, from: u32, to: u32) -> Option<(usize, u32)> {
        self.triangles.iter().enumerate().find_map(|(t, corners)| {
            (0..3).find_map(|k| {
                let is_it = corners[k] == from && corners[(k + 1) % 3] == to;
                is_it.then_some((t, corners[(k + 2) % 3]))
            })
        })
    }

    fn has_edge(&self, a: u32, b: u32) -> bool {
        self.triangle_across(a, b).is_some() || self.triangle_across(b, a).is_some()
    }

    /// Collapses the triangle's shortest edge. Returns false, with nothing changed, unless it
    /// is short, the surface stays a manifold and no other triangle turns over.
    fn collapse_edge(&mut self, t: usize) -> bool {
        let [a, b, c] = shortest_first(self.triangles[t], &self.corners(self.triangles[t]));
        let length = (self.vertices[a as usize] - self.vertices[b as usize]).norm();
        let Some((_, d)) = self.triangle_across(b, a) else {
            return false;
        };
        if length > MAX_COLLAPSE_MM
            || self.common_neighbours(a, b) != sort([c, d])
            || !(self.merge_into(a, b) || self.merge_into(b, a))
        {
            return false;
        }
        self.touched.extend([a, b, c, d]);
        true
    }

    /// Returns the vertices joined to both, ascending.
    fn common_neighbours(&self, a: u32, b: u32) -> Vec<u32> {
        let ring = |v: u32| -> Vec<u32> {
            self.triangles
                .iter()
                .filter(|t| t.contains(&v))
                .flatten()
                .copied()
                .filter(|&w| w != v)
                .collect()
        };
        let near_b = ring(b);
        let mut both: Vec<u32> = ring(a).into_iter().filter(|v| near_b.contains(v)).collect();
        both.sort_unstable();
        both.dedup();
        both
    }

    /// Moves the vertex `from` into `to`. Returns false, with nothing changed, if that would
    /// turn a triangle over.
    fn merge_into(&mut self, from: u32, to: u32) -> bool {
        let moved = |t: [u32; 3]| t.map(|v| if v == from { to } else { v });
        let keeps_side = |t: &&[u32; 3]| {
            let (before, after) = (self.corners(**t), self.corners(moved(**t)));
            height(&before) < SLIVER_HEIGHT_MM || normal(&before).dot(&normal(&after)) > 0.0
        };
        if !self
            .triangles
            .iter()
            .filter(|t| t.contains(&from) && !t.contains(&to))
            .all(|t| keeps_side(&t))
        {
            return false;
        }
        self.triangles.iter_mut().for_each(|t| *t = moved(*t));
        true
    }
}

fn sort<const N: usize>(mut items: [u32; N]) -> Vec<u32> {
    items.sort_unstable();
    items.to_vec()
}

/// Returns the normal, as long as twice the area, mm².
fn normal([a, b, c]: &[Point; 3]) -> Vector {
    (b - a).cross(&(c - a))
}

/// Returns the lengths of the sides, each from its corner to the next, mm.
fn sides(corners: &[Point; 3]) -> [f64; 3] {
    std::array::from_fn(|k| (corners[(k + 1) % 3] - corners[k]).norm())
}

/// Returns the height over the longest side, mm.
fn height(corners: &[Point; 3]) -> f64 {
    let longest = sides(corners).into_iter().fold(0.0, f64::max);
    if longest > 0.0 {
        normal(corners).norm() / longest
    } else {
        0.0
    }
}

/// Rotates the triangle's corners to begin with the ends of its longest side.
fn longest_first(triangle: [u32; 3], corners: &[Point; 3]) -> [u32; 3] {
    let lengths = sides(corners);
    rotate_to(
        triangle,
        (0..3).max_by(|&i, &j| lengths[i].total_cmp(&lengths[j])),
    )
}

/// Rotates the triangle's corners to begin with the ends of its shortest side.
fn shortest_first(triangle: [u32; 3], corners: &[Point; 3]) -> [u32; 3] {
    let lengths = sides(corners);
    rotate_to(
        triangle,
        (0..3).min_by(|&i, &j| lengths[i].total_cmp(&lengths[j])),
    )
}

fn rotate_to(mut triangle: [u32; 3], first: Option<usize>) -> [u32; 3] {
    triangle.rotate_left(first.unwrap_or(0));
    triangle
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;

    fn unfold(mesh: &TriMesh) -> TriMesh {
        super::unfold(mesh, &Watch::silent()).unwrap()
    }

    /// A skew tetrahedron far from the origin, whose coordinates are not exact in single
    /// precision.
    const CORNERS: [[f64; 3]; 4] = [
        [71.3, 88.7, 59.1],
        [92.9, 97.3, 63.7],
        [80.1, 121.9, 61.3],
        [83.7, 99.1, 91.9],
    ];

    /// The tetrahedron with additional vertices on its edge from 0 to 1, at these shares of it.
    /// Each is moved off the edge by `aside_mm` toward the middle of the faces there.
    fn tetrahedron(shares: &[f64], aside_mm: f64) -> Vec<Point> {
        let mut vertices = CORNERS.map(Point::from).to_vec();
        let middle = nalgebra::center(&vertices[2], &vertices[3]);
        let (from, to) = (vertices[0], vertices[1]);
        vertices.extend(shares.iter().map(|&share| {
            let at = from + (to - from) * share;
            at + (middle - at).normalize() * aside_mm
        }));
        vertices
    }

    /// Face 0 1 2 ends at the vertex beside the edge, and a cap lies between it and face 1 0 3.
    fn tetrahedron_with_cap(share: f64) -> TriMesh {
        let triangles = vec![
            [0, 4, 2],
            [4, 1, 2],
            [0, 1, 4],
            [1, 0, 3],
            [1, 3, 2],
            [2, 3, 0],
        ];
        outward(tetrahedron(&[share], 1e-7), triangles)
    }

    /// Both faces at the edge have two vertices in common there that are 1e-6 mm apart.
    fn tetrahedron_with_needle(share: f64) -> TriMesh {
        let triangles = vec![
            [0, 4, 2],
            [4, 5, 2],
            [5, 1, 2],
            [4, 0, 3],
            [5, 4, 3],
            [1, 5, 3],
            [1, 3, 2],
            [2, 3, 0],
        ];
        outward(tetrahedron(&[share, share + 5e-8], 0.0), triangles)
    }

    fn outward(vertices: Vec<Point>, triangles: Vec<[u32; 3]>) -> TriMesh {
        let mesh = TriMesh::new(vertices, triangles).unwrap();
        if mesh.signed_volume_mm3() < 0.0 {
            mesh.reversed()
        } else {
            mesh
        }
    }

    /// Counts, among many places of the extra vertices, the folded surfaces before and after
    /// unfolding.
    fn count_folded(surface: impl Fn(f64) -> TriMesh) -> [usize; 2] {
        let meshes: Vec<TriMesh> = (1..200).map(|i| surface(f64::from(i) / 203.0)).collect();
        let count = |meshes: &[TriMesh]| {
            meshes
                .iter()
                .filter(|m| !find_folds(&round_to_single(m)).is_empty())
                .count()
        };
        let mended: Vec<TriMesh> = meshes.iter().map(unfold).collect();
        for (mesh, mended) in meshes.iter().zip(&mended) {
            let volume = mesh.signed_volume_mm3();
            // An edge of 25 mm moves by at most the height of a sliver, 1e-6 mm, over
            // an area of 400 mm².
            assert!(
                (mended.signed_volume_mm3() - volume).abs() < 1e-3,
                "{volume}"
            );
            Solid::new(mended.clone()).unwrap();
        }
        [count(&meshes), count(&mended)]
    }

    #[test]
    fn caps_that_rounding_folds_are_flipped() {
        let [before, after] = count_folded(tetrahedron_with_cap);
        assert!(before > 20 && after == 0, "{before}, {after}");
    }

    #[test]
    fn needles_that_rounding_folds_are_collapsed() {
        let [before, after] = count_folded(tetrahedron_with_needle);
        assert!(before > 5 && after == 0, "{before}, {after}");
    }

    #[test]
    fn a_surface_without_slivers_comes_back_as_it_is() {
        let ball = crate::mesh::primitives::ball(&Point::new(50.0, 60.0, 70.0), 20.0, 4);
        assert_eq!(unfold(&ball), ball);
    }
}
