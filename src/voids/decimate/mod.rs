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

/// Triangles over some vertices of a mesh, and the removed vertices that each stands for.
#[derive(Debug, Clone, Default)]
struct Parts {
    triangles: Vec<[u32; 3]>,
    /// The removed vertices, triangle by triangle.
    points: Vec<u32>,
    /// Where each triangle's removed vertices end.
    ends: Vec<u32>,
}

impl Parts {
    /// Adds a triangle that stands for these vertices.
    fn push(&mut self, triangle: [u32; 3], points: impl Iterator<Item = u32>) {
        self.triangles.push(triangle);
        self.points.extend(points);
        self.ends.push(self.points.len() as u32);
    }

    /// Adds all of another's triangles.
    fn append(&mut self, other: &Self) {
        let before = self.points.len() as u32;
        self.triangles.extend_from_slice(&other.triangles);
        self.points.extend_from_slice(&other.points);
        self.ends.extend(other.ends.iter().map(|end| before + end));
    }

    /// The removed vertices that a triangle stands for.
    fn points_of(&self, triangle: u32) -> &[u32] {
        let t = triangle as usize;
        let start = if t == 0 { 0 } else { self.ends[t - 1] as usize };
        &self.points[start..self.ends[t] as usize]
    }
}

/// A mesh on its way to fewer triangles.
struct State {
    parts: Parts,
    /// Whether a vertex may still be removable: it was on a seam, or something beside it has changed since it was tried.
    is_open: Vec<bool>,
}

/// The simplification of a mesh, which can be done again with more vertices locked at little cost.
pub(super) struct Decimation<'a> {
    mesh: &'a TriMesh,
    rules: Rules<'a>,
    /// What must not be removed, as of the last run.
    locked: Vec<bool>,
    /// The slabs of the first round, and what they became in the last run.
    first: Vec<Parts>,
}

impl<'a> Decimation<'a> {
    /// Prepares the simplification of a closed 2-manifold.
    pub fn new(mesh: &'a TriMesh, rules: Rules<'a>) -> Self {
        Self { mesh, rules, locked: vec![false; mesh.vertices().len()], first: Vec::new() }
    }

    /// A mesh of fewer triangles over the same vertices, of which `locked` ones are not removed.
    ///
    /// Closed and 2-manifold; it may intersect itself where sheets are nearer than the tolerance. The result does not
    /// depend on the number of threads, nor on earlier runs.
    pub fn run(&mut self, locked: &[bool]) -> Vec<[u32; 3]> {
        let count = self.mesh.vertices().len();
        let triangles = self.mesh.triangles();
        let parts =
            Parts { triangles: triangles.to_vec(), points: Vec::new(), ends: vec![0; triangles.len()] };
        let mut state = State { parts, is_open: vec![true; count] };
        let first = self.mesh.aabb().size().imax();
        for round in 0..ROUNDS {
            let slabs = Slabs::new(&state, self.mesh.vertices(), (first + round) % 3);
            let known = if round == 0 { std::mem::take(&mut self.first) } else { Vec::new() };
            let done = self.decimate_slabs(&state, &slabs, locked, known);
            state = slabs.merged(&done);
            if round == 0 {
                self.first = done;
            }
        }
        self.locked.copy_from_slice(locked);
        state.parts.triangles
    }

    /// One round: each slab on its own, with the seams locked; slabs `known` from the last run are not done again
    /// where nothing more is locked.
    fn decimate_slabs(
        &self,
        state: &State,
        slabs: &Slabs,
        locked: &[bool],
        mut known: Vec<Parts>,
    ) -> Vec<Parts> {
        known.resize(slabs.triangles.len(), Parts::default());
        let is_locked = |v: u32| locked[v as usize] || slabs.of_vertex[v as usize] == SEVERAL;
        let has_changed = |&v: &u32| locked[v as usize] != self.locked[v as usize];
        let corners = |t: &u32| state.parts.triangles[*t as usize];
        slabs
            .triangles
            .par_iter()
            .zip(known)
            .map(|(slab, known)| {
                if !known.triangles.is_empty() && !slab.iter().any(|t| corners(t).iter().any(has_changed)) {
                    return known;
                }
                let mut patch = Patch::new(state, self.mesh.vertices(), slab, &is_locked);
                patch.decimate(self.rules);
                patch.into_parts()
            })
            .collect()
    }
}

/// Equal shares of the triangles along an axis.
struct Slabs {
    triangles: Vec<Vec<u32>>,
    /// For each vertex its slab, or [`NONE`] or [`SEVERAL`].
    of_vertex: Vec<u32>,
}

/// "In no slab yet."
const NONE: u32 = u32::MAX;

/// "On a seam."
const SEVERAL: u32 = u32::MAX - 1;

impl Slabs {
    fn new(state: &State, vertices: &[Point], axis: usize) -> Self {
        let center = |t: &[u32; 3]| t.iter().map(|&v| vertices[v as usize][axis]).sum::<f64>();
        let triangles = &state.parts.triangles;
        let mut order: Vec<(f64, u32)> = triangles.iter().map(center).zip(0..).collect();
        order.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let slabs: Vec<Vec<u32>> =
            order.chunks(SLAB_TRIANGLES).map(|slab| slab.iter().map(|&(_, t)| t).collect()).collect();
        let mut of_vertex = vec![NONE; vertices.len()];
        for (number, slab) in (0..).zip(&slabs) {
            for v in slab.iter().flat_map(|&t| triangles[t as usize]) {
                let seen = &mut of_vertex[v as usize];
                *seen = if *seen == NONE || *seen == number { number } else { SEVERAL };
            }
        }
        Self { triangles: slabs, of_vertex }
    }

    /// What the slabs became, as one.
    fn merged(&self, done: &[Parts]) -> State {
        let mut parts = Parts::default();
        done.iter().for_each(|part| parts.append(part));
        let mut state =
            State { parts, is_open: self.of_vertex.iter().map(|&slab| slab == SEVERAL).collect() };
        state.open_beside_seams();
        state
    }
}

impl State {
    /// Opens the vertices beside open ones: only now can they be merged into those.
    fn open_beside_seams(&mut self) {
        let beside = |t: &&[u32; 3]| t.iter().any(|&v| self.is_open[v as usize]);
        let near: Vec<u32> = self.parts.triangles.iter().filter(beside).flatten().copied().collect();
        near.into_iter().for_each(|v| self.is_open[v as usize] = true);
    }
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
        let triangles = Decimation::new(mesh, RULES).run(locked);
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
            pool.install(|| Decimation::new(&fine, RULES).run(&vec![false; fine.vertices().len()]))
        };
        assert_eq!(with_threads(1), with_threads(2));
    }

    #[test]
    fn a_second_run_with_more_locked_is_what_a_first_one_would_be() {
        let fine = ball(Point::origin(), 5.0, 7);
        let none = vec![false; fine.vertices().len()];
        let some: Vec<bool> = fine.vertices().iter().map(|p| p.x > 4.0 && p.y > 1.0).collect();
        let mut decimation = Decimation::new(&fine, RULES);
        let before = decimation.run(&none);
        let again = decimation.run(&some);
        assert_ne!(before, again);
        assert_eq!(again, Decimation::new(&fine, RULES).run(&some));
    }
}
