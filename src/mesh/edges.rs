//! The edges of a mesh, each with the triangle sides that lie on it.

use super::TriMesh;

/// One side of a triangle, filed under the undirected edge it lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// The smaller vertex index of the edge.
    pub low: u32,
    /// The larger vertex index of the edge (equal to `low` when a triangle repeats a corner).
    pub high: u32,
    /// Which side: 3 · triangle + corner the side starts from.
    pub id: u32,
    /// Whether the triangle runs from `low` to `high`.
    pub forward: bool,
}

impl Side {
    /// The triangle this is a side of.
    pub fn triangle(&self) -> usize {
        (self.id / 3) as usize
    }

    /// The corner ids (3 · triangle + corner) at the `low` and the `high` end.
    pub fn corners(&self) -> [u32; 2] {
        let (from, to) = (self.id, next_corner(self.id));
        if self.forward { [from, to] } else { [to, from] }
    }
}

/// The corner after corner `id` in its triangle.
fn next_corner(id: u32) -> u32 {
    if id % 3 == 2 { id - 2 } else { id + 1 }
}

/// What the sides on one edge say about it.
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
    /// The table of `mesh`, in time linear in its triangles: a counting sort by the smaller vertex,
    /// then a sort of the few sides that share it.
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

    /// The sides edge by edge, in the order of (low, high).
    pub fn edges(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.low == b.low && a.high == b.high)
    }

    /// The edges of one kind.
    pub fn of_kind(&self, kind: EdgeKind) -> impl Iterator<Item = &[Side]> {
        self.edges().filter(move |sides| edge_kind(sides) == kind)
    }

    /// How many edges are not shared by exactly two opposed triangles.
    pub fn bad_count(&self) -> usize {
        self.edges()
            .filter(|sides| edge_kind(sides) != EdgeKind::Paired)
            .count()
    }
}

/// What these sides of one edge say about it.
pub(crate) fn edge_kind(sides: &[Side]) -> EdgeKind {
    match sides {
        [side, ..] if side.low == side.high => EdgeKind::Collapsed,
        [_] => EdgeKind::Open,
        [a, b] if a.forward != b.forward => EdgeKind::Paired,
        [_, _] => EdgeKind::Misoriented,
        _ => EdgeKind::Crowded,
    }
}

/// Where the sides filed under each vertex begin.
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

/// Every side of every triangle, in order.
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
