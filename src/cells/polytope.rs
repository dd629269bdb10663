//! Convex polytopes, cut from a box by half-spaces.

use super::axes::Axes;
use super::chain::{Chain, cross};
use super::fan::order;
use crate::geom::{Aabb, Plane, Point};

/// The far side of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Beyond {
    /// The outside of the room that all cells share.
    Room,
    /// The cell of this site.
    Cell(usize),
}

/// A face of a polytope.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Its far side.
    pub beyond: Beyond,
    /// Its plane; the polytope is below it.
    pub plane: Plane,
    /// Its corners, counter-clockwise as seen from outside.
    pub ring: Vec<Point>,
}

/// A convex polytope with closed faces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polytope {
    faces: Vec<Face>,
}

impl Polytope {
    /// Makes a box.
    pub fn of_box(room: &Aabb) -> Self {
        let chain = Chain::of_box(room);
        // Two triangles a side: their four corners are its ring.
        let sides = chain.triangles().chunks(2);
        let faces = sides.map(|pair| {
            let [[a, b, c], [_, _, d]] = [pair[0], pair[1]];
            let normal = (b - a).cross(&(c - a));
            Face {
                beyond: Beyond::Room,
                plane: Plane::through(&a, &normal),
                ring: vec![a, b, c, d],
            }
        });
        Self {
            faces: faces.collect(),
        }
    }

    /// Returns the faces.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// Cuts off what is above a plane. A polytope that is wholly above has no faces after it.
    pub fn cut(&mut self, plane: &Plane, beyond: Beyond) {
        let reaches = |face: &Face| face.ring.iter().any(|at| plane.distance(at) > 0.0);
        if !self.faces.iter().any(reaches) {
            return;
        }
        let mut rim = Vec::new();
        for face in &mut self.faces {
            face.ring = below(&face.ring, plane, &mut rim);
        }
        self.faces.retain(|face| face.ring.len() >= 3);
        if self.faces.is_empty() {
            return;
        }
        let ring = around(rim, plane);
        if ring.len() >= 3 {
            let plane = *plane;
            self.faces.push(Face {
                beyond,
                plane,
                ring,
            });
        }
    }

    /// Returns the part of it that is so far from every face toward another cell. Without faces
    /// nothing is left.
    #[must_use]
    pub fn drawn_in(&self, by_mm: f64) -> Self {
        if self.faces.is_empty() {
            return Self::default();
        }
        let mut inner = Self::of_box(&self.bounds());
        for face in &self.faces {
            if let Beyond::Cell(_) = face.beyond {
                let plane = Plane {
                    offset_mm: face.plane.offset_mm - by_mm,
                    ..face.plane
                };
                inner.cut(&plane, face.beyond);
            }
        }
        inner
    }

    /// Returns the polytope in the model from one in a frame.
    #[must_use]
    pub fn in_model(&self, axes: &Axes) -> Self {
        let faces = self.faces.iter().map(|face| Face {
            beyond: face.beyond,
            plane: axes.plane_to_model(&face.plane, &face.ring[0]),
            ring: face.ring.iter().map(|at| axes.to_model(at)).collect(),
        });
        Self {
            faces: faces.collect(),
        }
    }

    /// Returns the greatest distance of a corner from a point, mm.
    pub fn reach_mm(&self, from: &Point) -> f64 {
        let corners = self.faces.iter().flat_map(|face| &face.ring);
        corners.map(|at| (at - from).norm()).fold(0.0, f64::max)
    }

    /// Returns the box around it.
    pub fn bounds(&self) -> Aabb {
        Aabb::of_points(self.faces.iter().flat_map(|face| &face.ring))
    }

    /// Returns its boundary.
    pub fn chain(&self) -> Chain {
        let fans = self.faces.iter().flat_map(|face| {
            let first = face.ring[0];
            face.ring[1..]
                .windows(2)
                .map(move |pair| [first, pair[0], pair[1]])
        });
        Chain::new(fans.collect())
    }
}

/// Returns the part of a ring below a plane, and adds its points on the plane to `rim`.
fn below(ring: &[Point], plane: &Plane, rim: &mut Vec<Point>) -> Vec<Point> {
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (k, from) in ring.iter().enumerate() {
        let to = &ring[(k + 1) % ring.len()];
        let [here, there] = [from, to].map(|at| plane.distance(at));
        if here <= 0.0 {
            kept.push(*from);
            if here == 0.0 {
                rim.push(*from);
            }
        }
        if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
            let crossing = cross([*from, *to], [here, there]);
            kept.push(crossing);
            rim.push(crossing);
        }
    }
    kept
}

/// Returns the corners of a new face in their order around it.
fn around(mut rim: Vec<Point>, plane: &Plane) -> Vec<Point> {
    // Every corner comes from two faces, or more.
    rim.sort_by(order);
    rim.dedup();
    if rim.len() < 3 {
        return rim;
    }
    let sum = rim.iter().fold(Point::origin(), |sum, at| sum + at.coords);
    let middle = sum / rim.len() as f64;
    let (u, v) = plane.basis();
    let angle = |at: &Point| {
        let way = at - middle;
        way.dot(&v).atan2(way.dot(&u))
    };
    rim.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    rim
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::geom::Vector;

    #[test]
    fn a_cut_box_has_the_volume_and_the_closed_faces_of_its_chain() {
        let room = Aabb {
            min: Point::new(-1.0, -1.0, -1.0),
            max: Point::new(1.0, 1.0, 1.0),
        };
        let mut random = Random::new(4);
        for _ in 0..100 {
            let mut polytope = Polytope::of_box(&room);
            let mut chain = Chain::of_box(&room);
            for k in 0..12 {
                let mut one = || random.between(-1.0, 1.0);
                let normal = Vector::new(one(), one(), one()).normalize();
                let offset_mm = random.between(0.1, 1.2);
                let plane = Plane { normal, offset_mm };
                polytope.cut(&plane, Beyond::Cell(k));
                chain = chain.below(&plane);
            }
            let [found, expected] = [polytope.chain().volume_mm3(), chain.volume_mm3()];
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
            // The areas of closed faces, as vectors, sum to nothing.
            let areas = polytope
                .chain()
                .triangles()
                .iter()
                .fold(Vector::zeros(), |sum, [a, b, c]| {
                    sum + (b - a).cross(&(c - a))
                });
            assert!(areas.norm() < 1e-12);
        }
    }

    #[test]
    fn a_box_that_is_wholly_above_a_plane_is_gone() {
        let room = Aabb {
            min: Point::origin(),
            max: Point::new(1.0, 1.0, 1.0),
        };
        let mut polytope = Polytope::of_box(&room);
        let plane = Plane {
            normal: Vector::x(),
            offset_mm: -1.0,
        };
        polytope.cut(&plane, Beyond::Room);
        assert!(polytope.faces().is_empty());
        let mut whole = Polytope::of_box(&room);
        whole.cut(&plane.flipped(), Beyond::Room);
        assert_eq!(whole, Polytope::of_box(&room));
    }
}
