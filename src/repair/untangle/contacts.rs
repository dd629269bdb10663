//! Contacts: the points in which edges pass through triangles, and the segments between them.

use std::collections::BTreeMap;

use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::mesh::crossings::side_of;

/// An edge by its vertices, the smaller index first.
pub(super) type Edge = [u32; 2];

/// The segment in which two triangles cross.
///
/// To its left the first triangle lies behind the second, and the second in front of the first.
/// Left is as seen from in front.
#[derive(Debug, Clone)]
pub(super) struct Segment {
    /// The two triangles, ascending.
    pub triangles: [u32; 2],
    /// Its points from start to end.
    pub points: Vec<u32>,
}

/// The lines along which the triangles of a mesh must be cut.
pub(super) struct Cuts {
    /// The vertices of the mesh, and after them the points of the cuts.
    pub points: Vec<Point>,
    /// The points inside each edge, in the order from its smaller vertex.
    pub on_edge: BTreeMap<Edge, Vec<u32>>,
    /// The segments, in the order of their triangles.
    pub segments: Vec<Segment>,
    /// The point in which an edge passes through a triangle, and its share of the edge.
    known: BTreeMap<(Edge, u32), (f64, u32)>,
}

/// An edge of one triangle that passes through another.
struct Pass {
    edge: Edge,
    /// True if the edge, as its triangle runs along it, comes from in front.
    starts_in_front: bool,
}

impl Cuts {
    /// Finds the segments of pairs of triangles that cross; `None` if a pair also touches at a
    /// place where only a hair decides. The mesh has one vertex at each place.
    pub fn of(mesh: &TriMesh, pairs: &[[u32; 2]]) -> Option<Self> {
        let mut cuts = Self {
            points: mesh.vertices().to_vec(),
            on_edge: BTreeMap::new(),
            segments: Vec::with_capacity(pairs.len()),
            known: BTreeMap::new(),
        };
        for &pair in pairs {
            let segment = cuts.cross(mesh, pair)?;
            cuts.segments.push(segment);
        }
        cuts.sort_along_edges()?;
        Some(cuts)
    }

    /// Returns the segments of each triangle that has some.
    pub fn segments_of_triangles(&self) -> BTreeMap<u32, Vec<usize>> {
        let mut of_triangle: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (index, segment) in self.segments.iter().enumerate() {
            for triangle in segment.triangles {
                of_triangle.entry(triangle).or_default().push(index);
            }
        }
        of_triangle
    }

    /// Returns the segment in which a pair crosses.
    fn cross(&mut self, mesh: &TriMesh, [a, b]: [u32; 2]) -> Option<Segment> {
        let names = [a, b].map(|t| mesh.triangles()[t as usize]);
        let shared: Vec<u32> = names[0]
            .into_iter()
            .filter(|v| names[1].contains(v))
            .collect();
        let (mut starts, mut ends) = (Vec::new(), Vec::new());
        for (one, other) in [(a, b), (b, a)] {
            for pass in passes(mesh, one, other)? {
                let point = self.point(mesh, pass.edge, other)?;
                if (one == a) == pass.starts_in_front {
                    ends.push(point);
                } else {
                    starts.push(point);
                }
            }
        }
        match (shared.as_slice(), starts.as_slice(), ends.as_slice()) {
            ([], &[start], &[end]) | (&[end], &[start], []) | (&[start], [], &[end]) => {
                let (triangles, points) = ([a, b], vec![start, end]);
                Some(Segment { triangles, points })
            }
            _ => None,
        }
    }

    /// Returns the point in which an edge passes through a triangle, the same each time.
    fn point(&mut self, mesh: &TriMesh, edge: Edge, triangle: u32) -> Option<u32> {
        if let Some((_, point)) = self.known.get(&(edge, triangle)) {
            return Some(*point);
        }
        let [low, high] = edge.map(|v| mesh.vertices()[v as usize]);
        let share = share_at_plane(&low, &high, &mesh.corners(triangle as usize))?;
        let place = low + (high - low) * share;
        let point = self.points.len() as u32;
        self.points.push(place);
        self.known.insert((edge, triangle), (share, point));
        (place != low && place != high).then_some(point)
    }

    /// Sorts the points along each edge; `None` if two lie at one place.
    fn sort_along_edges(&mut self) -> Option<()> {
        let mut on_edge: BTreeMap<Edge, Vec<(f64, u32)>> = BTreeMap::new();
        for ((edge, _), contact) in &self.known {
            on_edge.entry(*edge).or_default().push(*contact);
        }
        for (edge, mut contacts) in on_edge {
            contacts.sort_by(|a, b| a.0.total_cmp(&b.0));
            let is_clear = contacts.windows(2).all(|pair| pair[0].0 < pair[1].0);
            is_clear.then_some(())?;
            let points = contacts.into_iter().map(|(_, point)| point).collect();
            self.on_edge.insert(edge, points);
        }
        Some(())
    }
}

/// Returns the share of the segment from `low` to `high` at which it meets the triangle's plane;
/// `None` if that is not between them.
pub(super) fn share_at_plane(low: &Point, high: &Point, [a, b, c]: &[Point; 3]) -> Option<f64> {
    let normal = (b - a).cross(&(c - a));
    let [from, to] = [low, high].map(|p| normal.dot(&(p - a)));
    let share = from / (from - to);
    (share > 0.0 && share < 1.0).then_some(share)
}

/// Returns the edges of one triangle that pass through another; `None` if one only touches it.
/// Edges at a common corner cannot pass.
fn passes(mesh: &TriMesh, one: u32, other: u32) -> Option<Vec<Pass>> {
    let names = mesh.triangles()[one as usize];
    let [corners, face] = [one, other].map(|t| mesh.corners(t as usize));
    let is_shared = names.map(|v| mesh.triangles()[other as usize].contains(&v));
    let sides = corners.map(|p| side_of(&face, &p));
    let touches = (0..3).any(|i| !is_shared[i] && sides[i] == 0);
    (!touches).then_some(())?;
    let mut found = Vec::with_capacity(2);
    for i in 0..3 {
        let j = (i + 1) % 3;
        if is_shared[i] || is_shared[j] || sides[i] == sides[j] {
            continue;
        }
        if is_inside(&corners[i], &corners[j], &face)? {
            found.push(Pass {
                edge: [names[i].min(names[j]), names[i].max(names[j])],
                starts_in_front: sides[i] < 0,
            });
        }
    }
    Some(found)
}

/// Returns true if the line through p and q passes inside the face; `None` if it meets its rim.
fn is_inside(p: &Point, q: &Point, [a, b, c]: &[Point; 3]) -> Option<bool> {
    let turns = [(a, b), (b, c), (c, a)].map(|(from, to)| side_of(&[*p, *q, *from], to));
    if turns.contains(&1) && turns.contains(&-1) {
        return Some(false);
    }
    (!turns.contains(&0)).then_some(true)
}
