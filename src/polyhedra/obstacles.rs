//! The triangles and bodies from which a polyhedron keeps its distance.

use std::collections::HashMap;

use crate::geom::{Aabb, Plane, Point};
use crate::mesh::TriMesh;

/// The surface of a model in pieces, and the corners of other bodies.
///
/// Each piece and each body is parted from a polyhedron by one plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacles {
    points: Vec<Point>,
    /// The pieces of the model's triangles, in the order of the triangles.
    pieces: Vec<[u32; 3]>,
    /// The corners of other bodies.
    bodies: Vec<Vec<u32>>,
    longest_edge_mm: f64,
}

impl Obstacles {
    /// Takes the triangles of a model and halves them until no edge is longer than
    /// `longest_edge_mm`.
    ///
    /// A triangle is halved at the midpoint of its longest edge, the first of equally long ones.
    /// With corners a, b, c and ab the longest edge, the halves are (a, m, c) and (m, b, c).
    pub fn of_mesh(mesh: &TriMesh, longest_edge_mm: f64) -> Self {
        let mut halving = Halving {
            points: mesh.vertices().to_vec(),
            midpoints: HashMap::new(),
            limit_squared: longest_edge_mm * longest_edge_mm,
            pieces: Vec::with_capacity(mesh.triangles().len()),
        };
        for &triangle in mesh.triangles() {
            halving.halve(triangle);
        }
        Self {
            points: halving.points,
            pieces: halving.pieces,
            bodies: Vec::new(),
            longest_edge_mm,
        }
    }

    /// Returns these obstacles and one more body, given by the corners of its hull.
    #[must_use]
    pub fn with_body(mut self, corners: &[Point]) -> Self {
        let start = self.points.len() as u32;
        self.points.extend_from_slice(corners);
        self.bodies
            .push((start..start + corners.len() as u32).collect());
        self
    }

    /// Returns the number of pieces and bodies.
    pub fn len(&self) -> usize {
        self.pieces.len() + self.bodies.len()
    }

    /// Returns true if there is nothing to keep away from.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the number of pieces of the model's surface.
    pub fn piece_count(&self) -> usize {
        self.pieces.len()
    }

    /// Returns the longest edge that a piece may have, mm.
    pub fn longest_edge_mm(&self) -> f64 {
        self.longest_edge_mm
    }

    /// Returns the corners of all pieces and bodies.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Returns the corners of a piece or a body, as indices of points.
    pub fn corners(&self, index: usize) -> &[u32] {
        match self.pieces.get(index) {
            Some(piece) => piece,
            None => &self.bodies[index - self.pieces.len()],
        }
    }

    /// Returns the smallest box around everything.
    pub fn aabb(&self) -> Aabb {
        Aabb::of_points(&self.points)
    }

    /// Returns by how much a plane parts a piece or a body from what lies below it, mm.
    pub fn parted_mm(&self, index: usize, plane: &Plane) -> f64 {
        let corners = self.corners(index).iter();
        corners
            .map(|&corner| plane.distance(&self.points[corner as usize]))
            .fold(f64::INFINITY, f64::min)
    }

    /// Returns, for every piece and body, by how much the plane parts it, mm.
    pub fn all_parted_mm(&self, plane: &Plane) -> Vec<f64> {
        let Plane { normal, offset_mm } = *plane;
        let height = |p: &Point| normal.x * p.x + normal.y * p.y + normal.z * p.z - offset_mm;
        let above: Vec<f64> = self.points.iter().map(height).collect();
        let at = |corner: u32| above[corner as usize];
        let pieces = self
            .pieces
            .iter()
            .map(|&[a, b, c]| at(a).min(at(b)).min(at(c)));
        let body = |body: &Vec<u32>| body.iter().map(|&c| at(c)).fold(f64::INFINITY, f64::min);
        pieces.chain(self.bodies.iter().map(body)).collect()
    }

