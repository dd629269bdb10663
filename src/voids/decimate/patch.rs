//! A part of a mesh as half-edges, in which vertices can be merged.

use super::parts::{Parts, State};
use crate::geom::{Point, Vector};

/// The index that means "no half-edge, no point, no vertex".
pub(super) const NIL: u32 = u32::MAX;

/// A part of a mesh. Triangle t has the half-edges 3t, 3t + 1 and 3t + 2, counter-clockwise.
pub(super) struct Patch {
    /// Number of each vertex in the mesh.
    names: Vec<u32>,
    /// Place of each vertex.
    pub points: Vec<Point>,
    /// Vertex at which each half-edge starts.
    pub start: Vec<u32>,
    /// Opposite half-edge, or [`NIL`] on the patch's border.
    pub twin: Vec<u32>,
    /// Some half-edge that starts at each vertex.
    pub leaving: Vec<u32>,
    /// For each vertex, whether it must stay.
    pub is_locked: Vec<bool>,
    /// For each vertex, whether its triangles form several fans, as they may at the patch's
    /// corners.
    pub is_pinched: Vec<bool>,
    /// For each vertex, the squared length up to which its edges were tried without success since a
    /// neighbour changed, mm².
    pub tried: Vec<f64>,
    /// For each triangle, whether it is still there.
    pub is_alive: Vec<bool>,
    /// For each triangle, the first of the removed vertices that it stands for.
    pub first_point: Vec<u32>,
    /// For each removed vertex, the next one of the same triangle.
    pub next_point: Vec<u32>,
}

/// Returns the next half-edge of the same triangle.
#[inline]
pub(super) fn next(edge: u32) -> u32 {
    if edge % 3 == 2 { edge - 2 } else { edge + 1 }
}

/// Returns the previous half-edge of the same triangle.
#[inline]
pub(super) fn last(edge: u32) -> u32 {
    if edge.is_multiple_of(3) {
        edge + 2
    } else {
        edge - 1
    }
}

/// Returns twice the area vector of a triangle.
#[inline]
pub(super) fn area_vector([a, b, c]: &[Point; 3]) -> Vector {
    (b - a).cross(&(c - a))
}

impl Patch {
    /// Returns the patch of the triangles `slab`. Vertices on its border must stay, and so must
    /// those for which `is_locked` holds.
    pub fn new(
        state: &State,
        vertices: &[Point],
        slab: &[u32],
        is_locked: &impl Fn(u32) -> bool,
    ) -> Self {
        let corners = || slab.iter().flat_map(|&t| state.parts.triangles[t as usize]);
        let removed = || {
            (0..)
                .zip(slab)
                .flat_map(|(i, &t)| state.parts.points_of(t).iter().map(move |&p| (i, p)))
        };
        let (names, numbers) = number_names(
            vertices.len(),
            corners().chain(removed().map(|(_, name)| name)),
        );
        let local = |name: u32| numbers[name as usize];
        let start: Vec<u32> = corners().map(local).collect();
        let mut patch = Self {
            points: names.iter().map(|&name| vertices[name as usize]).collect(),
            twin: twins(&start),
            leaving: vec![NIL; names.len()],
            is_locked: names.iter().map(|&name| is_locked(name)).collect(),
            is_pinched: vec![false; names.len()],
            tried: names
                .iter()
                .map(|&name| {
                    if state.is_open[name as usize] {
                        -1.0
                    } else {
                        f64::INFINITY
                    }
                })
                .collect(),
            is_alive: vec![true; slab.len()],
            first_point: vec![NIL; slab.len()],
            next_point: vec![NIL; names.len()],
            start,
            names,
        };
        for (edge, &v) in patch.start.iter().enumerate() {
            patch.leaving[v as usize] = edge as u32;
        }
        patch.find_pinched();
        removed().for_each(|(triangle, name)| patch.give(triangle, local(name)));
        patch
    }

    /// Marks the vertices that have more triangles than one fan holds.
    fn find_pinched(&mut self) {
        let mut named = vec![0usize; self.points.len()];
        self.start.iter().for_each(|&v| named[v as usize] += 1);
        let mut fan = Vec::new();
        for v in 0..self.points.len() as u32 {
            if self.leaving[v as usize] != NIL {
                let is_closed = self.fan(v, &mut fan);
                let in_fan = if is_closed {
                    fan.len()
                } else {
                    self.open_fan_size(v)
                };
                self.is_pinched[v as usize] = in_fan != named[v as usize];
            }
        }
    }

