//! Points spread over a surface, and the cylinder that fits a patch of them.

use std::collections::HashMap;

use super::cylinder::Cylinder;
use crate::geom::{Point, Vector};
use crate::mesh::{TriMesh, spread_points};

/// The number of points. A bore of 0.15 % of the surface still gets thirty.
const COUNT: usize = 20_000;
/// The radii of the patches, as shares of the model's diagonal.
pub(super) const PATCH_RATIOS: [f64; 4] = [0.012, 0.025, 0.05, 0.1];
/// A patch holds points whose normals are within 75° of its middle's: no other wall behind it.
const SAME_SIDE_COSINE: f64 = 0.26;
/// Fewer points, and the fit says nothing.
const LEAST_POINTS: usize = 7;
/// A patch of more points is thinned to about as many.
const MOST_POINTS: usize = 60;
/// The greatest distance of a patch's points from its cylinder, as a share of the radius, root mean
/// square.
const MOST_OFF_RATIO: f64 = 0.05;
/// The largest cylinder that a patch can tell, in radii of the patch: the patch then bends by 14°
/// to each side.
const MOST_RADII: f64 = 4.0;

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
    size_mm: f64,
    cubes: HashMap<[i64; 3], Vec<u32>>,
}

impl Cubes<'_> {
    /// Returns the cylinder that fits the patch about a point; `None` if none does.
    pub fn fit_patch(&self, index: usize) -> Option<Cylinder> {
        let middle = self.samples.points[index];
        let mut patch = self.patch(&middle);
        if patch.len() < LEAST_POINTS {
            return None;
        }
        let step = patch.len().div_ceil(MOST_POINTS);
        patch = patch.into_iter().step_by(step).collect();
        let fitted = Cylinder::fit(&patch)?;
        let square = |point: &Sample| (fitted.across(&point.at).norm() - fitted.radius_mm).powi(2);
        let off_mm = (patch.iter().map(square).sum::<f64>() / patch.len() as f64).sqrt();
        let on_it = |point: &&Sample| fitted.holds(&point.at, &point.normal, 1.0);
        let is_turned = patch.iter().filter(on_it).count() * 10 >= patch.len() * 9;
        let is_told = fitted.radius_mm <= MOST_RADII * self.size_mm
            && off_mm <= MOST_OFF_RATIO * fitted.radius_mm;
        (is_told && is_turned).then_some(fitted)
    }

    /// Returns the points within a radius of the middle that look to the same side, by place.
    fn patch(&self, middle: &Sample) -> Vec<Sample> {
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
