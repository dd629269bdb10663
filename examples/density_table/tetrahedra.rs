//! Tetrahedra of a regular lattice with a density that is sampled at their corners, as the paper's
//! tetrahedra have it. The solid's surface cuts them, so that only the sampling errs.

use equipoise::field::{Density, Form};
use equipoise::geom::{Aabb, Plane, Point, Vector};
use equipoise::mesh::TriMesh;

/// The directions of the planes that cut space into tetrahedra: Kuhn's six in every cube.
const NORMALS: [[f64; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, -1.0, 0.0],
    [0.0, 1.0, -1.0],
    [1.0, 0.0, -1.0],
];

/// A density that is linear in the tetrahedra of a lattice.
#[derive(Debug)]
pub struct Lattice<'a> {
    field: &'a dyn Density,
    region: Aabb,
    edge_mm: f64,
}

impl<'a> Lattice<'a> {
    /// Samples a field at the corners of cubes with this edge, which are six tetrahedra each.
    pub fn new(field: &'a dyn Density, mesh: &TriMesh, edge_mm: f64) -> Self {
        Self {
            field,
            region: mesh.aabb(),
            edge_mm,
        }
    }

    /// Returns the number of tetrahedra over the box of the solid.
    pub fn tetrahedra(&self) -> usize {
        let sides = self.region.size() / self.edge_mm;
        let cubes: f64 = sides.iter().map(|side| side.ceil()).product();
        6 * cubes as usize
    }
}

impl Density for Lattice<'_> {
    fn at(&self, point: &Point) -> f64 {
        let place = (point - self.region.min) / self.edge_mm;
        let cell = place.map(f64::floor);
        let shares = place - cell;
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| shares[*b].total_cmp(&shares[*a]));
        // From corner to corner along the axes, the greatest share first.
        let value = |corner: &Vector| self.field.at(&(self.region.min + corner * self.edge_mm));
        let mut corner = cell;
        let (mut last, mut sum) = (value(&corner), value(&corner));
        for axis in order {
            corner[axis] += 1.0;
            let next = value(&corner);
            sum += shares[axis] * (next - last);
            last = next;
        }
        sum
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        let margin = Vector::repeat(self.edge_mm);
        self.field.bounds(&Aabb {
            min: region.min - margin,
            max: region.max + margin,
        })
    }

    fn form(&self) -> Form<'_> {
        let planes = NORMALS.iter().flat_map(|normal| {
            let normal = Vector::from(*normal);
            let length = normal.norm();
            let corner = normal.dot(&self.region.min.coords);
            let size = self.region.size();
            let reach = |sign: f64| {
                let steps = normal.map(|c| (sign * c).max(0.0)).dot(&size) / self.edge_mm;
                steps.ceil() as i64
            };
            (-reach(-1.0)..=reach(1.0)).map(move |step| Plane {
                normal: normal / length,
                offset_mm: (corner + step as f64 * self.edge_mm) / length,
            })
        });
        Form::Piecewise {
            kinks: planes.collect(),
            degree: 1,
        }
    }
}