    /// Returns the number of triangles in the open fan of a vertex: one less than its neighbours.
    fn open_fan_size(&self, v: u32) -> usize {
        let mut found = Vec::new();
        self.neighbours(v, &mut found);
        found.len() - 1
    }

    /// Returns the triangles that are left, in the mesh's own numbers.
    pub fn into_parts(self) -> Parts {
        let name = |v: u32| self.names[v as usize];
        let mut parts = Parts::default();
        for t in (0..self.is_alive.len() as u32).filter(|&t| self.is_alive[t as usize]) {
            let corners = [0, 1, 2].map(|k| name(self.start[(3 * t + k) as usize]));
            parts.push(corners, self.points_of(t).map(name));
        }
        parts
    }

    /// Lets a triangle stand for a removed vertex.
    #[inline]
    pub fn give(&mut self, triangle: u32, point: u32) {
        self.next_point[point as usize] = self.first_point[triangle as usize];
        self.first_point[triangle as usize] = point;
    }

    /// Returns the removed vertices that a triangle stands for.
    #[inline]
    pub fn points_of(&self, triangle: u32) -> impl Iterator<Item = u32> + '_ {
        let some = |point: u32| (point != NIL).then_some(point);
        std::iter::successors(some(self.first_point[triangle as usize]), move |&point| {
            some(self.next_point[point as usize])
        })
    }

    /// Returns the vertex at which a half-edge ends.
    #[inline]
    pub fn end(&self, edge: u32) -> u32 {
        self.start[next(edge) as usize]
    }

    /// Writes the half-edges that leave a vertex, clockwise, into `fan`. Returns false if the
    /// vertex is on the border.
    #[inline]
    pub fn fan(&self, v: u32, fan: &mut Vec<u32>) -> bool {
        fan.clear();
        let first = self.leaving[v as usize];
        let mut edge = first;
        loop {
            fan.push(edge);
            edge = self.twin[edge as usize];
            if edge == NIL {
                return false;
            }
            edge = next(edge);
            if edge == first {
                return true;
            }
        }
    }

    /// Writes the neighbours of a vertex, also of one on the border, into `found`.
    #[inline]
    pub fn neighbours(&self, v: u32, found: &mut Vec<u32>) {
        let is_closed = self.fan(v, found);
        let first = found[0];
        found.iter_mut().for_each(|edge| *edge = self.end(*edge));
        if is_closed {
            return;
        }
        let mut edge = first;
        loop {
            let arriving = last(edge);
            found.push(self.start[arriving as usize]);
            edge = self.twin[arriving as usize];
            if edge == NIL {
                return;
            }
        }
    }
}

/// Returns the names in use among `count`, in ascending order, and the index of each name among
/// them.
fn number_names(count: usize, used: impl Iterator<Item = u32>) -> (Vec<u32>, Vec<u32>) {
    let mut numbers = vec![NIL; count];
    used.for_each(|name| numbers[name as usize] = 0);
    let mut names = Vec::new();
    for (name, number) in (0..)
        .zip(&mut numbers)
        .filter(|(_, number)| **number != NIL)
    {
        *number = names.len() as u32;
        names.push(name);
    }
    (names, numbers)
}

/// Returns for each half-edge the one that runs the other way.
fn twins(start: &[u32]) -> Vec<u32> {
    let end = |edge: u32| start[next(edge) as usize];
    let key = |edge: u32| {
        let (a, b) = (start[edge as usize], end(edge));
        (u64::from(a.min(b)) << 32) | u64::from(a.max(b))
    };
    let mut keyed: Vec<(u64, u32)> = (0..start.len() as u32)
        .map(|edge| (key(edge), edge))
        .collect();
    keyed.sort_unstable();
    let mut twin = vec![NIL; start.len()];
    for pair in keyed.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        twin[pair[0].1 as usize] = pair[1].1;
        twin[pair[1].1 as usize] = pair[0].1;
    }
    twin
}
