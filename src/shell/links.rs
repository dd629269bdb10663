//! The faces that meet at each edge and at each vertex.

use rayon::prelude::*;

use crate::mesh::{Solid, TriMesh};

/// An edge and the two triangles beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Edge {
    /// Ends, in the order in which the first triangle runs along them.
    pub ends: [u32; 2],
    /// The triangle that runs along the edge, then the one that runs against it.
    pub triangles: [u32; 2],
}

/// Returns every edge of a solid once, ordered by its lower, then its higher vertex.
pub(super) fn edges(solid: &Solid) -> Vec<Edge> {
    let mut sides: Vec<([u32; 2], [u32; 2], u32)> =
        Vec::with_capacity(3 * solid.mesh().triangles().len());
    for (triangle, &[a, b, c]) in solid.mesh().triangles().iter().enumerate() {
        sides.extend(
            [[a, b], [b, c], [c, a]].map(|[p, q]| ([p.min(q), p.max(q)], [p, q], triangle as u32)),
        );
    }
    sides.par_sort_unstable();
    let pairs = sides.chunks_exact(2);
    pairs
        .map(|pair| Edge {
            ends: pair[0].1,
            triangles: [pair[0].2, pair[1].2],
        })
        .collect()
}

/// For each vertex, the triangles around it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stars {
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Stars {
    /// Returns the stars of a mesh.
    pub fn new(mesh: &TriMesh) -> Self {
        let mut starts = vec![0; mesh.vertices().len() + 1];
        let corners = || {
            mesh.triangles()
                .iter()
                .flatten()
                .map(|&vertex| vertex as usize)
        };
        corners().for_each(|vertex| starts[vertex + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut ends = starts.clone();
        let mut triangles = vec![0; 3 * mesh.triangles().len()];
        for (corner, vertex) in corners().enumerate() {
            triangles[ends[vertex] as usize] = (corner / 3) as u32;
            ends[vertex] += 1;
        }
        Self { starts, triangles }
    }

    /// Returns the triangles around vertex `vertex`, in ascending order.
    pub fn of(&self, vertex: usize) -> &[u32] {
        &self.triangles[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

/// Returns the two other corners of a triangle, in the order in which they follow `vertex`.
pub(super) fn others([a, b, c]: [u32; 3], vertex: u32) -> [u32; 2] {
    if a == vertex {
        [b, c]
    } else if b == vertex {
        [c, a]
    } else {
        [a, b]
    }
}

/// Returns whether the links (pairs of neighbours) of a vertex's triangles close to one ring.
pub(super) fn is_one_ring(links: &[[u32; 2]]) -> bool {
    let Some(&[start, mut at]) = links.first() else {
        return false;
    };
    let mut steps = 1;
    while at != start && steps <= links.len() {
        let Some(link) = links.iter().find(|link| link[0] == at) else {
            return false;
        };
        at = link[1];
        steps += 1;
    }
    steps == links.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::fixtures;

    #[test]
    fn a_cube_has_eighteen_edges_each_between_two_triangles_of_opposite_sense() {
        let solid = fixtures::cells(&[[0, 0, 0]], 1.0);
        let edges = edges(&solid);
        assert_eq!(edges.len(), 18);
        for Edge {
            ends: [a, b],
            triangles: [first, second],
        } in edges
        {
            let runs = |t: u32, from, to| {
                let [p, q, r] = solid.mesh().triangles()[t as usize];
                [(p, q), (q, r), (r, p)].contains(&(from, to))
            };
            assert!(runs(first, a, b) && runs(second, b, a));
        }
    }

    #[test]
    fn one_ring_closes_and_two_rings_at_a_pinch_do_not() {
        assert!(is_one_ring(&[[1, 2], [3, 1], [2, 3]]));
        assert!(!is_one_ring(&[
            [1, 2],
            [2, 3],
            [3, 1],
            [4, 5],
            [5, 6],
            [6, 4]
        ]));
        assert!(!is_one_ring(&[]));
    }

    #[test]
    fn the_stars_of_a_cube_hold_every_corner_once() {
        let solid = fixtures::cells(&[[0, 0, 0]], 1.0);
        let stars = Stars::new(solid.mesh());
        let total: usize = (0..8).map(|v| stars.of(v).len()).sum();
        assert_eq!(total, 36);
        for vertex in 0..8 {
            assert!(
                stars
                    .of(vertex)
                    .iter()
                    .all(|&t| solid.mesh().triangles()[t as usize].contains(&(vertex as u32)))
            );
        }
    }
}
