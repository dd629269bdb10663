//! Decimation in rounds of slabs, which are simplified in parallel and only again if they have
//! changed.

use rayon::prelude::*;

use super::parts::{Parts, State};
use super::patch::Patch;
use super::rules::Rules;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Point;
use crate::mesh::TriMesh;

/// Triangles of the mesh for each slab of the first round. Fewer leave more locked seams; more
/// leave the cache and cost more when a slab is done again.
const SLAB_TRIANGLES: usize = 16_000;

/// Slabs of the first round for each slab of a later round, in which fewer triangles are left.
const LATER_SLABS: usize = 2;

/// Number of rounds. Each has its slabs across another axis, so that the seams of one lie inside
/// the slabs of the next.
const ROUNDS: usize = 3;

/// A slab before its vertices are merged: everything on which the outcome depends.
#[derive(PartialEq)]
struct Slab {
    parts: Parts,
    /// For every corner, whether it must stay and whether it is open.
    corners: Vec<[bool; 2]>,
}

/// A slab and its result.
struct Done {
    before: Slab,
    after: Parts,
}

/// The simplification of a mesh. It can be run again with more vertices locked at little cost.
pub struct Decimation<'a> {
    mesh: &'a TriMesh,
    rules: Rules<'a>,
    first: FirstRound,
    rounds: Vec<Round>,
}

/// The first round, which always starts from the same triangles: of a slab only the locked vertices
/// can have changed.
struct FirstRound {
    start: State,
    slabs: Slabs,
    /// The vertices that were locked in the last run.
    locked: Vec<bool>,
    /// The slabs' results of the last run; none before it.
    done: Vec<Parts>,
}

/// A round: the positions of its cuts, and the slabs and results of the last run.
struct Round {
    axis: usize,
    /// Positions of the cuts along the axis, ascending, mm.
    cuts_mm: Vec<f64>,
    done: Vec<Done>,
}

impl<'a> Decimation<'a> {
    /// Prepares the simplification of a closed 2-manifold.
    pub fn new(mesh: &'a TriMesh, rules: Rules<'a>) -> Self {
        let longest = mesh.aabb().size().imax();
        let slabs = mesh.triangles().len().div_ceil(SLAB_TRIANGLES);
        let round = |number| {
            let axis = (longest + number) % 3;
            let count = if number == 0 {
                slabs
            } else {
                slabs.div_ceil(LATER_SLABS)
            };
            Round {
                axis,
                cuts_mm: quantiles(mesh.vertices(), axis, count),
                done: Vec::new(),
            }
        };
        Self {
            mesh,
            rules,
            first: FirstRound::new(mesh, &round(0)),
            rounds: (1..ROUNDS).map(round).collect(),
        }
    }

    /// Returns fewer triangles over the same vertices. Vertices marked in `locked` are not removed.
    ///
    /// The result is closed and 2-manifold; it may intersect itself where sheets are nearer than
    /// the tolerance. It does not depend on the number of threads, nor on earlier runs.
    pub fn run(&mut self, locked: &[bool], watch: &Watch) -> Result<Vec<[u32; 3]>, Cancelled> {
        let vertices = self.mesh.vertices();
        let mut state = self.first.run(vertices, locked, self.rules, watch)?;
        for round in &mut self.rounds {
            let slabs = Slabs::new(&state, vertices, round);
            let is_locked = |v: u32| locked[v as usize] || slabs.of_vertex[v as usize] == SEVERAL;
            let mut known = std::mem::take(&mut round.done);
            known.resize_with(slabs.triangles.len(), Done::none);
            let done = slabs.triangles.par_iter().zip(known).map(|(slab, known)| {
                watch.check()?;
                let before = Slab::new(&state, slab, &is_locked);
                if before == known.before {
                    return Ok(known);
                }
                let mut patch = Patch::new(&state, vertices, slab, &is_locked);
                patch.decimate(self.rules);
                Ok(Done {
                    before,
                    after: patch.into_parts(),
                })
            });
            round.done = done.collect::<Result<_, Cancelled>>()?;
            state = slabs.merge(round.done.iter().map(|done| &done.after));
        }
        Ok(state.parts.triangles)
    }
}

impl FirstRound {
    fn new(mesh: &TriMesh, round: &Round) -> Self {
        let parts = Parts {
            triangles: mesh.triangles().to_vec(),
            points: Vec::new(),
            ends: vec![0; mesh.triangles().len()],
        };
        let start = State {
            parts,
            is_open: vec![true; mesh.vertices().len()],
        };
        Self {
            slabs: Slabs::new(&start, mesh.vertices(), round),
            start,
            locked: Vec::new(),
            done: Vec::new(),
        }
    }

