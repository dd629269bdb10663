//! The directions of a part that may point up in the printer.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use super::shape::Shape;
use crate::geom::{Vector, orthonormal_basis};

/// Number of directions spread over the sphere: they lie 16° apart.
const SPREAD: usize = 160;
/// Greatest number of flat places of the surface that are tried as feet.
const FEET: usize = 16;
/// Cells into which a component of a normal is sorted: a flat place bends by less than 1.5°.
const NORMAL_STEPS: f64 = 80.0;
/// Height of the cells into which the heights of triangles are sorted, mm.
const LEVEL_MM: f64 = 0.25;
/// Height by which a flat foot may stand above the lowest point, mm.
const FOOT_MM: f64 = 0.3;

/// Returns directions spread evenly over the sphere, on a Fibonacci spiral: González, "Measurement
/// of areas on a sphere using Fibonacci and latitude–longitude lattices", Mathematical Geosciences
/// 42, 2010.
pub(crate) fn spread() -> Vec<Vector> {
    let turn = PI * (3.0 - 5f64.sqrt());
    let direction = |index: usize| {
        let z = 1.0 - (2.0 * index as f64 + 1.0) / SPREAD as f64;
        let (sin, cos) = (turn * index as f64).sin_cos();
        let aside = (1.0 - z * z).sqrt();
        Vector::new(aside * cos, aside * sin, z)
    };
    (0..SPREAD).map(direction).collect()
}

/// Returns the 26 directions toward the faces, edges and corners of a cube in the model's axes.
pub(crate) fn of_cube() -> Vec<Vector> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.into_iter().flat_map(|x| {
        steps
            .into_iter()
            .flat_map(move |y| steps.into_iter().map(move |z| Vector::new(x, y, z)))
    });
    all.filter(|direction| direction.norm() > 0.0)
        .map(|direction| direction.normalize())
        .collect()
}

/// Returns the directions with which a flat place of the surface lies on the plate, the largest
/// first.
pub(super) fn on_feet(shape: &Shape) -> Vec<Vector> {
    let mut places: BTreeMap<[i64; 4], Vector> = BTreeMap::new();
    for (corners, normal) in shape.mesh.iter_corners().zip(&shape.normals) {
        let [a, b, c] = corners;
        let area = (b - a).cross(&(c - a));
        let level = (normal.dot(&a.coords) / LEVEL_MM).round() as i64;
        let [x, y, z] = [0, 1, 2].map(|axis| (normal[axis] * NORMAL_STEPS).round() as i64);
        *places.entry([x, y, z, level]).or_insert_with(Vector::zeros) += area;
    }
    let mut places: Vec<(f64, Vector)> = places
        .into_values()
        .filter_map(|area| Some((area.norm(), -area.try_normalize(0.0)?)))
        .collect();
    places.sort_by(|a, b| b.0.total_cmp(&a.0));
    let is_foot = |up: &Vector| {
        let heights = || shape.mesh.vertices().iter().map(|p| up.dot(&p.coords));
        let floor_mm = heights().fold(f64::INFINITY, f64::min);
        let normals = shape.mesh.iter_corners().zip(&shape.normals);
        let mut flat =
            normals.filter(|(_, normal)| normal.dot(up) < -1.0 + 1.0 / NORMAL_STEPS.powi(2));
        flat.any(|([a, _, _], _)| up.dot(&a.coords) - floor_mm < FOOT_MM)
    };
    let largest = places.into_iter().take(2 * FEET).map(|(_, up)| up);
    largest.filter(is_foot).take(FEET).collect()
}

/// Returns the directions around `up` that lean from it by an angle, in `count` ways.
pub(super) fn around(up: &Vector, lean_deg: f64, count: usize) -> Vec<Vector> {
    let (u, v) = orthonormal_basis(up);
    let (sin, cos) = lean_deg.to_radians().sin_cos();
    let direction = |index: usize| {
        let (y, x) = (TAU * index as f64 / count as f64).sin_cos();
        up * cos + (u * x + v * y) * sin
    };
    (0..count).map(direction).collect()
}
