//! A plane cut of closed triangles for trials, without a boolean.
//!
//! Every vertex keeps its exact place. The triangles that cross the plane are divided, and the
//! section is closed by a flat cap on both sides. Nothing else is cleaned up: thin triangles stay.

use manifold_rust::{
    linalg::Vec2,
    polygon::triangulate_idx,
    types::{PolyVert, PolygonsIdx},
};

use super::csg::check_plane;
use super::{ClipError, Csg, TriMesh};
use crate::geom::{Plane, Point};

/// Distance from the plane within which a vertex leaves the cut to the booleans, mm. They close the
/// slivers that would lie in the cut face, and planned cuts keep ten times as far away.
pub(super) const VERTEX_GAP_MM: f64 = 1e-7;

/// An edge that crosses the plane: its vertex above and its vertex below.
pub(super) type CutEdge = (u32, u32);

/// A triangle that crosses the plane, by the edge that goes down through the plane and the edge
/// that comes up.
#[derive(Clone, Copy)]
pub(super) struct Crossing {
    down: CutEdge,
    up: CutEdge,
}

impl TriMesh {
    /// Returns the parts of the closed mesh on the positive and the negative side of `plane`, in
    /// this order. Either part may be empty.
    ///
    /// Fit for trials: about as precise as [`Csg::split_by_plane`], but it keeps thin triangles.
    /// If a vertex lies on the plane or the section does not close, the booleans cut the mesh.
    /// Linear in the triangles: a few milliseconds for 100 000.
    pub fn split_by_plane(&self, plane: &Plane) -> Result<(Self, Self), ClipError> {
        check_plane(plane)?;
        if let Some(halves) = split_closed(self, plane) {
            return Ok(halves);
        }
        let (above, below) = Csg::of_mesh(self)?.split_by_plane(plane)?;
        Ok((above.to_mesh()?, below.to_mesh()?))
    }
}

/// Returns the parts above and below the plane. `None` if the section does not close, or if the
/// plane passes so near to a vertex that slivers would be left on it.
fn split_closed(mesh: &TriMesh, plane: &Plane) -> Option<(TriMesh, TriMesh)> {
    let heights: Vec<f64> = mesh.vertices().iter().map(|p| plane.distance(p)).collect();
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    if lowest >= 0.0 {
        return Some((mesh.clone(), TriMesh::default()));
    }
    if highest < 0.0 {
        return Some((TriMesh::default(), mesh.clone()));
    }
    if heights.iter().any(|height| height.abs() <= VERTEX_GAP_MM) {
        return None;
    }
    let crossings = find_crossings(mesh, &heights);
    let edges = sort_edges(&crossings)?;
    let points: Vec<Point> = edges
        .iter()
        .map(|&edge| meet(mesh, &heights, edge))
        .collect();
    let cap = fill_rings(&link_rings(&crossings, &edges)?, &points, plane)?;
    let side = |is_above: bool| {
        let mut half = Half::new(mesh, &heights, &edges, is_above);
        half.add_surface();
        half.close(&points, &cap)
    };
    Some((side(true), side(false)))
}

/// Returns the triangles that cross the plane, in order.
fn find_crossings(mesh: &TriMesh, heights: &[f64]) -> Vec<Crossing> {
    let crossings = mesh.triangles().iter();
    crossings
        .filter_map(|triangle| crossing(triangle, heights))
        .collect()
}

/// Returns the crossing of a triangle with the plane; `None` if it does not cross.
pub(super) fn crossing(&[a, b, c]: &[u32; 3], heights: &[f64]) -> Option<Crossing> {
    let [on_a, on_b, on_c] = [a, b, c].map(|v| heights[v as usize] >= 0.0);
    let (down, up) = match (on_a, on_b, on_c) {
        (true, false, false) => ((a, b), (a, c)),
        (false, true, false) => ((b, c), (b, a)),
        (false, false, true) => ((c, a), (c, b)),
        (true, true, false) => ((b, c), (a, c)),
        (false, true, true) => ((c, a), (b, a)),
        (true, false, true) => ((a, b), (c, b)),
        _ => return None,
    };
    Some(Crossing { down, up })
}

