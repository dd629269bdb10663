//! The polyhedra from which vertices are moved.

use super::super::convex::Convex;
use super::super::starts::regular;
use crate::base::words::choice;
use crate::geom::{Aabb, Plane, Point};

choice! {
    /// A regular polyhedron.
    StartSolid, "start polyhedron" {
        /// Six squares.
        Cube = "cube",
        /// Twelve pentagons.
        Dodecahedron = "dodecahedron",
        /// Twenty triangles.
        Icosahedron = "icosahedron",
    }
}

/// Corners and faces, each face a loop of corners counterclockwise from outside.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    pub corners: Vec<Point>,
    pub faces: Vec<Vec<u32>>,
}

impl StartSolid {
    /// Returns the number of its faces.
    pub fn face_count(self) -> usize {
        match self {
            Self::Cube => 6,
            Self::Dodecahedron => 12,
            Self::Icosahedron => 20,
        }
    }

    /// Returns the polyhedron about a point with its corners at a radius, mm.
    pub(super) fn shape(self, center: &Point, radius_mm: f64) -> Option<Shape> {
        let planes: Vec<Plane> = regular(self.face_count(), 0)?
            .into_iter()
            .map(|normal| Plane {
                normal,
                offset_mm: 1.0,
            })
            .collect();
        let corner = Point::new(3.0, 3.0, 3.0);
        let body = Convex::of_planes(&planes, &Aabb::of_points(&[-corner, corner]))?;
        let outlines = body.outlines(planes.len());
        let mut used: Vec<u32> = outlines.concat();
        used.sort_unstable();
        used.dedup();
        let index = |old: &u32| used.binary_search(old).map_or(0, |at| at as u32);
        let place = |&old: &u32| center + body.at(old).coords.normalize() * radius_mm;
        Some(Shape {
            corners: used.iter().map(place).collect(),
            faces: outlines
                .iter()
                .map(|outline| outline.iter().map(index).collect())
                .collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_regular_polyhedra_have_their_corners_and_faces() {
        let counts = [(8, 6, 4), (20, 12, 5), (12, 20, 3)];
        for (solid, (corners, faces, sides)) in StartSolid::ALL.iter().zip(counts) {
            let center = Point::new(1.0, -2.0, 3.0);
            let shape = solid.shape(&center, 7.0).unwrap();
            assert_eq!((shape.corners.len(), shape.faces.len()), (corners, faces));
            assert!(shape.faces.iter().all(|face| face.len() == sides));
            let radii = shape.corners.iter().map(|p| (p - center).norm());
            assert!(radii.into_iter().all(|radius| (radius - 7.0).abs() < 1e-9));
        }
    }
}
