//! A plane cut of one branch of a body: only the ring around a point is cut, and not what else the
//! plane meets.

use super::TriMesh;
use super::clip::{
    Crossing, CutEdge, VERTEX_GAP_MM, crossing, fill_rings, link_rings, meet, sort_edges,
};
use super::csg::check_plane;
use crate::geom::{Plane, Point};

/// A ring in which a plane meets the surface of a body around a point.
///
/// It goes around material: the disc that it bounds can be cut.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionRing {
    /// The plane.
    pub plane: Plane,
    /// Its corners, counter-clockwise seen from above the plane, mm.
    pub points: Vec<Point>,
    edges: Vec<CutEdge>,
    cap: Vec<[u32; 3]>,
}

impl SectionRing {
    /// Returns the greatest distance of a corner from a point, mm.
    pub fn reach_mm(&self, from: &Point) -> f64 {
        let far = self.points.iter().map(|p| (p - from).norm());
        far.fold(0.0, f64::max)
    }
}

impl TriMesh {
    /// Returns the ring in which a plane meets a closed surface around a point.
    ///
    /// `None` if the point is not within the body, or another ring lies within the ring. It is also
    /// `None` if the ring does not close or passes through a vertex. Linear in the triangles.
    pub fn ring_around(&self, plane: &Plane, at: &Point) -> Option<SectionRing> {
        check_plane(plane).ok()?;
        let plane = *plane;
        let heights: Vec<f64> = self.vertices().iter().map(|p| plane.distance(p)).collect();
        let crossings: Vec<Crossing> = self
            .triangles()
            .iter()
            .filter_map(|triangle| crossing(triangle, &heights))
            .collect();
        let edges = sort_edges(&crossings)?;
        let points: Vec<Point> = edges
            .iter()
            .map(|edge| meet(self, &heights, *edge))
            .collect();
        let rings = link_rings(&crossings, &edges)?;
        let flat = Flat::new(&plane, &points);
        let around = rings.iter().filter(|ring| flat.holds(ring, at));
        let around: Vec<&Vec<usize>> = around.collect();
        let [ring] = around[..] else { return None };
        let is_holed = rings
            .iter()
            .any(|other| other != ring && flat.holds(ring, &points[other[0]]));
        let is_near = |vertex: u32| heights[vertex as usize].abs() <= VERTEX_GAP_MM;
        let mut ends = ring.iter().map(|index| edges[*index]);
        let meets_vertex = ends.any(|(above, below)| is_near(above) || is_near(below));
        if is_holed || meets_vertex || flat.area_mm2(ring) <= 0.0 {
            return None;
        }
        let cap = fill_rings(std::slice::from_ref(ring), &points, &plane)?;
        let place = |index: u32| ring.iter().position(|own| *own == index as usize);
        let cap = cap.iter().map(|triangle| {
            let [a, b, c] = triangle.map(place);
            Some([a? as u32, b? as u32, c? as u32])
        });
        Some(SectionRing {
            plane,
            cap: cap.collect::<Option<_>>()?,
            points: ring.iter().map(|index| points[*index]).collect(),
            edges: ring.iter().map(|index| edges[*index]).collect(),
        })
    }

    /// Returns the closed surface cut along a ring of its own, with a flat cap on either side. What
    /// hangs together only there comes apart; all other vertices keep their exact places.
    #[must_use]
    pub fn cut_along(&self, ring: &SectionRing) -> Self {
        let mut places: Vec<(CutEdge, u32)> = ring.edges.iter().copied().zip(0..).collect();
        places.sort_unstable();
        let count = self.vertices().len() as u32;
        let length = ring.points.len() as u32;
        let place = |edge: CutEdge, is_above: bool| {
            let at = places.binary_search_by(|(own, _)| own.cmp(&edge)).ok()?;
            let shift = if is_above { 0 } else { length };
            Some(count + shift + places[at].1)
        };
        let heights: Vec<f64> = self
            .vertices()
            .iter()
            .map(|p| ring.plane.distance(p))
            .collect();
        let mut triangles = Vec::with_capacity(self.triangles().len() + 4 * ring.points.len());
        for triangle in self.triangles() {
            match split(triangle, &heights, &place) {
                Some(pieces) => triangles.extend(pieces),
                None => triangles.push(*triangle),
            }
        }
        let above = ring.cap.iter().map(|[a, b, c]| [*a, *c, *b]);
        let below = ring.cap.iter().map(|triangle| triangle.map(|v| v + length));
        triangles.extend(
            above
                .chain(below)
                .map(|triangle| triangle.map(|v| v + count)),
        );
        let points = [self.vertices(), &ring.points, &ring.points].concat();
        Self::from_parts(points, triangles)
    }
}

/// Returns the pieces of a triangle above and below; `None` if it is not cut.
fn split(
    triangle: &[u32; 3],
    heights: &[f64],
    place: &impl Fn(CutEdge, bool) -> Option<u32>,
) -> Option<[[u32; 3]; 3]> {
    crossing(triangle, heights)?;
    let is_above = |v: u32| heights[v as usize] >= 0.0;
    let lone = (0..3).find(|i| {
        let [a, b, c] = [0, 1, 2].map(|k| is_above(triangle[(i + k) % 3]));
        a != b && a != c
    })?;
    let [a, b, c] = [0, 1, 2].map(|k| triangle[(lone + k) % 3]);
    let own = is_above(a);
    let edge = |other: u32| if own { (a, other) } else { (other, a) };
    let at = |other: u32, is_above: bool| place(edge(other), is_above);
    let (tip_b, tip_c) = (at(b, own)?, at(c, own)?);
    let (far_b, far_c) = (at(b, !own)?, at(c, !own)?);
    Some([[a, tip_b, tip_c], [far_b, b, c], [far_b, c, far_c]])
}

/// Points of a section in the coordinates of its plane.
struct Flat<'a> {
    plane: &'a Plane,
    flat: Vec<[f64; 2]>,
}

impl<'a> Flat<'a> {
    fn new(plane: &'a Plane, points: &[Point]) -> Self {
        let flat = points.iter().map(|p| flatten(plane, p)).collect();
        Self { plane, flat }
    }

    /// Returns true if a point of the plane lies within a ring: an odd number of its sides lies
    /// ahead.
    fn holds(&self, ring: &[usize], at: &Point) -> bool {
        let [x, y] = flatten(self.plane, at);
        let sides = ring.iter().zip(ring.iter().cycle().skip(1));
        let ahead = sides.filter(|(from, to)| {
            let [[ax, ay], [bx, by]] = [self.flat[**from], self.flat[**to]];
            (ay > y) != (by > y) && ax + (bx - ax) * (y - ay) / (by - ay) > x
        });
        ahead.count() % 2 == 1
    }

    fn area_mm2(&self, ring: &[usize]) -> f64 {
        let sides = ring.iter().zip(ring.iter().cycle().skip(1));
        let twice = sides.map(|(from, to)| {
            let [[ax, ay], [bx, by]] = [self.flat[*from], self.flat[*to]];
            ax * by - ay * bx
        });
        0.5 * twice.sum::<f64>()
    }
}

fn flatten(plane: &Plane, p: &Point) -> [f64; 2] {
    let (u, v) = plane.basis();
    [u.dot(&p.coords), v.dot(&p.coords)]
}
