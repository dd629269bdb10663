//! Fewer triangles within a tolerance: vertices are merged into neighbours as long as every vertex ever removed stays
//! near the triangles that replaced it.
//!
//! The error is global, not per step (Ciampalini, Cignoni, Montani & Scopigno, "Multiresolution decimation based on
//! global error", The Visual Computer 13, 1997): each triangle keeps the removed vertices that it stands for.

mod collapse;
mod patch;

use rayon::prelude::*;

use crate::geom::Point;
use crate::mesh::TriMesh;
use patch::Patch;

/// Triangles to a slab: fewer leave more locked seams, more share the work worse and leave the cache.
const SLAB_TRIANGLES: usize = 40_000;

/// Rounds, each with slabs across another axis, so that the seams of one are inside the slabs of the next.
const ROUNDS: usize = 3;

/// How far the new surface may stray from the old vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stray {
    /// Outside the body, mm.
    pub outside_mm: f64,
    /// Inside it, mm.
    pub inside_mm: f64,
}

/// What a simplification must keep.
#[derive(Clone, Copy)]
pub(super) struct Rules<'a> {
    /// How far it may stray.
    pub stray: Stray,
    /// Whether a new triangle will do.
    pub allows: &'a (dyn Fn(&[Point; 3]) -> bool + Sync),
}

/// Triangles over some vertices of a mesh, and what they leave out.
struct State {
    triangles: Vec<[u32; 3]>,
    /// For each triangle the removed vertices that it stands for.
    stands_for: Vec<Vec<u32>>,
    /// Whether a vertex may still be removable: it was on a seam, or something beside it has changed since it was tried.
    is_open: Vec<bool>,
}

/// A mesh of fewer triangles over the same vertices, of which `locked` ones are not removed.
///
/// Closed and 2-manifold if `mesh` is; it may intersect itself where sheets are nearer than the tolerance. The result
/// does not depend on the number of threads.
pub(super) fn decimated(mesh: &TriMesh, rules: Rules, locked: &[bool]) -> Vec<[u32; 3]> {
    let mut state = State {
        triangles: mesh.triangles().to_vec(),
        stands_for: vec![Vec::new(); mesh.triangles().len()],
        is_open: vec![true; mesh.vertices().len()],
    };
    let first = mesh.aabb().size().imax();
    for round in 0..ROUNDS {
        state = decimate_slabs(state, mesh.vertices(), (first + round) % 3, (rules, locked));
    }
    state.triangles
}

/// Triangles, and the removed vertices that each stands for.
type Parts = (Vec<[u32; 3]>, Vec<Vec<u32>>);

/// One round: equal shares of the triangles along an axis, each on its own, with the seams locked.
fn decimate_slabs(state: State, vertices: &[Point], axis: usize, limits: (Rules, &[bool])) -> State {
    let center = |t: &[u32; 3]| t.iter().map(|&v| vertices[v as usize][axis]).sum::<f64>();
    let mut order: Vec<u32> = (0..state.triangles.len() as u32).collect();
    order.par_sort_by(|&a, &b| {
        let [p, q] = [a, b].map(|i| center(&state.triangles[i as usize]));
        p.total_cmp(&q).then(a.cmp(&b))
    });
    let slabs: Vec<&[u32]> = order.chunks(SLAB_TRIANGLES.max(1)).collect();
    let slab_of_vertex = slabs_of_vertices(&state, vertices.len(), &slabs);
    let is_locked = |v: u32| limits.1[v as usize] || slab_of_vertex[v as usize] == SEVERAL;
    let done: Vec<Parts> = slabs
        .par_iter()
        .map(|slab| {
            let mut patch = Patch::new(&state, vertices, slab, &is_locked);
            patch.decimate(limits.0);
            patch.into_parts()
        })
        .collect();
    let is_open = slab_of_vertex.iter().map(|&slab| slab == SEVERAL).collect();
    let mut merged = State { triangles: Vec::new(), stands_for: Vec::new(), is_open };
    for part in done {
        merged.triangles.extend(part.0);
        merged.stands_for.extend(part.1);
    }
    merged.open_beside_seams();
    merged
}

