//! A cell at the surface as a body, face by face.
//!
//! The triangles of the model near a cell are cut by its planes. What is left of them are faces of
//! the body, and each cut edge lies on a side of the cell. The sides are closed by rings of cut
//! edges and of those parts of the cell's own edges that lie in the model. No side is larger than
//! the cell, so this is quick. Where a plane passes through a corner, nothing is returned.

use std::collections::{BTreeMap, HashMap};

use super::body::{Body, Welded};
use super::chain::cross;
use super::polytope::{Beyond, Polytope};
use super::tree::{Tree, overlap};
use crate::geom::{Aabb, Plane, Point};
use crate::mesh::{TriMesh, fill_rings};

/// Room around a cell at the side of the model's box, as a part of its size: the box is no side.
const ROOM_RATIO: f64 = 0.0123;
/// Boxes along each axis by whose order triangles are sorted, as a power of two.
const SORT_BITS: u32 = 7;

/// The triangles of a model, sorted for those near a cell.
pub(super) struct Surface<'a> {
    mesh: &'a TriMesh,
    order: Vec<usize>,
    tree: Tree,
}

impl<'a> Surface<'a> {
    pub fn new(mesh: &'a TriMesh) -> Self {
        let bounds = mesh.aabb();
        let size = bounds.size().map(|side| side.max(f64::MIN_POSITIVE));
        let place = |index: usize| {
            let [a, b, c] = mesh.corners(index);
            let middle = (a.coords + b.coords + c.coords) / 3.0 - bounds.min.coords;
            let at = [0, 1, 2].map(|axis| {
                let share = middle[axis] / size[axis] * f64::from(1_u32 << SORT_BITS);
                (share as u32).min((1 << SORT_BITS) - 1)
            });
            (0..SORT_BITS).fold(0_u32, |key, bit| {
                let bits = (0..3).map(|axis| (at[axis] >> bit & 1) << (3 * bit + axis as u32));
                key | bits.sum::<u32>()
            })
        };
        let mut order: Vec<usize> = (0..mesh.triangles().len()).collect();
        order.sort_by_key(|&index| (place(index), index));
        let boxes = order
            .iter()
            .map(|&index| Aabb::of_points(&mesh.corners(index)));
        let tree = Tree::new(boxes.collect());
        Self { mesh, order, tree }
    }

    /// Returns the triangles whose boxes overlap another box.
    fn near(&self, bounds: &Aabb) -> Vec<[Point; 3]> {
        let found = self.tree.find(|one| is_near(one, bounds));
        let found = found.into_iter();
        found
            .map(|index| self.mesh.corners(self.order[index]))
            .collect()
    }
}

/// Returns true if two boxes overlap, also if one of them is flat.
fn is_near(one: &Aabb, other: &Aabb) -> bool {
    overlap(one, other)
        || (0..3).all(|axis| one.min[axis] <= other.max[axis] && other.min[axis] <= one.max[axis])
}

/// Returns the part of a model in a polytope; `None` where a plane meets a corner or rings do not
/// close. `is_inside` tells if a point lies in the model.
pub(super) fn cut(
    surface: &Surface<'_>,
    polytope: &Polytope,
    is_inside: impl Fn(&Point) -> bool,
) -> Option<Body> {
    let grown = grown(polytope);
    let welded = Welded::of(&grown)?;
    let planes = welded
        .faces
        .iter()
        .map(|(face, _)| grown.faces()[*face].plane);
    let planes: Vec<Plane> = planes.collect();
    let mut cut = Cut {
        edges: edges_of(&welded),
        planes,
        welded,
        points: HashMap::new(),
        body: Body::default(),
        cuts: Vec::new(),
    };
    cut.cuts = vec![Vec::new(); cut.planes.len()];
    for corners in surface.near(&grown.bounds()) {
        cut.add(&corners)?;
    }
    cut.close(is_inside)?;
    Some(cut.body)
}

/// Returns a polytope that reaches beyond the box around the model where that was its side.
fn grown(polytope: &Polytope) -> Polytope {
    let bounds = polytope.bounds();
    let mut grown = Polytope::of_box(&bounds.inflated(ROOM_RATIO * bounds.size().max()));
    for face in polytope.faces() {
        if face.beyond != Beyond::Room {
            grown.cut(&face.plane, face.beyond);
        }
    }
    grown
}

/// An edge of a polytope, from its corner of the lesser number.
#[derive(Debug, Default)]
struct Edge {
    /// The faces on both sides.
    faces: Vec<usize>,
    /// The places where the surface crosses it: how far along it, the corner, and true if one
    /// leaves the model there.
    crossings: Vec<(f64, u32, bool)>,
}

/// The edges by the numbers of their corners.
type Edges = BTreeMap<[u32; 2], Edge>;

