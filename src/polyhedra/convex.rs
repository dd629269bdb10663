//! A convex body bounded by planes: its corners, its faces and their measures.

use std::collections::BTreeMap;

use crate::geom::{Aabb, Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Corners nearer to a plane than this share of the body's size count as on it.
///
/// Below 1e-13 rounding makes edges of no length. Above 1e-9 corners stand out by more than files
/// keep.
const ON_PLANE_RATIO: f64 = 1e-12;

/// The bounded part of the intersection of half-spaces n·x ≤ h.
#[derive(Debug, Clone, PartialEq)]
pub struct Convex {
    corners: Vec<Point>,
    /// The loops of corner indices, counterclockwise from outside, each with its plane's index.
    faces: Vec<Loop>,
    on_plane_mm: f64,
}

/// The boundary of one face.
#[derive(Debug, Clone, PartialEq)]
struct Loop {
    /// The index of its plane; `None` for a side of the box that bounds everything.
    plane: Option<usize>,
    corners: Vec<u32>,
}

/// Area and centroid of a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceMeasure {
    /// The area, mm².
    pub area_mm2: f64,
    /// The centroid of the area.
    pub centroid: Point,
}

/// An edge between two faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The indices of the planes of its faces.
    pub planes: [usize; 2],
    /// Its ends, counterclockwise about the first face.
    pub ends: [Point; 2],
}

