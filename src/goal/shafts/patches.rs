//! Points spread over a surface, and patches of them.

use std::collections::HashMap;

use crate::geom::{Point, Vector};
use crate::mesh::{TriMesh, spread_points};

/// The number of points. A bore of 0.15 % of the surface still gets thirty.
const COUNT: usize = 20_000;
/// The radii of the patches, as shares of the model's diagonal.
pub(super) const PATCH_RATIOS: [f64; 4] = [0.012, 0.025, 0.05, 0.1];
/// A patch holds points whose normals are within 75° of its middle's: no other wall behind it.
const SAME_SIDE_COSINE: f64 = 0.26;

/// A point of the surface with the normal of its triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub at: Point,
    pub normal: Vector,
}

/// The points of a surface, found by place.
pub(super) struct Samples {
    points: Vec<Sample>,
    pub diagonal_mm: f64,
}

impl Samples {
    pub fn of(mesh: &TriMesh) -> Self {
        let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
        let spread = spread_points(&corners, COUNT).into_iter();
        let points = spread.filter_map(|point| {
            let [a, b, c] = corners[point.triangle];
            let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
            Some(Sample {
                at: point.at,
                normal,
            })
        });
        let bounds = mesh.aabb();
        Self {
            points: points.collect(),
            diagonal_mm: (bounds.max - bounds.min).norm(),
        }
    }

    pub fn all(&self) -> impl Iterator<Item = Sample> + '_ {
        self.points.iter().copied()
    }

    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Sorts the points into cubes of this size.
    pub fn cubes(&self, size_mm: f64) -> Cubes<'_> {
        let mut cubes: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for (i, point) in self.points.iter().enumerate() {
            let cube = cube_of(&point.at, size_mm);
            cubes.entry(cube).or_default().push(i as u32);
        }
        Cubes {
            samples: self,
            size_mm,
            cubes,
        }
    }
}

fn cube_of(at: &Point, size_mm: f64) -> [i64; 3] {
    [at.x, at.y, at.z].map(|coordinate| (coordinate / size_mm).floor() as i64)
}

/// The points of a surface in cubes as large as a patch's radius.
pub(super) struct Cubes<'a> {
    samples: &'a Samples,
    /// The size of the cubes, and the radius of a patch, mm.
    pub size_mm: f64,
    cubes: HashMap<[i64; 3], Vec<u32>>,
}

impl Cubes<'_> {
    /// Returns the points within a radius of a point that look to the same side, by place.
    pub fn patch(&self, index: usize) -> Vec<Sample> {
        let middle = self.samples.points[index];
        let [x, y, z] = cube_of(&middle.at, self.size_mm);
        let offsets = (-1..=1)
            .flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [x + i, y + j, z + k])));
        let near = |point: &Sample| {
            (point.at - middle.at).norm() <= self.size_mm
                && point.normal.dot(&middle.normal) >= SAME_SIDE_COSINE
        };
        offsets
            .filter_map(|cube| self.cubes.get(&cube))
            .flatten()
            .map(|&i| self.samples.points[i as usize])
            .filter(near)
            .collect()
    }
}