/// Returns the crossed edges, ascending. `None` unless exactly one triangle goes down through each.
pub(super) fn sort_edges(crossings: &[Crossing]) -> Option<Vec<CutEdge>> {
    let mut edges: Vec<CutEdge> = crossings.iter().map(|crossing| crossing.down).collect();
    edges.sort_unstable();
    let is_single = edges.windows(2).all(|pair| pair[0] != pair[1]);
    is_single.then_some(edges)
}

/// Returns the point in which an edge meets the plane.
pub(super) fn meet(mesh: &TriMesh, heights: &[f64], (above, below): CutEdge) -> Point {
    let [p, q] = [above, below].map(|v| mesh.vertices()[v as usize]);
    let [a, b] = [above, below].map(|v| heights[v as usize]);
    p + (q - p) * (a / (a - b))
}

/// Returns the rings of the section, as indices of crossed edges. Seen from above the plane, they
/// run counter-clockwise around the material. `None` if a ring does not close.
pub(super) fn link_rings(crossings: &[Crossing], edges: &[CutEdge]) -> Option<Vec<Vec<usize>>> {
    let mut next = vec![usize::MAX; edges.len()];
    for crossing in crossings {
        let from = edges.binary_search(&crossing.down).ok()?;
        next[from] = edges.binary_search(&crossing.up).ok()?;
    }
    let mut is_used = vec![false; edges.len()];
    let mut rings = Vec::new();
    for start in 0..edges.len() {
        let (mut ring, mut at) = (Vec::new(), start);
        while !is_used[at] {
            is_used[at] = true;
            ring.push(at);
            at = next[at];
        }
        if at != start {
            return None;
        }
        if ring.len() > 2 {
            rings.push(ring);
        }
    }
    Some(rings)
}

/// Returns triangles that fill the rings, counter-clockwise seen from above the plane. `None` if
/// they do not fit the rings edge to edge.
pub(crate) fn fill_rings(
    rings: &[Vec<usize>],
    points: &[Point],
    plane: &Plane,
) -> Option<Vec<[u32; 3]>> {
    let (u, v) = plane.basis();
    let origin = *points.get(*rings.first()?.first()?)?;
    let corner = |&index: &usize| {
        let arm = points[index] - origin;
        PolyVert {
            pos: Vec2::new(u.dot(&arm), v.dot(&arm)),
            idx: index as i32,
        }
    };
    let polygons: PolygonsIdx = rings
        .iter()
        .map(|ring| ring.iter().map(corner).collect())
        .collect();
    let triangles: Vec<[u32; 3]> = triangulate_idx(&polygons, -1.0, true)
        .iter()
        .map(|t| [t.x as u32, t.y as u32, t.z as u32])
        .collect();
    is_bounded_by(&triangles, rings).then_some(triangles)
}

/// Returns true if the sides of the triangles pair up, but for those along the rings.
fn is_bounded_by(triangles: &[[u32; 3]], rings: &[Vec<usize>]) -> bool {
    let turned = rings.iter().flat_map(|ring| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(&a, &b)| (b as u32, a as u32))
    });
    let sides = triangles
        .iter()
        .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut sides: Vec<(u32, u32)> = sides.chain(turned).collect();
    sides.sort_unstable();
    let is_paired = |&(a, b): &(u32, u32)| a != b && sides.binary_search(&(b, a)).is_ok();
    sides.windows(2).all(|pair| pair[0] != pair[1]) && sides.iter().all(is_paired)
}

/// The part of a mesh on one side of a plane, while it is made.
struct Half<'a> {
    mesh: &'a TriMesh,
    edges: &'a [CutEdge],
    is_above: bool,
    /// The new index of each vertex on this side; `u32::MAX` for the others.
    new_index: Vec<u32>,
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
}

