//! A plane cut of one branch of a body: only the ring around a point is cut, and not what else the
//! plane meets.

use super::TriMesh;
use super::clip::{
    Crossing, CutEdge, VERTEX_GAP_MM, crossing, link_rings, meet, sort_edges, triangulate_cap,
};
use super::csg::check_plane;
use crate::geom::{Plane, Point};

/// A ring in which a plane meets the surface of a body around a point.
///
/// What is within it is material: the disc that it bounds can be cut.
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
    /// `None` if the point is not within the body, if another ring lies within the ring, if the
    /// section does not close, or if the ring passes through a vertex. Linear in the triangles.
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
        let cap = triangulate_cap(std::slice::from_ref(ring), &points, &plane)?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mesh::{Solid, bodies, primitives};

    fn level(height_mm: f64) -> Plane {
        Plane {
            normal: Vector::z(),
            offset_mm: height_mm,
        }
    }

    #[test]
    fn only_the_branch_around_the_point_is_cut_through() {
        // A ring that stands: a plane across it meets both of its sides.
        let torus = primitives::torus(8.0, 3.0, 40, 24);
        let standing = torus.map_vertices(|p| Point::new(p.x, -p.z, p.y));
        let ring = standing
            .ring_around(&level(0.1), &Point::new(8.0, 0.0, 0.1))
            .unwrap();
        assert!(ring.reach_mm(&Point::new(8.0, 0.0, 0.1)) < 3.01);
        let cut = Solid::new(standing.cut_along(&ring)).unwrap();
        // It is still one body, of the same volume, and open to the side of the cut alone.
        assert_eq!(bodies(cut.mesh()).len(), 1);
        let volume = [&standing, cut.mesh()].map(TriMesh::signed_volume_mm3);
        assert!((volume[0] - volume[1]).abs() < 1e-9);
        let ring = cut
            .mesh()
            .ring_around(&level(0.1), &Point::new(-8.0, 0.0, 0.1))
            .unwrap();
        let apart = Solid::new(cut.mesh().cut_along(&ring)).unwrap();
        assert_eq!(bodies(apart.mesh()).len(), 2);
    }

    #[test]
    fn what_hangs_back_across_the_plane_stays_whole() {
        // An L: a bar across, with a foot at one end that hangs down.
        let part = |min: [f64; 3], max: [f64; 3]| {
            crate::mesh::Csg::of_mesh(&primitives::cuboid(&min.into(), &max.into())).unwrap()
        };
        let hook = part([0.0, 0.0, 0.0], [4.0, 4.0, 30.0])
            .union(&part([0.0, 0.0, 28.0], [20.0, 4.0, 34.0]))
            .unwrap();
        let hook = hook
            .union(&part([16.0, 0.0, 10.0], [20.0, 4.0, 30.0]))
            .unwrap();
        let mesh = hook.to_mesh().unwrap();
        let ring = mesh
            .ring_around(&level(15.0), &Point::new(2.0, 2.0, 15.0))
            .unwrap();
        let parts = bodies(&mesh.cut_along(&ring));
        let mut volumes: Vec<f64> = parts.iter().map(TriMesh::signed_volume_mm3).collect();
        volumes.sort_by(f64::total_cmp);
        // The plane passes through the foot too, which stays with the bar.
        let stump = 4.0 * 4.0 * 15.0;
        let rest = mesh.signed_volume_mm3() - stump;
        assert!((volumes[0] - stump).abs() < 1e-3 && (volumes[1] - rest).abs() < 1e-3);
    }

    #[test]
    fn a_ring_with_a_hole_in_it_and_a_point_outside_have_no_disc() {
        let pipe = primitives::torus(8.0, 3.0, 40, 24);
        // Across the axis of a lying torus the section is a ring with a hole.
        assert!(
            pipe.ring_around(&level(0.1), &Point::new(8.0, 0.0, 0.1))
                .is_none()
        );
        assert!(
            pipe.ring_around(&level(0.1), &Point::new(0.0, 0.0, 0.1))
                .is_none()
        );
    }
}
