//! The polyhedra from which vertices are moved.

use super::super::convex::Convex;
use crate::base::words::choice;
use crate::geom::{Aabb, Plane, Point, Vector};

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

/// The golden ratio.
const GOLDEN: f64 = 1.618_033_988_749_895;

/// Corners and faces, each face a loop of corners counterclockwise from outside.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    pub corners: Vec<Point>,
    pub faces: Vec<Vec<u32>>,
}

impl StartSolid {
    fn normals(self) -> Vec<Vector> {
        let turned = |x: f64, y: f64, z: f64| [[x, y, z], [y, z, x], [z, x, y]];
        let signed = |[a, b]: [f64; 2]| {
            let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
            signs.map(|[s, t]| turned(0.0, s * a, t * b)).concat()
        };
        let normals = match self {
            Self::Cube => [turned(1.0, 0.0, 0.0), turned(-1.0, 0.0, 0.0)].concat(),
            Self::Dodecahedron => signed([1.0, GOLDEN]),
            Self::Icosahedron => {
                let sign = |bits: usize, k: usize| if bits >> k & 1 == 1 { 1.0 } else { -1.0 };
                let corner = |bits: usize| [sign(bits, 0), sign(bits, 1), sign(bits, 2)];
                let mut all = signed([GOLDEN.recip(), GOLDEN]);
                all.extend((0..8).map(corner));
                all
            }
        };
        let unit = |normal: [f64; 3]| Vector::from(normal).normalize();
        normals.into_iter().map(unit).collect()
    }

    /// Returns the polyhedron about a point with its corners at a radius, mm.
    pub(super) fn shape(self, center: &Point, radius_mm: f64) -> Option<Shape> {
        let planes: Vec<Plane> = self
            .normals()
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