impl<'a> Half<'a> {
    /// Takes the vertices on this side.
    fn new(mesh: &'a TriMesh, heights: &[f64], edges: &'a [CutEdge], is_above: bool) -> Self {
        let mut new_index = vec![u32::MAX; heights.len()];
        let mut vertices = Vec::new();
        for (vertex, &height) in heights.iter().enumerate() {
            if (height >= 0.0) == is_above {
                new_index[vertex] = vertices.len() as u32;
                vertices.push(mesh.vertices()[vertex]);
            }
        }
        Self {
            mesh,
            edges,
            is_above,
            new_index,
            vertices,
            triangles: Vec::new(),
        }
    }

    /// Adds the triangles on this side, and what lies here of those that cross the plane.
    fn add_surface(&mut self) {
        for &triangle in self.mesh.triangles() {
            let corners = triangle.map(|v| self.new_index[v as usize]);
            let is_here = corners.map(|v| v != u32::MAX);
            match is_here.iter().filter(|&&is_here| is_here).count() {
                3 => self.triangles.push(corners),
                1 => self.add_tip(triangle, is_here),
                2 => self.add_stump(triangle, is_here),
                _ => {}
            }
        }
    }

    /// Adds the tip of a triangle of which one corner lies here.
    fn add_tip(&mut self, triangle: [u32; 3], is_here: [bool; 3]) {
        let [a, b, c] = turned(triangle, is_here, true);
        let (from_b, to_c) = (self.cut(a, b), self.cut(a, c));
        self.triangles
            .push([self.new_index[a as usize], from_b, to_c]);
    }

    /// Adds what is left of a triangle of which two corners lie here.
    fn add_stump(&mut self, triangle: [u32; 3], is_here: [bool; 3]) {
        let [a, b, c] = turned(triangle, is_here, false);
        let [new_b, new_c] = [b, c].map(|v| self.new_index[v as usize]);
        let (on_b, on_c) = (self.cut(a, b), self.cut(a, c));
        self.triangles
            .extend([[on_b, new_b, new_c], [on_b, new_c, on_c]]);
    }

    /// Returns the index of the point in which the edge between two vertices meets the plane.
    fn cut(&self, a: u32, b: u32) -> u32 {
        let is_above = (self.new_index[a as usize] != u32::MAX) == self.is_above;
        let edge = if is_above { (a, b) } else { (b, a) };
        let place = self.edges.binary_search(&edge).unwrap_or_default();
        (self.vertices.len() + place) as u32
    }

    /// Adds the section's points and its cap, and returns the closed mesh.
    fn close(mut self, points: &[Point], cap: &[[u32; 3]]) -> TriMesh {
        let shift = self.vertices.len() as u32;
        let outward = |&[a, b, c]: &[u32; 3]| {
            if self.is_above { [a, c, b] } else { [a, b, c] }
        };
        let cap = cap.iter().map(outward).map(|t| t.map(|v| v + shift));
        self.triangles.extend(cap);
        self.vertices.extend_from_slice(points);
        TriMesh::from_parts(self.vertices, self.triangles)
    }
}