    /// Decimates the slabs whose locked vertices have changed since the last run.
    fn run(
        &mut self,
        vertices: &[Point],
        locked: &[bool],
        rules: Rules,
        watch: &Watch,
    ) -> Result<State, Cancelled> {
        let slabs = &self.slabs;
        let is_locked = |v: u32| locked[v as usize] || slabs.of_vertex[v as usize] == SEVERAL;
        let mut known = std::mem::take(&mut self.done).into_iter().map(Some);
        let known: Vec<Option<Parts>> = slabs
            .triangles
            .iter()
            .map(|slab| {
                known
                    .next()
                    .flatten()
                    .filter(|_| self.is_as_before(slab, locked))
            })
            .collect();
        let done = slabs.triangles.par_iter().zip(known).map(|(slab, known)| {
            watch.check()?;
            Ok(known.unwrap_or_else(|| {
                let mut patch = Patch::new(&self.start, vertices, slab, &is_locked);
                patch.decimate(rules);
                patch.into_parts()
            }))
        });
        self.done = done.collect::<Result<_, Cancelled>>()?;
        self.locked = locked.to_vec();
        Ok(self.slabs.merge(self.done.iter()))
    }

    /// Returns whether the same vertices of a slab are locked as in the last run.
    fn is_as_before(&self, slab: &[u32], locked: &[bool]) -> bool {
        let corners = slab
            .iter()
            .flat_map(|&t| self.start.parts.triangles[t as usize]);
        corners
            .map(|v| v as usize)
            .all(|v| locked[v] == self.locked[v])
    }
}

impl Done {
    /// Returns the empty result of an empty slab.
    fn none() -> Self {
        Self {
            before: Slab {
                parts: Parts::default(),
                corners: Vec::new(),
            },
            after: Parts::default(),
        }
    }
}

impl Slab {
    fn new(state: &State, triangles: &[u32], is_locked: &impl Fn(u32) -> bool) -> Self {
        let mut parts = Parts::default();
        for &t in triangles {
            parts.push(
                state.parts.triangles[t as usize],
                state.parts.points_of(t).iter().copied(),
            );
        }
        let flags = |&v: &u32| [is_locked(v), state.is_open[v as usize]];
        let corners = parts.triangles.iter().flatten().map(flags).collect();
        Self { parts, corners }
    }
}

/// Returns the positions that cut an axis into `count` slabs with equally many of the points,
/// ascending, mm.
fn quantiles(points: &[Point], axis: usize, count: usize) -> Vec<f64> {
    let mut all: Vec<f64> = points.iter().map(|p| p[axis]).collect();
    all.par_sort_unstable_by(f64::total_cmp);
    (1..count).map(|i| all[i * all.len() / count]).collect()
}

/// The triangles slab by slab; each triangle belongs to the slab of its centre.
struct Slabs {
    triangles: Vec<Vec<u32>>,
    /// For each vertex its slab, or [`NONE`] or [`SEVERAL`].
    of_vertex: Vec<u32>,
}

/// The slab number of a vertex that is in no slab yet.
const NONE: u32 = u32::MAX;

/// The slab number of a vertex on a seam.
const SEVERAL: u32 = u32::MAX - 1;

impl Slabs {
    fn new(state: &State, vertices: &[Point], Round { axis, cuts_mm, .. }: &Round) -> Self {
        let center =
            |t: &[u32; 3]| t.iter().map(|&v| vertices[v as usize][*axis]).sum::<f64>() / 3.0;
        let triangles = &state.parts.triangles;
        let mut order: Vec<(f64, u32)> = triangles.iter().map(center).zip(0..).collect();
        order.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut rest = &order[..];
        let mut slabs: Vec<Vec<u32>> = Vec::with_capacity(cuts_mm.len() + 1);
        for cut_mm in cuts_mm.iter().chain([&f64::INFINITY]) {
            let (slab, beyond) = rest.split_at(rest.partition_point(|(at, _)| at < cut_mm));
            slabs.push(slab.iter().map(|&(_, t)| t).collect());
            rest = beyond;
        }
        let mut of_vertex = vec![NONE; vertices.len()];
        for (number, slab) in (0..).zip(&slabs) {
            for v in slab.iter().flat_map(|&t| triangles[t as usize]) {
                let seen = &mut of_vertex[v as usize];
                *seen = if *seen == NONE || *seen == number {
                    number
                } else {
                    SEVERAL
                };
            }
        }
        Self {
            triangles: slabs,
            of_vertex,
        }
    }