fn edges_of(welded: &Welded) -> Edges {
    let mut edges = Edges::new();
    for (face, (_, ring)) in welded.faces.iter().enumerate() {
        for [a, b] in sides(ring) {
            edges
                .entry([a.min(b), a.max(b)])
                .or_default()
                .faces
                .push(face);
        }
    }
    edges
}

fn sides(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(&a, &b)| [a, b])
}

/// A body while it is cut.
struct Cut {
    planes: Vec<Plane>,
    welded: Welded,
    edges: Edges,
    /// The corners of the body by their bits.
    points: HashMap<[u64; 3], u32>,
    body: Body,
    /// The cut edges on each face, as they run around that face.
    cuts: Vec<Vec<[u32; 2]>>,
}

impl Cut {
    /// Returns the number of a corner of the body.
    fn corner(&mut self, at: &Point) -> u32 {
        let bits = [at.x, at.y, at.z].map(|x| (x + 0.0).to_bits());
        let next = self.body.corners.len() as u32;
        let found = *self.points.entry(bits).or_insert(next);
        if found == next {
            self.body.corners.push(*at);
        }
        found
    }

    /// Adds what is in the polytope of a triangle.
    fn add(&mut self, corners: &[Point; 3]) -> Option<()> {
        let ring = clipped(corners, &self.planes)?;
        if ring.is_empty() {
            return Some(());
        }
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let numbers: Vec<u32> = ring.iter().map(|(at, _)| self.corner(at)).collect();
        for (k, &(at, face)) in ring.iter().enumerate() {
            let before = ring[(k + ring.len() - 1) % ring.len()].1;
            let Some(face) = face else {
                continue;
            };
            let next = numbers[(k + 1) % ring.len()];
            if next != numbers[k] {
                self.cuts[face].push([next, numbers[k]]);
            }
            if let Some(before) = before.filter(|before| *before != face) {
                let is_between =
                    |edge: &&mut Edge| edge.faces.contains(&face) && edge.faces.contains(&before);
                let mut edges = self.edges.iter_mut();
                let (ends, edge) = edges.find(|(_, edge)| is_between(edge))?;
                let [from, to] = ends.map(|end| self.welded.corners[end as usize]);
                let along = to - from;
                let leaves = normal.dot(&along) > 0.0;
                edge.crossings
                    .push((along.dot(&(at - from)), numbers[k], leaves));
            }
        }
        let mut face = numbers;
        face.dedup();
        if face.len() > 1 && face.first() == face.last() {
            face.pop();
        }
        // A face that is but a line counts by its cut edges, which cancel.
        if face.len() >= 3 {
            self.body.faces.push(face);
        }
        Some(())
    }