impl State {
    /// Opens the vertices beside open ones: only now can they be merged into those.
    fn open_beside_seams(&mut self) {
        let beside = |t: &&[u32; 3]| t.iter().any(|&v| self.is_open[v as usize]);
        let near: Vec<u32> = self.triangles.iter().filter(beside).flatten().copied().collect();
        near.into_iter().for_each(|v| self.is_open[v as usize] = true);
    }
}

/// "In no slab yet."
const NONE: u32 = u32::MAX;

/// "On a seam."
const SEVERAL: u32 = u32::MAX - 1;

fn slabs_of_vertices(state: &State, count: usize, slabs: &[&[u32]]) -> Vec<u32> {
    let mut slab_of = vec![NONE; count];
    for (number, slab) in slabs.iter().enumerate() {
        for &triangle in slab.iter() {
            for v in state.triangles[triangle as usize] {
                let seen = &mut slab_of[v as usize];
                *seen = if *seen == NONE || *seen == number as u32 { number as u32 } else { SEVERAL };
            }
        }
    }
    slab_of
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Bvh, Vector};
    use crate::mesh::Solid;
    use crate::voids::shapes::{ball, block, welded};

    const STRAY: Stray = Stray { outside_mm: 0.01, inside_mm: 0.02 };

    const RULES: Rules = Rules { stray: STRAY, allows: &|_| true };

    fn decimated_mesh(mesh: &TriMesh, locked: &[bool]) -> TriMesh {
        let triangles = decimated(mesh, RULES, locked);
        welded(triangles.iter().map(|t| t.map(|v| mesh.vertices()[v as usize])))
    }

    /// A box whose faces are cut into n × n squares.
    fn fine_block(n: usize) -> TriMesh {
        let fine = |t: [Point; 3]| {
            let at = move |i: usize, j: usize| {
                let (u, v) = (i as f64 / n as f64, j as f64 / n as f64);
                // Powers of two keep the corners on the planes, and equal corners equal.
                t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v
            };
            (0..n).flat_map(move |i| {
                (0..n - i).flat_map(move |j| {
                    let up = [at(i, j), at(i + 1, j), at(i, j + 1)];
                    let down = (j + 1 < n - i).then(|| [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                    std::iter::once(up).chain(down)
                })
            })
        };
        welded(block([0.0; 3], [8.0, 16.0, 4.0]).iter_corners().flat_map(fine))
    }

    #[test]
    fn a_finely_cut_box_keeps_few_triangles_and_its_volume() {
        let fine = fine_block(16);
        let coarse = decimated_mesh(&fine, &vec![false; fine.vertices().len()]);
        Solid::new(coarse.clone()).unwrap();
        assert!(coarse.triangles().len() < fine.triangles().len() / 20, "{}", coarse.triangles().len());
        // 640 mm² of surface moved by at most 0.02 mm.
        assert!((coarse.signed_volume_mm3() - 512.0).abs() < 640.0 * 0.02);
    }

    #[test]
    fn every_vertex_of_a_ball_stays_within_the_tolerance_of_its_side() {
        let fine = ball(Point::origin(), 5.0, 6);
        let coarse = decimated_mesh(&fine, &vec![false; fine.vertices().len()]);
        Solid::new(coarse.clone()).unwrap();
        assert!(coarse.triangles().len() < fine.triangles().len() / 3);
        let bvh = Bvh::new(coarse.iter_corners());
        for p in fine.vertices() {
            let distance = bvh.closest(p, f64::INFINITY, &[]).unwrap().distance_squared.sqrt();
            assert!(distance <= STRAY.inside_mm + 1e-9, "{distance}");
        }
    }

    #[test]
    fn locked_vertices_stay() {
        let fine = fine_block(8);
        let locked: Vec<bool> =
            fine.vertices().iter().map(|p| (p - Vector::new(8.0, 8.0, 2.0)).x >= 0.0).collect();
        let coarse = decimated_mesh(&fine, &locked);
        for (p, _) in fine.vertices().iter().zip(&locked).filter(|(_, is_locked)| **is_locked) {
            assert!(coarse.vertices().contains(p));
        }
    }

    #[test]
    fn one_thread_and_two_give_the_same_triangles() {
        let fine = ball(Point::origin(), 5.0, 7);
        let with_threads = |n| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
            pool.install(|| decimated(&fine, RULES, &vec![false; fine.vertices().len()]))
        };
        assert_eq!(with_threads(1), with_threads(2));
    }
}