    /// Returns the slabs' results as one mesh.
    fn merge<'p>(&self, done: impl Iterator<Item = &'p Parts>) -> State {
        let mut parts = Parts::default();
        done.for_each(|done| parts.append(done));
        let mut state = State {
            parts,
            is_open: self.of_vertex.iter().map(|&slab| slab == SEVERAL).collect(),
        };
        state.open_beside_seams();
        state
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Bvh, Vector};
    use crate::mesh::Solid;
    use crate::voids::decimate::Stray;
    use crate::voids::shapes::{ball, block, welded};

    const STRAY: Stray = Stray {
        outside_mm: 0.01,
        inside_mm: 0.02,
    };

    const RULES: Rules = Rules {
        stray: STRAY,
        allows: &|_| true,
    };

    fn run(decimation: &mut Decimation, locked: &[bool]) -> Vec<[u32; 3]> {
        decimation.run(locked, &Watch::silent()).unwrap()
    }

    fn decimate(mesh: &TriMesh, locked: &[bool]) -> TriMesh {
        let triangles = run(&mut Decimation::new(mesh, RULES), locked);
        welded(
            triangles
                .iter()
                .map(|t| t.map(|v| mesh.vertices()[v as usize])),
        )
    }

    /// Returns a box whose faces are cut into n × n squares.
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
                    let down =
                        (j + 1 < n - i).then(|| [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                    std::iter::once(up).chain(down)
                })
            })
        };
        welded(
            block([0.0; 3], [8.0, 16.0, 4.0])
                .iter_corners()
                .flat_map(fine),
        )
    }

    #[test]
    fn a_finely_cut_box_keeps_few_triangles_and_its_volume() {
        let fine = fine_block(16);
        let coarse = decimate(&fine, &vec![false; fine.vertices().len()]);
        Solid::new(coarse.clone()).unwrap();
        assert!(
            coarse.triangles().len() < fine.triangles().len() / 20,
            "{}",
            coarse.triangles().len()
        );
        // 640 mm² of surface moved by at most 0.02 mm.
        assert!((coarse.signed_volume_mm3() - 512.0).abs() < 640.0 * 0.02);
    }

    #[test]
    fn every_vertex_of_a_ball_stays_within_the_tolerance() {
        let fine = ball(Point::origin(), 5.0, 6);
        let coarse = decimate(&fine, &vec![false; fine.vertices().len()]);
        Solid::new(coarse.clone()).unwrap();
        assert!(coarse.triangles().len() < fine.triangles().len() / 3);
        let bvh = Bvh::new(coarse.iter_corners());
        for p in fine.vertices() {
            let distance = bvh
                .closest(p, f64::INFINITY, &[])
                .unwrap()
                .distance_squared
                .sqrt();
            assert!(distance <= STRAY.inside_mm + 1e-9, "{distance}");
        }
    }

    #[test]
    fn locked_vertices_stay() {
        let fine = fine_block(8);
        let locked: Vec<bool> = fine
            .vertices()
            .iter()
            .map(|p| (p - Vector::new(8.0, 8.0, 2.0)).x >= 0.0)
            .collect();
        let coarse = decimate(&fine, &locked);
        for (p, _) in fine
            .vertices()
            .iter()
            .zip(&locked)
            .filter(|(_, is_locked)| **is_locked)
        {
            assert!(coarse.vertices().contains(p));
        }
    }

    #[test]
    fn one_thread_and_two_give_the_same_triangles() {
        let fine = ball(Point::origin(), 5.0, 7);
        let with_threads = |n| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(n)
                .build()
                .unwrap();
            let none = vec![false; fine.vertices().len()];
            pool.install(|| run(&mut Decimation::new(&fine, RULES), &none))
        };
        assert_eq!(with_threads(1), with_threads(2));
    }

    #[test]
    fn a_second_run_with_more_locked_equals_a_first_run() {
        let fine = ball(Point::origin(), 5.0, 7);
        let none = vec![false; fine.vertices().len()];
        let some: Vec<bool> = fine
            .vertices()
            .iter()
            .map(|p| p.x > 4.0 && p.y > 1.0)
            .collect();
        let mut decimation = Decimation::new(&fine, RULES);
        let before = run(&mut decimation, &none);
        let again = run(&mut decimation, &some);
        assert_ne!(before, again);
        assert_eq!(again, run(&mut Decimation::new(&fine, RULES), &some));
    }
}