    /// Closes the sides of the cell.
    fn close(&mut self, is_inside: impl Fn(&Point) -> bool) -> Option<()> {
        for edge in self.edges.values_mut() {
            edge.crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let inside = self.corners_inside(is_inside)?;
        let mut parts: Vec<Vec<[u32; 2]>> = Vec::new();
        let mut along = HashMap::new();
        let edges = std::mem::take(&mut self.edges);
        for (ends, edge) in &edges {
            along.insert(*ends, parts.len());
            let part = self.parts_inside(*ends, edge, inside[ends[0] as usize])?;
            parts.push(part);
        }
        for face in 0..self.planes.len() {
            let mut rim = std::mem::take(&mut self.cuts[face]);
            let is_whole = rim.is_empty();
            for [a, b] in sides(&self.welded.faces[face].1.clone()) {
                let part = &parts[*along.get(&[a.min(b), a.max(b)])?];
                rim.extend(
                    part.iter()
                        .map(|&[from, to]| if a < b { [from, to] } else { [to, from] }),
                );
            }
            self.add_side(face, &rim, is_whole)?;
        }
        Some(())
    }

    /// Tells of each corner of the polytope if it lies in the model.
    fn corners_inside(&self, is_inside: impl Fn(&Point) -> bool) -> Option<Vec<bool>> {
        let mut known: Vec<Option<bool>> = vec![None; self.welded.corners.len()];
        let mut say = |corner: u32, value: bool| {
            let known = &mut known[corner as usize];
            (*known.get_or_insert(value) == value).then_some(())
        };
        for (ends, edge) in &self.edges {
            if let (Some(first), Some(last)) = (edge.crossings.first(), edge.crossings.last()) {
                say(ends[0], first.2)?;
                say(ends[1], !last.2)?;
            }
        }
        if known.iter().all(Option::is_none) {
            let value = self.welded.corners.first().is_some_and(is_inside);
            return Some(vec![value; known.len()]);
        }
        // Along an edge without a crossing both corners lie on the same side.
        for _ in 0..known.len() {
            for (ends, edge) in &self.edges {
                let [a, b] = ends.map(|end| end as usize);
                if !edge.crossings.is_empty() {
                    continue;
                }
                match [known[a], known[b]] {
                    [Some(one), Some(other)] if one != other => return None,
                    [Some(_), None] => known[b] = known[a],
                    [None, Some(_)] => known[a] = known[b],
                    _ => {}
                }
            }
            if known.iter().all(Option::is_some) {
                break;
            }
        }
        known.into_iter().collect()
    }

    /// Returns the parts of an edge in the model; `None` if crossings do not alternate.
    fn parts_inside(&mut self, ends: [u32; 2], edge: &Edge, starts: bool) -> Option<Vec<[u32; 2]>> {
        let [first, last] = ends.map(|end| self.welded.corners[end as usize]);
        let mut parts = Vec::new();
        let mut open = starts.then(|| self.corner(&first));
        for &(_, corner, leaves) in &edge.crossings {
            match (leaves, open.take()) {
                (true, Some(from)) => parts.push([from, corner]),
                (false, None) => open = Some(corner),
                _ => return None,
            }
        }
        if let Some(from) = open {
            parts.push([from, self.corner(&last)]);
        }
        parts.retain(|[from, to]| from != to);
        Some(parts)
    }

    /// Adds a side of the cell, bounded by a rim.
    fn add_side(&mut self, face: usize, rim: &[[u32; 2]], is_whole: bool) -> Option<()> {
        let mut rings = rings(rim)?;
        rings.retain(|ring| ring.len() >= 3);
        let plane = self.planes[face];
        match &rings[..] {
            [] => {}
            [ring] if is_whole || self.is_convex(ring, &plane) => {
                self.body.faces.push(ring.clone());
            }
            _ => {
                let rings = rings
                    .iter()
                    .map(|ring| ring.iter().map(|&at| at as usize).collect());
                let rings: Vec<Vec<usize>> = rings.collect();
                let filled = fill_rings(&rings, &self.body.corners, &plane)?;
                self.body
                    .faces
                    .extend(filled.iter().map(|corners| corners.to_vec()));
            }
        }
        Some(())
    }

    fn is_convex(&self, ring: &[u32], plane: &Plane) -> bool {
        let at = |k: usize| self.body.corners[ring[k % ring.len()] as usize];
        let mut turns = (0..ring.len()).map(|k| {
            let [a, b, c] = [at(k), at(k + 1), at(k + 2)];
            (b - a).cross(&(c - b)).dot(&plane.normal)
        });
        // A ring that runs around twice has turns to one side only, too.
        let turned = (0..ring.len()).map(|k| {
            let [a, b, c] = [at(k), at(k + 1), at(k + 2)];
            let [one, other] = [b - a, c - b];
            one.cross(&other).dot(&plane.normal).atan2(one.dot(&other))
        });
        let full = std::f64::consts::TAU;
        turns.all(|turn| turn > 0.0) && (turned.sum::<f64>() - full).abs() < 0.5 * full
    }
}

/// Links directed edges into rings; `None` if more than one begins or ends in a corner.
fn rings(rim: &[[u32; 2]]) -> Option<Vec<Vec<u32>>> {
    let mut next: HashMap<u32, u32> = HashMap::new();
    for &[from, to] in rim {
        if next.insert(from, to).is_some() {
            return None;
        }
    }
    let mut rings = Vec::new();
    for &[start, _] in rim {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            ring.push(at);
            at = to;
        }
        if at != start {
            return None;
        }
        if !ring.is_empty() {
            rings.push(ring);
        }
    }
    Some(rings)
}

/// A corner, and the plane in which the edge after it lies; `None` for an edge of the triangle.
type Tagged = (Point, Option<usize>);

/// Returns the part of a triangle below all planes; `None` if a plane passes through a corner.
fn clipped(corners: &[Point; 3], planes: &[Plane]) -> Option<Vec<Tagged>> {
    let mut ring: Vec<Tagged> = corners.map(|at| (at, None)).to_vec();
    for (face, plane) in planes.iter().enumerate() {
        let heights: Vec<f64> = ring.iter().map(|(at, _)| plane.distance(at)).collect();
        if heights.iter().all(|height| *height < 0.0) {
            continue;
        }
        if heights.iter().all(|height| *height > 0.0) {
            return Some(Vec::new());
        }
        if heights.contains(&0.0) {
            return None;
        }
        let before = std::mem::take(&mut ring);
        for (k, &(from, tag)) in before.iter().enumerate() {
            let next = (k + 1) % before.len();
            let [here, there] = [heights[k], heights[next]];
            if here < 0.0 {
                ring.push((from, tag));
            }
            if (here < 0.0) != (there < 0.0) {
                let crossing = cross([from, before[next].0], [here, there]);
                ring.push((crossing, if here < 0.0 { Some(face) } else { tag }));
            }
        }
    }
    Some(ring)
}