/// Returns a triangle that starts with its one corner that is here, or that is not here.
fn turned([a, b, c]: [u32; 3], is_here: [bool; 3], first: bool) -> [u32; 3] {
    if is_here[0] == first {
        [a, b, c]
    } else if is_here[1] == first {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mesh::{Solid, bodies, primitives, shells};

    fn cuboid(min: [f64; 3], max: [f64; 3]) -> TriMesh {
        primitives::cuboid(&min.into(), &max.into())
    }

    fn ball(at: [f64; 3], radius_mm: f64) -> TriMesh {
        primitives::ball(&at.into(), radius_mm, 3)
    }

    /// Meshes of one and of several shells, convex and not, with cavities and with islands in them.
    fn models() -> Vec<TriMesh> {
        let torus = primitives::torus(8.0, 3.0, 40, 24);
        let hollow = ball([0.0; 3], 10.0).joined(&ball([1.0, 2.0, 0.0], 6.0).reversed());
        let onion = hollow.clone().joined(&ball([1.0, 2.0, 0.0], 3.0));
        let cheese = [-5.0, 0.0, 5.0]
            .iter()
            .fold(cuboid([-9.0, -4.0, -4.0], [9.0, 4.0, 4.0]), |mesh, &x| {
                mesh.joined(&ball([x, 0.3 * x, 0.1], 2.0).reversed())
            });
        let apart = torus.clone().joined(&ball([0.0; 3], 4.0));
        let stairs = Csg::of_mesh(&cuboid([-6.0, -3.0, -5.0], [6.0, 3.0, 0.0]))
            .unwrap()
            .union(&Csg::of_mesh(&cuboid([-6.0, -3.0, -5.0], [0.0, 3.0, 5.0])).unwrap())
            .unwrap();
        let stairs = stairs.to_mesh().unwrap();
        vec![
            cuboid([-6.0; 3], [6.0, 7.0, 5.0]),
            torus,
            hollow,
            onion,
            cheese,
            apart,
            stairs,
        ]
    }

    /// Planes of all directions near the origin, most of them through it within 4 mm.
    fn planes() -> impl Iterator<Item = Plane> {
        (0..40).map(|i| {
            let [x, y, z, offset] = [0.754_877_666, 0.569_840_291, 0.430_159_709, 0.324_717_957]
                .map(|step: f64| 2.0 * (0.37 + step * f64::from(i)).fract() - 1.0);
            Plane {
                normal: Vector::new(x, y, z).normalize(),
                offset_mm: 4.0 * offset,
            }
        })
    }

    /// The area of the triangles in the plane, each facing along the normal counted positive.
    fn cap_mm2(mesh: &TriMesh, plane: &Plane) -> f64 {
        let flat = mesh
            .iter_corners()
            .filter(|corners| corners.iter().all(|p| plane.distance(p).abs() < 1e-12));
        flat.map(|[a, b, c]| (b - a).cross(&(c - a)).dot(&plane.normal) / 2.0)
            .sum()
    }

    /// Rounding of volumes and areas of a few thousand.
    const ROUNDING: f64 = 1e-9;

    #[test]
    fn the_halves_are_solids_and_their_volumes_add_up() {
        for (mesh, plane) in models().iter().flat_map(|m| planes().map(move |p| (m, p))) {
            let (above, below) = split_closed(mesh, &plane).unwrap();
            let both = above.signed_volume_mm3() + below.signed_volume_mm3();
            assert!((both - mesh.signed_volume_mm3()).abs() < ROUNDING);
            for (half, sign) in [(&above, 1.0), (&below, -1.0)] {
                assert!(half.is_empty() || Solid::new(half.clone()).is_ok());
                let is_here = |p: &Point| sign * plane.distance(p) > -1e-12;
                assert!(half.vertices().iter().all(is_here));
            }
            assert!((cap_mm2(&above, &plane) + cap_mm2(&below, &plane)).abs() < ROUNDING);
        }
    }

    #[test]
    fn the_boolean_engine_finds_the_same_halves() {
        for (mesh, plane) in models().iter().flat_map(|m| planes().map(move |p| (m, p))) {
            let (above, below) = mesh.split_by_plane(&plane).unwrap();
            let exact = Csg::of_mesh(mesh).unwrap().split_by_plane(&plane).unwrap();
            for (half, exact) in [(above, exact.0), (below, exact.1)] {
                let exact = exact.to_mesh().unwrap();
                let volumes = [&half, &exact].map(TriMesh::signed_volume_mm3);
                assert!((volumes[0] - volumes[1]).abs() < ROUNDING, "{volumes:?}");
                let caps = [&half, &exact].map(|mesh| cap_mm2(mesh, &plane));
                assert!((caps[0] - caps[1]).abs() < ROUNDING, "{caps:?}");
                assert_eq!(shells(&half).len(), shells(&exact).len());
                assert_eq!(bodies(&half).len(), bodies(&exact).len());
            }
        }
    }

    #[test]
    fn a_half_that_is_cut_again_is_closed_too() {
        for mesh in models() {
            let mut cells = vec![mesh.clone()];
            for plane in planes().take(4) {
                let halves = cells
                    .iter()
                    .map(|cell| cell.split_by_plane(&plane).unwrap());
                cells = halves.flat_map(|(above, below)| [above, below]).collect();
                cells.retain(|cell| !cell.is_empty());
            }
            assert!(cells.len() > 4);
            assert!(cells.iter().all(|cell| Solid::new(cell.clone()).is_ok()));
            let volume: f64 = cells.iter().map(TriMesh::signed_volume_mm3).sum();
            assert!((volume - mesh.signed_volume_mm3()).abs() < ROUNDING);
        }
    }

    #[test]
    fn a_cap_keeps_the_holes_of_cavities_and_the_islands_in_them() {
        let level = Plane {
            normal: Vector::z(),
            offset_mm: 0.05,
        };
        // Squares of 12, 8 and 4 mm in one another.
        let [outer, cavity, island] = [6.0, 4.0, 2.0].map(|r| cuboid([-r, -r, -r], [r, r, r]));
        let onion = outer.joined(&cavity.reversed()).joined(&island);
        let (above, below) = split_closed(&onion, &level).unwrap();
        let expected_mm2 = 144.0 - 64.0 + 16.0;
        assert!((cap_mm2(&below, &level) - expected_mm2).abs() < ROUNDING);
        assert!((cap_mm2(&above, &level) + expected_mm2).abs() < ROUNDING);
        assert_eq!(bodies(&below).len(), 2);
    }

    #[test]
    fn the_model_keeps_its_own_vertices_to_the_last_bit() {
        let torus = primitives::torus(8.0, 3.0, 40, 24);
        for plane in planes() {
            let (above, below) = torus.split_by_plane(&plane).unwrap();
            let kept = |half: &TriMesh| {
                let own = half.vertices().iter();
                own.filter(|p| torus.vertices().contains(p)).count()
            };
            assert_eq!(kept(&above) + kept(&below), torus.vertices().len());
        }
    }

    #[test]
    fn a_plane_through_vertices_and_faces_leaves_closed_halves() {
        for (mesh, at) in [
            (&models()[6], 0.0),
            (&models()[0], 5.0),
            (&models()[0], -6.0),
        ] {
            for normal in [Vector::x(), Vector::y(), Vector::z(), -Vector::z()] {
                let plane = Plane {
                    normal,
                    offset_mm: at,
                };
                let (above, below) = mesh.split_by_plane(&plane).unwrap();
                let volumes = [&above, &below].map(TriMesh::signed_volume_mm3);
                let whole_mm3 = mesh.signed_volume_mm3();
                assert!((volumes[0] + volumes[1] - whole_mm3).abs() < ROUNDING);
                for half in [above, below] {
                    let edges = crate::mesh::edges::EdgeTable::of(&half);
                    let open = crate::mesh::edges::EdgeKind::Open;
                    assert_eq!(edges.of_kind(open).count(), 0, "{normal} {at}");
                }
            }
        }
    }

    #[test]
    fn a_plane_beside_the_mesh_leaves_it_whole() {
        let plane = Plane {
            normal: Vector::x(),
            offset_mm: 20.0,
        };
        let mesh = ball([0.0; 3], 10.0);
        let (above, below) = mesh.split_by_plane(&plane).unwrap();
        assert!(above.is_empty());
        assert_eq!(below, mesh);
    }

    #[test]
    fn an_open_section_goes_to_the_boolean_engine_which_refuses_it() {
        let mesh = ball([0.0; 3], 10.0);
        let open = TriMesh::new(mesh.vertices().to_vec(), mesh.triangles()[1..].to_vec()).unwrap();
        let missing = mesh.corners(0).map(|p| p.coords);
        let middle = Point::from((missing[0] + missing[1] + missing[2]) / 3.0);
        let across = Plane::through(&middle, &(missing[0] - middle.coords));
        assert!(split_closed(&open, &across).is_none());
        assert!(matches!(
            open.split_by_plane(&across).err(),
            Some(ClipError::Engine { .. })
        ));
        let zero = Plane {
            normal: Vector::zeros(),
            offset_mm: 0.0,
        };
        assert_eq!(
            mesh.split_by_plane(&zero).err(),
            Some(ClipError::DegeneratePlane)
        );
    }
}
