//! Pieces: the parts into which the segments cut the triangles.

use std::collections::{BTreeMap, BTreeSet};

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::contacts::{Cuts, Edge};
use super::knots::View;
use crate::mesh::TriMesh;

/// A part of a segment between two points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seam {
    /// The two triangles that cross in it.
    pub triangles: [u32; 2],
    /// The point where it starts, in the direction of its segment.
    pub start: u32,
}

/// The triangles of a mesh, cut along all segments.
pub(super) struct Pieces {
    /// The pieces by their points, facing as before.
    pub triangles: Vec<[u32; 3]>,
    /// The triangle of which each piece is a part.
    pub parents: Vec<u32>,
    /// The parts of segments by their points.
    pub seams: BTreeMap<Edge, Seam>,
}

impl Pieces {
    /// Cuts the triangles; `None` if rounding folded a part, or two segments share one.
    pub fn of(mesh: &TriMesh, cuts: &Cuts) -> Option<Self> {
        let mut pieces = Self {
            triangles: Vec::with_capacity(mesh.triangles().len()),
            parents: Vec::with_capacity(mesh.triangles().len()),
            seams: seams(cuts)?,
        };
        let segments = cuts.segments_of_triangles();
        for (index, &triangle) in mesh.triangles().iter().enumerate() {
            let parent = index as u32;
            let own = segments.get(&parent).map_or(&[][..], Vec::as_slice);
            let rim = rim(cuts, triangle);
            let parts = if own.is_empty() && rim.len() == 3 {
                vec![triangle]
            } else {
                let lines: Vec<&[u32]> =
                    own.iter().map(|&s| &cuts.segments[s].points[..]).collect();
                let view = View::of(&mesh.corners(index));
                triangulate(cuts, &view, &rim, &lines)?
            };
            pieces.parents.extend(parts.iter().map(|_| parent));
            pieces.triangles.extend(parts);
        }
        Some(pieces)
    }
}

/// Returns the parts of all segments; `None` if two coincide.
fn seams(cuts: &Cuts) -> Option<BTreeMap<Edge, Seam>> {
    let mut seams = BTreeMap::new();
    for segment in &cuts.segments {
        for part in segment.points.windows(2) {
            let seam = Seam {
                triangles: segment.triangles,
                start: part[0],
            };
            let is_known = seams.insert(edge(part[0], part[1]), seam).is_some();
            (!is_known).then_some(())?;
        }
    }
    Some(seams)
}

fn edge(a: u32, b: u32) -> Edge {
    [a.min(b), a.max(b)]
}

/// Returns the corners of a triangle and the points on its edges, in their order around it.
fn rim(cuts: &Cuts, [a, b, c]: [u32; 3]) -> Vec<u32> {
    let mut rim = Vec::with_capacity(3);
    for (from, to) in [(a, b), (b, c), (c, a)] {
        rim.push(from);
        let inner = cuts
            .on_edge
            .get(&edge(from, to))
            .map_or(&[][..], Vec::as_slice);
        if from < to {
            rim.extend(inner);
        } else {
            rim.extend(inner.iter().rev());
        }
    }
    rim
}

/// Triangulates the inside of a rim so that all lines are edges (constrained Delaunay: Shewchuk,
/// "General-dimensional constrained Delaunay and constrained regular triangulations", DCG 39,
/// 2008).
fn triangulate(cuts: &Cuts, view: &View, rim: &[u32], lines: &[&[u32]]) -> Option<Vec<[u32; 3]>> {
    let mut names: Vec<u32> = rim
        .iter()
        .chain(lines.iter().copied().flatten())
        .copied()
        .collect();
    names.sort_unstable();
    names.dedup();
    let mut flat = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut handles = BTreeMap::new();
    for &name in &names {
        let at = view.at(&cuts.points[name as usize]);
        handles.insert(name, flat.insert(Point2::new(at.x, at.y)).ok()?);
    }
    // Two points at one place would have become one.
    (flat.num_vertices() == names.len()).then_some(())?;
    let closing = [rim[rim.len() - 1], rim[0]];
    let around = rim.windows(2).chain([&closing[..]]);
    for part in around
        .clone()
        .chain(lines.iter().flat_map(|line| line.windows(2)))
    {
        let (from, to) = (*handles.get(&part[0])?, *handles.get(&part[1])?);
        flat.can_add_constraint(from, to).then_some(())?;
        flat.add_constraint(from, to);
        // A point on the line would have cut it.
        flat.get_edge_from_neighbors(from, to)?;
    }
    let mut open = Vec::new();
    let mut walls = BTreeSet::new();
    for part in around {
        let side =
            flat.get_edge_from_neighbors(*handles.get(&part[0])?, *handles.get(&part[1])?)?;
        walls.insert(side.as_undirected().fix().index());
        open.push(side.face().as_inner()?.fix());
    }
    let mut parts = Vec::new();
    let mut seen = BTreeSet::new();
    while let Some(face) = open.pop() {
        if !seen.insert(face.index()) {
            continue;
        }
        let face = flat.face(face);
        parts.push(face.vertices().map(|v| names[v.index()]));
        let inner = face.adjacent_edges().into_iter();
        let inner = inner.filter(|side| !walls.contains(&side.as_undirected().fix().index()));
        open.extend(
            inner
                .filter_map(|side| side.rev().face().as_inner())
                .map(|face| face.fix()),
        );
    }
    Some(parts)
}