impl Edge {
    /// Returns the length, mm.
    pub fn length_mm(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

impl Convex {
    /// Intersects the half-spaces below the planes with the box `within`; `None` if nothing is
    /// left.
    ///
    /// Costs O(m²) for m planes: about 10 µs for 12 of them.
    pub fn of_planes(planes: &[Plane], within: &Aabb) -> Option<Self> {
        let mut body = Self::of_box(within);
        planes
            .iter()
            .enumerate()
            .all(|(index, plane)| body.clip(plane, index))
            .then_some(body)
    }

    fn of_box(within: &Aabb) -> Self {
        let pick = |bit: usize, axis: usize| {
            if bit >> axis & 1 == 1 {
                within.max[axis]
            } else {
                within.min[axis]
            }
        };
        let corners = (0..8)
            .map(|bits| Point::new(pick(bits, 0), pick(bits, 1), pick(bits, 2)))
            .collect();
        const SIDES: [[u32; 4]; 6] = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let faces = SIDES.map(|side| Loop {
            plane: None,
            corners: side.to_vec(),
        });
        Self {
            corners,
            faces: faces.to_vec(),
            on_plane_mm: ON_PLANE_RATIO * within.size().max(),
        }
    }

    /// Cuts off what lies above the plane. Returns false if nothing is left.
    fn clip(&mut self, plane: &Plane, index: usize) -> bool {
        let above: Vec<f64> = self.corners.iter().map(|p| plane.distance(p)).collect();
        let is_out = |corner: u32| above[corner as usize] > self.on_plane_mm;
        let used = self.faces.iter().flat_map(|face| &face.corners);
        let [mut any_in, mut any_out] = [false; 2];
        for &corner in used {
            if is_out(corner) {
                any_out = true;
            } else if above[corner as usize] < -self.on_plane_mm {
                any_in = true;
            }
        }
        if !any_out || !any_in {
            return any_in;
        }
        let mut cut = Cut {
            above: &above,
            on_plane_mm: self.on_plane_mm,
            made: Vec::new(),
            cap: Vec::new(),
        };
        let mut faces = Vec::with_capacity(self.faces.len() + 1);
        for face in &self.faces {
            let kept = cut.keep(face, &mut self.corners);
            if kept.len() >= 3 {
                faces.push(Loop {
                    plane: face.plane,
                    corners: kept,
                });
            }
        }
        if let Some(corners) = cut.cap_loop() {
            faces.push(Loop {
                plane: Some(index),
                corners,
            });
        }
        self.faces = faces;
        true
    }

    /// Returns true if no side of the surrounding box bounds it.
    pub fn is_bounded(&self) -> bool {
        self.faces.iter().all(|face| face.plane.is_some())
    }

    /// Returns the volume, mm³; exact up to rounding.
    pub fn volume_mm3(&self) -> f64 {
        let Some(apex) = self.faces.first().map(|face| self.at(face.corners[0])) else {
            return 0.0;
        };
        let fans = self.faces.iter().flat_map(|face| self.fan(face));
        let six: f64 = fans
            .map(|[a, b, c]| (a - apex).dot(&(b - apex).cross(&(c - apex))))
            .sum();
        six / 6.0
    }

    /// Returns area and centroid of the face on each of `count` planes; `None` for planes that
    /// have no face.
    pub fn measures(&self, count: usize) -> Vec<Option<FaceMeasure>> {
        let mut measures = vec![None; count];
        for face in &self.faces {
            if let Some(index) = face.plane {
                measures[index] = self.measure(face);
            }
        }
        measures
    }

    fn measure(&self, face: &Loop) -> Option<FaceMeasure> {
        let start = self.at(face.corners[0]);
        let mut doubled = Vector::zeros();
        for [a, b, c] in self.fan(face) {
            doubled += (b - a).cross(&(c - a));
        }
        let normal = doubled.try_normalize(0.0)?;
        let (mut area, mut moment) = (0.0, Vector::zeros());
        for [a, b, c] in self.fan(face) {
            let part = normal.dot(&(b - a).cross(&(c - a))) / 2.0;
            area += part;
            moment += ((a - start) + (b - start) + (c - start)) * (part / 3.0);
        }
        (area > 0.0).then(|| FaceMeasure {
            area_mm2: area,
            centroid: start + moment / area,
        })
    }

    /// Returns the corners of the face on each of `count` planes, counterclockwise from outside;
    /// empty for planes that have no face.
    pub fn outlines(&self, count: usize) -> Vec<Vec<u32>> {
        let mut outlines = vec![Vec::new(); count];
        for face in &self.faces {
            if let Some(index) = face.plane {
                outlines[index].clone_from(&face.corners);
            }
        }
        outlines
    }

    /// Returns the edges between faces on planes, each once.
    pub fn edges(&self) -> Vec<Edge> {
        let mut open: Vec<([u32; 2], usize)> = Vec::new();
        let mut edges = Vec::new();
        for face in &self.faces {
            let Some(plane) = face.plane else { continue };
            let count = face.corners.len();
            for (k, &from) in face.corners.iter().enumerate() {
                let to = face.corners[(k + 1) % count];
                match open.iter().position(|(ends, _)| *ends == [to, from]) {
                    Some(at) => {
                        let (ends, other) = open.swap_remove(at);
                        edges.push(Edge {
                            planes: [other, plane],
                            ends: ends.map(|corner| self.at(corner)),
                        });
                    }
                    None => open.push(([from, to], plane)),
                }
            }
        }
        edges
    }

    /// Returns the closed surface as triangles; every face, those on the box too, is a fan about
    /// its first corner.
    pub fn mesh(&self) -> TriMesh {
        let mut index_of = BTreeMap::new();
        let mut corners = Vec::new();
        let mut triangles = Vec::new();
        for face in &self.faces {
            let ring = face.corners.iter().map(|&corner| {
                *index_of.entry(corner).or_insert_with(|| {
                    corners.push(self.at(corner));
                    corners.len() as u32 - 1
                })
            });
            let ring: Vec<u32> = ring.collect();
            let pairs = ring[1..].windows(2);
            triangles.extend(pairs.map(|pair| [ring[0], pair[0], pair[1]]));
        }
        TriMesh::from_parts(corners, triangles)
    }

    /// Returns the corner of an index that an outline names.
    pub fn at(&self, corner: u32) -> Point {
        self.corners[corner as usize]
    }

    fn fan<'a>(&'a self, face: &'a Loop) -> impl Iterator<Item = [Point; 3]> + 'a {
        let start = self.at(face.corners[0]);
        face.corners[1..]
            .windows(2)
            .map(move |edge| [start, self.at(edge[0]), self.at(edge[1])])
    }
}

/// A plane's cut through a body, face by face.
struct Cut<'a> {
    /// The height of every corner above the plane, mm.
    above: &'a [f64],
    on_plane_mm: f64,
    /// The corners made on edges: the edge's ends in ascending order, and the corner.
    made: Vec<([u32; 2], u32)>,
    /// The edges of the cap, one from each face that was cut.
    cap: Vec<[u32; 2]>,
}

impl Cut<'_> {
    /// Returns what the plane leaves of a face, and notes the edge of the cap beside it.
    fn keep(&mut self, face: &Loop, corners: &mut Vec<Point>) -> Vec<u32> {
        let mut kept: Vec<u32> = Vec::with_capacity(face.corners.len() + 1);
        let [mut leaves, mut enters] = [None; 2];
        let count = face.corners.len();
        for (k, &here) in face.corners.iter().enumerate() {
            let next = face.corners[(k + 1) % count];
            let [is_out, is_next_out] = [here, next].map(|corner| self.is_out(corner));
            if !is_out {
                push_new(&mut kept, here);
            }
            if is_out != is_next_out {
                let corner = self.crossing([here, next], corners);
                push_new(&mut kept, corner);
                *(if is_out { &mut enters } else { &mut leaves }) = Some(corner);
            }
        }
        if kept.len() > 1 && kept.first() == kept.last() {
            kept.pop();
        }
        if let (Some(leaves), Some(enters)) = (leaves, enters)
            && leaves != enters
        {
            self.cap.push([enters, leaves]);
        }
        kept
    }