    /// Returns the least distance by which each piece or body is parted by its best plane, mm;
    /// infinite if there are none.
    pub fn least_parted_mm(&self, planes: &[Plane]) -> f64 {
        let mut best = vec![f64::NEG_INFINITY; self.len()];
        for plane in planes {
            for (best, parted) in best.iter_mut().zip(self.all_parted_mm(plane)) {
                *best = best.max(parted);
            }
        }
        best.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Triangles being halved, with shared midpoints.
struct Halving {
    points: Vec<Point>,
    midpoints: HashMap<[u32; 2], u32>,
    limit_squared: f64,
    pieces: Vec<[u32; 3]>,
}

impl Halving {
    fn halve(&mut self, triangle: [u32; 3]) {
        let (mut longest, mut squared) = (0, f64::NEG_INFINITY);
        for edge in 0..3 {
            let [a, b] = [triangle[edge], triangle[(edge + 1) % 3]];
            let length = (self.points[a as usize] - self.points[b as usize]).norm_squared();
            if length > squared {
                (longest, squared) = (edge, length);
            }
        }
        if squared <= self.limit_squared || squared.is_nan() {
            self.pieces.push(triangle);
            return;
        }
        let [a, b, c] = [0, 1, 2].map(|k| triangle[(longest + k) % 3]);
        let middle = self.midpoint(a, b);
        self.halve([a, middle, c]);
        self.halve([middle, b, c]);
    }

    fn midpoint(&mut self, a: u32, b: u32) -> u32 {
        let points = &mut self.points;
        *self
            .midpoints
            .entry([a.min(b), a.max(b)])
            .or_insert_with(|| {
                let middle = nalgebra::center(&points[a as usize], &points[b as usize]);
                points.push(middle);
                points.len() as u32 - 1
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mesh::{area_mm2, primitives};

    #[test]
    fn the_halves_of_triangles_cover_them_with_short_edges() {
        let corners = [Point::origin(), Point::new(60.0, 20.0, 35.0)];
        let mesh = primitives::cuboid(&corners[0], &corners[1]);
        let obstacles = Obstacles::of_mesh(&mesh, 7.0);
        let triangle = |index: usize| {
            let corners = obstacles.corners(index);
            [0, 1, 2].map(|k| obstacles.points()[corners[k] as usize])
        };
        let area: f64 = (0..obstacles.len()).map(|k| area_mm2(&triangle(k))).sum();
        assert!((area - 2.0 * (60.0 * 20.0 + 60.0 * 35.0 + 20.0 * 35.0)).abs() < 1e-9);
        for index in 0..obstacles.len() {
            let [a, b, c] = triangle(index);
            assert!(
                [(a - b), (b - c), (c - a)]
                    .iter()
                    .all(|edge| edge.norm() <= 7.0)
            );
        }
    }

    #[test]
    fn triangles_without_long_edges_stay_as_they_are() {
        let mesh = primitives::ball(&Point::origin(), 10.0, 3);
        let obstacles = Obstacles::of_mesh(&mesh, 5.0);
        assert_eq!(obstacles.piece_count(), mesh.triangles().len());
        let as_they_are = |(k, triangle): (usize, &[u32; 3])| obstacles.corners(k) == triangle;
        assert!(mesh.triangles().iter().enumerate().all(as_they_are));
    }

    #[test]
    fn a_body_is_parted_as_one() {
        let mesh = primitives::ball(&Point::origin(), 10.0, 1);
        let corners = [Point::new(20.0, 0.0, 0.0), Point::new(30.0, 5.0, 0.0)];
        let obstacles = Obstacles::of_mesh(&mesh, 50.0).with_body(&corners);
        let plane = Plane::through(&Point::new(12.0, 0.0, 0.0), &Vector::x());
        let body = obstacles.len() - 1;
        assert_eq!(obstacles.parted_mm(body, &plane), 8.0);
        let all = obstacles.all_parted_mm(&plane);
        assert_eq!(all.len(), obstacles.len());
        assert!((0..all.len()).all(|k| (all[k] - obstacles.parted_mm(k, &plane)).abs() < 1e-12));
    }
}
