//! Collapses a contracted surface, by its shortest edges, until no triangle is left.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use super::graph::Graph;
use super::surface::Surface;
use crate::geom::Point;

/// The edges and triangles that are left of a contracted surface.
struct Complex {
    at: Vec<Point>,
    /// The number of the surface's vertices in each vertex, which weighs its place; zero for one
    /// that went into another.
    weight: Vec<f64>,
    neighbours: Vec<BTreeSet<u32>>,
    /// The triangles around each vertex, each as its two other corners, the smaller first.
    triangles: Vec<BTreeSet<[u32; 2]>>,
}

/// An edge that waits for its turn, the shortest first.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Waiting {
    length_mm: f64,
    ends: [u32; 2],
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let lengths = self.length_mm.total_cmp(&other.length_mm);
        lengths.then(self.ends.cmp(&other.ends))
    }
}

/// Returns the curves that a contracted surface collapses to.
pub(super) fn collapse_to_curve(surface: &Surface) -> Graph {
    let mut complex = Complex::of(surface);
    let mut queue: BinaryHeap<Reverse<Waiting>> = surface
        .edges()
        .into_iter()
        .map(|ends| Reverse(complex.waiting(ends)))
        .collect();
    while let Some(Reverse(edge)) = queue.pop() {
        if !complex.is_current(&edge) || !complex.has_triangle(edge.ends) {
            continue;
        }
        complex.collapse(edge.ends);
        let kept = edge.ends[0];
        let around = complex.neighbours[kept as usize].iter();
        queue.extend(around.map(|v| Reverse(complex.waiting(sorted([kept, *v])))));
    }
    complex.into_graph(surface)
}

impl Complex {
    fn of(surface: &Surface) -> Self {
        let count = surface.at.len();
        let mut complex = Self {
            at: surface.at.clone(),
            weight: vec![1.0; count],
            neighbours: vec![BTreeSet::new(); count],
            triangles: vec![BTreeSet::new(); count],
        };
        for [a, b, c] in surface.triangles() {
            for (v, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
                complex.neighbours[v as usize].extend(others);
                complex.triangles[v as usize].insert(sorted(others));
            }
        }
        complex
    }

    fn waiting(&self, ends: [u32; 2]) -> Waiting {
        let [a, b] = ends.map(|v| self.at[v as usize]);
        Waiting {
            length_mm: (a - b).norm(),
            ends,
        }
    }

    /// Returns true if an edge is still there, and as long as when it began to wait.
    fn is_current(&self, edge: &Waiting) -> bool {
        let [a, b] = edge.ends;
        self.neighbours[a as usize].contains(&b) && *edge == self.waiting(edge.ends)
    }

    fn has_triangle(&self, [a, b]: [u32; 2]) -> bool {
        self.triangles[a as usize]
            .iter()
            .any(|others| others.contains(&b))
    }

    /// Makes an edge the middle of what is in its ends. Triangles that become the same are one.
    fn collapse(&mut self, [kept, gone]: [u32; 2]) {
        let [k, g] = [kept, gone].map(|v| v as usize);
        let sum = self.weight[k] + self.weight[g];
        let share = self.weight[g] / sum;
        let way = self.at[g] - self.at[k];
        self.at[k] += way * share;
        self.weight[k] = sum;
        self.weight[g] = 0.0;
        for others in std::mem::take(&mut self.triangles[g]) {
            self.move_triangle(others, [kept, gone]);
        }
        for v in std::mem::take(&mut self.neighbours[g]) {
            self.neighbours[v as usize].remove(&gone);
            if v != kept {
                self.neighbours[v as usize].insert(kept);
                self.neighbours[k].insert(v);
            }
        }
    }

    /// Gives a triangle of the vertex that goes to the one that is kept, or drops it.
    fn move_triangle(&mut self, [b, c]: [u32; 2], [kept, gone]: [u32; 2]) {
        for (v, other) in [(b, c), (c, b)] {
            let star = &mut self.triangles[v as usize];
            star.remove(&sorted([gone, other]));
            if v != kept && other != kept {
                star.insert(sorted([kept, other]));
            }
        }
        if b != kept && c != kept {
            self.triangles[kept as usize].insert([b, c]);
        }
    }

    fn into_graph(self, surface: &Surface) -> Graph {
        let nodes: Vec<u32> = surface.vertices().filter(|v| !self.is_gone(*v)).collect();
        let mut number = vec![usize::MAX; self.at.len()];
        for (index, v) in nodes.iter().enumerate() {
            number[*v as usize] = index;
        }
        let mut graph = Graph::default();
        for v in &nodes {
            graph.add(self.at[*v as usize]);
        }
        for (a, v) in nodes.iter().enumerate() {
            for w in &self.neighbours[*v as usize] {
                graph.link([a, number[*w as usize]]);
            }
        }
        graph
    }

    /// Returns true if a vertex went into another.
    fn is_gone(&self, v: u32) -> bool {
        self.weight[v as usize] <= 0.0
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cylinder, torus};

    fn collapse(mesh: &crate::mesh::TriMesh) -> Graph {
        collapse_to_curve(&Surface::of(mesh))
    }

    #[test]
    fn a_thin_rod_becomes_a_line_and_a_thin_ring_a_circle() {
        let rod = collapse(&cylinder(0.01, 10.0, 3));
        assert_eq!(rod.loops(), 0);
        assert!(rod.count() > 1);
        let ring = collapse(&torus(10.0, 0.01, 60, 3));
        assert_eq!(ring.loops(), 1);
        assert!(ring.count() > 10);
    }

    #[test]
    fn no_triangle_is_left_of_a_ball() {
        let graph = collapse(&ball(&Point::origin(), 1.0, 2));
        assert_eq!(graph.loops(), 0);
        assert!(graph.count() < 10);
    }
}