    fn is_out(&self, corner: u32) -> bool {
        self.above[corner as usize] > self.on_plane_mm
    }

    /// Returns the corner at which an edge meets the plane; an end that lies on it is that corner.
    fn crossing(&mut self, [a, b]: [u32; 2], corners: &mut Vec<Point>) -> u32 {
        let inside = if self.is_out(a) { b } else { a };
        if self.above[inside as usize] >= -self.on_plane_mm {
            return inside;
        }
        let edge = [a.min(b), a.max(b)];
        if let Some(&(_, corner)) = self.made.iter().find(|(made, _)| *made == edge) {
            return corner;
        }
        let [from, to] = edge.map(|corner| corner as usize);
        let share = self.above[from] / (self.above[from] - self.above[to]);
        let at = corners[from] + (corners[to] - corners[from]) * share;
        let corner = corners.len() as u32;
        corners.push(at);
        self.made.push((edge, corner));
        corner
    }

    /// Chains the edges of the cap to a loop; `None` if it has fewer than three.
    fn cap_loop(&self) -> Option<Vec<u32>> {
        let [start, mut next] = *self.cap.first()?;
        let mut corners = vec![start];
        while next != start && corners.len() <= self.cap.len() {
            corners.push(next);
            next = self.cap.iter().find(|[from, _]| *from == next)?[1];
        }
        (corners.len() >= 3).then_some(corners)
    }
}

/// Appends a corner unless it is the last one already.
fn push_new(kept: &mut Vec<u32>, corner: u32) {
    if kept.last() != Some(&corner) {
        kept.push(corner);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(normal: [f64; 3], offset_mm: f64) -> Plane {
        let normal = Vector::from(normal).normalize();
        Plane { normal, offset_mm }
    }

    fn around(half: f64) -> Aabb {
        let corner = Point::new(half, half, half);
        Aabb::of_points(&[-corner, corner])
    }

    fn octahedron(offset_mm: f64) -> Vec<Plane> {
        let sign = |bit: usize, k: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let normal = |k: usize| [sign(0, k), sign(1, k), sign(2, k)];
        (0..8).map(|k| plane(normal(k), offset_mm)).collect()
    }

    #[test]
    fn an_octahedron_has_its_volume_faces_and_edges() {
        let planes = octahedron(1.0);
        let body = Convex::of_planes(&planes, &around(9.0)).unwrap();
        // With an inscribed ball of radius 1 the edge is √6.
        let edge = 6.0_f64.sqrt();
        assert!(body.is_bounded());
        assert!((body.volume_mm3() - 2.0_f64.sqrt() / 3.0 * edge.powi(3)).abs() < 1e-12);
        for measure in body.measures(8).into_iter().flatten() {
            assert!((measure.area_mm2 - 3.0_f64.sqrt() / 4.0 * edge * edge).abs() < 1e-12);
            assert!((measure.centroid.coords.norm() - 1.0).abs() < 1e-12);
        }
        let edges = body.edges();
        assert_eq!(edges.len(), 12);
        assert!(edges.iter().all(|e| (e.length_mm() - edge).abs() < 1e-12));
        assert!(body.outlines(8).iter().all(|outline| outline.len() == 3));
    }

    #[test]
    fn planes_that_only_touch_a_body_have_no_face() {
        let mut planes = octahedron(1.0);
        planes.push(plane([1.0, 0.0, 0.0], 3.0_f64.sqrt()));
        planes.push(plane([1.0, 1.0, 0.0], 9.0));
        let body = Convex::of_planes(&planes, &around(9.0)).unwrap();
        assert_eq!(body.measures(10)[8..], [None, None]);
        assert_eq!(body.edges().len(), 12);
    }

    #[test]
    fn planes_that_meet_nowhere_or_bound_nothing_are_told() {
        let apart = [plane([1.0, 0.0, 0.0], -1.0), plane([-1.0, 0.0, 0.0], -1.0)];
        assert_eq!(Convex::of_planes(&apart, &around(9.0)), None);
        let open = Convex::of_planes(&octahedron(1.0)[..4], &around(9.0)).unwrap();
        assert!(!open.is_bounded());
    }
}
