//! Marching tetrahedra: the pieces of surface inside one tetrahedron.
//!
//! Every piece lies in its own tetrahedron and shares whole edges with its neighbours' pieces. So
//! the surface is a 2-manifold free of self-intersection by construction (Doi & Koide, IEICE Trans.
//! E74, 1991).

use super::roots::{VertexKey, corner_key, crossing_key};
use crate::geom::{CORNER_FIRST, PAIR_FIRST};

/// A triangle or a quadrilateral of surface, counter-clockwise as seen from outside the region.
///
/// Its vertices are known by a name of the type `V`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Piece<V> {
    /// Three vertices.
    Triangle([V; 3]),
    /// Four vertices, not in one plane; either diagonal stays in the tetrahedron.
    Quad([V; 4]),
}

impl<V: Copy> Piece<V> {
    /// Returns the vertices.
    pub fn vertices(&self) -> &[V] {
        match self {
            Self::Triangle(t) => t,
            Self::Quad(q) => q,
        }
    }

    /// Returns the piece with other names for its vertices.
    pub fn renamed<W>(self, rename: impl FnMut(V) -> W) -> Piece<W> {
        match self {
            Self::Triangle(t) => Piece::Triangle(t.map(rename)),
            Self::Quad(q) => Piece::Quad(q.map(rename)),
        }
    }
}

/// Returns the piece of surface that separates the positive corners of a positively oriented
/// tetrahedron from the others. `None` if all are alike.
pub(super) fn piece(corners: [u32; 4], positive: [bool; 4]) -> Option<Piece<VertexKey>> {
    let cross = |i: usize, j: usize| crossing_key(corners[i], corners[j]);
    match positive.iter().filter(|&&p| p).count() {
        0 | 4 => None,
        2 => PAIR_FIRST
            .iter()
            .find(|order| positive[order[0]] && positive[order[1]])
            .map(|&[a, b, c, d]| Piece::Quad([cross(a, c), cross(a, d), cross(b, d), cross(b, c)])),
        count => {
            let apex = positive.iter().position(|&p| p == (count == 1))?;
            let [a, b, c, d] = CORNER_FIRST[apex];
            let [c, d] = if count == 1 { [c, d] } else { [d, c] };
            Some(Piece::Triangle([cross(a, b), cross(a, c), cross(a, d)]))
        }
    }
}

/// Returns the positive part of a tetrahedron's face on the boundary of the octree, as a fan of
/// triangles.
pub(super) fn cap(corners: [u32; 3], positive: [bool; 3]) -> Vec<[VertexKey; 3]> {
    let mut ring: Vec<VertexKey> = Vec::with_capacity(4);
    for i in 0..3 {
        let j = (i + 1) % 3;
        if positive[i] {
            ring.push(corner_key(corners[i]));
        }
        if positive[i] != positive[j] {
            ring.push(crossing_key(corners[i], corners[j]));
        }
    }
    (2..ring.len())
        .map(|k| [ring[0], ring[k - 1], ring[k]])
        .collect()
}
