//! The edges of a mesh, each with the sides of triangles that lie on it.

use super::TriMesh;

/// One side of a triangle, with the undirected edge on which it lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// The smaller vertex index of the edge.
    pub low: u32,
    /// The larger vertex index of the edge (equal to `low` if a triangle repeats a corner).
    pub high: u32,
    /// Identifier of the side: 3 · triangle + the corner where it starts.
    pub id: u32,
    /// True if the triangle runs from `low` to `high`.
    pub forward: bool,
}

impl Side {
    /// Returns the triangle to which the side belongs.
    pub fn triangle(&self) -> usize {
        (self.id / 3) as usize
    }

    /// Returns the corner ids (3 · triangle + corner) at the `low` and the `high` end.
    pub fn corners(&self) -> [u32; 2] {
        let (from, to) = (self.id, next_corner(self.id));
        if self.forward { [from, to] } else { [to, from] }
    }
}

/// Returns the corner after corner `id` in its triangle.
fn next_corner(id: u32) -> u32 {
    if id % 3 == 2 { id - 2 } else { id + 1 }
}

/// The kinds of edges, by the sides that lie on them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EdgeKind {
    /// Two triangles that run along it in opposite directions.
    Paired,
    /// One triangle only: the rim of a hole.
    Open,
    /// Two triangles that run along it in the same direction.
    Misoriented,
    /// Three or more triangles.
    Crowded,
    /// A triangle that repeats a corner.
    Collapsed,
}

/// Every side of a mesh, sorted by edge.
#[derive(Debug, Clone)]
pub(crate) struct EdgeTable(Vec<Side>);

impl EdgeTable {
    /// Builds the table of `mesh` in time linear in its triangles. A counting sort by the
    /// smaller vertex comes first, then a sort of the few sides that share it.
    pub fn of(mesh: &TriMesh) -> Self {
        let mut ends = bucket_starts(mesh);
        let mut sides = vec![
            Side {
                low: 0,
                high: 0,
                id: 0,
                forward: true
            };
            mesh.triangles().len() * 3
        ];
        for side in all_sides(mesh) {
            let end = &mut ends[side.low as usize];
            sides[*end as usize] = side;
            *end += 1;
        }
        let mut start = 0;
        for end in ends {
            sides[start..end as usize].sort_unstable();
            start = end as usize;
        }
        Self(sides)
    }

    /// Returns the sides edge by edge, in the order of (low, high).
    pub fn edges(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.low == b.low && a.high == b.high)
    }

    /// Returns the edges of one kind.
    pub fn of_kind(&self, kind: EdgeKind) -> impl Iterator<Item = &[Side]> {
        self.edges().filter(move |sides| edge_kind(sides) == kind)
    }

    /// Counts the edges that are not shared by exactly two triangles that run in opposite
    /// directions.
    pub fn bad_count(&self) -> usize {
        self.edges()
            .filter(|sides| edge_kind(sides) != EdgeKind::Paired)
            .count()
    }
}

/// Returns the kind of the edge on which exactly these sides lie.
pub(crate) fn edge_kind(sides: &[Side]) -> EdgeKind {
    match sides {
        [side, ..] if side.low == side.high => EdgeKind::Collapsed,
        [_] => EdgeKind::Open,
        [a, b] if a.forward != b.forward => EdgeKind::Paired,
        [_, _] => EdgeKind::Misoriented,
        _ => EdgeKind::Crowded,
    }
}

/// Returns, for each vertex, the index where the sides with this `low` begin.
fn bucket_starts(mesh: &TriMesh) -> Vec<u32> {
    let mut counts = vec![0u32; mesh.vertices().len()];
    for side in all_sides(mesh) {
        counts[side.low as usize] += 1;
    }
    let mut start = 0;
    for count in &mut counts {
        start += std::mem::replace(count, start);
    }
    counts
}

/// Returns every side of every triangle, in order.
fn all_sides(mesh: &TriMesh) -> impl Iterator<Item = Side> + '_ {
    mesh.triangles()
        .iter()
        .enumerate()
        .flat_map(|(triangle, &[a, b, c])| {
            [(a, b), (b, c), (c, a)]
                .into_iter()
                .zip(3 * triangle as u32..)
                .map(|((from, to), id)| Side {
                    low: from.min(to),
                    high: from.max(to),
                    id,
                    forward: from < to,
                })
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::ball;

    #[test]
    fn a_closed_mesh_has_three_edges_for_two_triangles_and_all_are_paired() {
        let mesh = ball(&Point::origin(), 1.0, 2);
        let table = EdgeTable::of(&mesh);
        assert_eq!(2 * table.edges().count(), 3 * mesh.triangles().len());
        assert_eq!(table.bad_count(), 0);
    }

    #[test]
    fn the_corners_of_a_side_are_at_the_ends_of_its_edge() {
        let mesh = ball(&Point::origin(), 1.0, 1);
        for side in EdgeTable::of(&mesh).edges().flatten() {
            let ends = side
                .corners()
                .map(|id| mesh.triangles()[id as usize / 3][id as usize % 3]);
            assert_eq!(ends, [side.low, side.high]);
        }
    }

    #[test]
    fn every_kind_of_edge_is_told_apart() {
        let points = (0..5)
            .map(|i| Point::new(f64::from(i), f64::from(i * i), 1.0))
            .collect::<Vec<_>>();
        let kinds = |triangles: &[[u32; 3]]| {
            let mesh = TriMesh::new(points.clone(), triangles.to_vec()).unwrap();
            EdgeTable::of(&mesh)
                .edges()
                .map(edge_kind)
                .collect::<Vec<_>>()
        };
        use EdgeKind::{Collapsed, Crowded, Misoriented, Open, Paired};
        assert_eq!(kinds(&[[0, 1, 2]]), [Open; 3]);
        assert_eq!(kinds(&[[0, 1, 2], [1, 0, 3]])[0], Paired);
        assert_eq!(kinds(&[[0, 1, 2], [0, 1, 3]])[0], Misoriented);
        assert_eq!(kinds(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]])[0], Crowded);
        assert_eq!(kinds(&[[0, 0, 1]]), [Collapsed, Paired]);
    }
}
