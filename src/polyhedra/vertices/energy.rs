//! The energy of the vertices: volume, and penalties for what must not be.

use rayon::prelude::*;

use super::sheet::Sheet;
use super::start::Shape;
use crate::geom::{Point, Vector};
use crate::mesh::MeshDistance;

/// A point of the surface that is a mean of corners.
#[derive(Debug, Clone, PartialEq)]
struct Sample {
    /// The corners and their weights, which add up to one.
    weights: Vec<(u32, f64)>,
}

/// The combinatorics of a polyhedron whose corners move.
///
/// A face that is no triangle gets a vertex at the mean of its corners.
#[derive(Debug, Clone)]
pub(super) struct Structure {
    faces: Vec<Vec<u32>>,
    /// Triangles of corners and means; each point as a mean of corners.
    triangles: Vec<[Sample; 3]>,
    samples: Vec<Sample>,
}

/// The weights of the penalties.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// Of samples that are too near to the surface.
    pub near: f64,
    /// Of corners off the plane of their face.
    pub bent: f64,
    /// Of corners above the plane of another face.
    pub reflex: f64,
}

/// The terms that the vertices are to keep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field<'a> {
    pub distance: &'a MeshDistance,
    pub distance_mm: f64,
    /// The length by which energies are made plain numbers, mm.
    pub scale_mm: f64,
    /// The sheet into which every face must go; `None` for any size.
    pub sheet: Option<Sheet>,
}

impl Structure {
    /// Samples each triangle with `per_edge` points inside each edge: V + K·E + K(K−1)/2·T points
    /// for V corners, E edges and T triangles.
    pub fn new(shape: &Shape, per_edge: usize) -> Self {
        let triangles: Vec<[Sample; 3]> = shape.faces.iter().flat_map(|f| fan(f)).collect();
        let mut samples = Vec::new();
        let n = per_edge + 1;
        for triangle in &triangles {
            for i in 0..=n {
                for j in 0..=n - i {
                    let [a, b] = [i, j].map(|k| k as f64 / n as f64);
                    let sample = blend(triangle, [a, b, 1.0 - a - b]);
                    samples.push(sample);
                }
            }
        }
        let is_less = |a: &Sample, b: &Sample| a.weights.partial_cmp(&b.weights);
        samples.sort_by(|a, b| is_less(a, b).unwrap_or(std::cmp::Ordering::Equal));
        samples.dedup();
        Self {
            faces: shape.faces.clone(),
            triangles,
            samples,
        }
    }

    /// Returns the number of samples.
    #[cfg(test)]
    pub fn sample_count(&self) -> usize {
        self.samples.len()
    }

    /// Returns the volume, mm³.
    pub fn volume_mm3(&self, corners: &[Point]) -> f64 {
        let six = self.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.each_ref().map(|sample| sample.at(corners).coords);
            a.dot(&b.cross(&c))
        });
        six.sum::<f64>() / 6.0
    }

    /// Returns the least signed distance of a sample from the surface, mm.
    pub fn least_mm(&self, corners: &[Point], distance: &MeshDistance) -> f64 {
        let all: Vec<f64> = self
            .samples
            .par_iter()
            .map(|sample| distance.signed(&sample.at(corners)))
            .collect();
        all.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Returns the normal and the mean of each face.
    pub fn planes(&self, corners: &[Point]) -> Vec<(Vector, Point)> {
        let plane = |face: &Vec<u32>| {
            let at = |k: usize| corners[face[k % face.len()] as usize];
            let mean = (0..face.len()).map(|k| at(k).coords).sum::<Vector>() / face.len() as f64;
            let doubled =
                (0..face.len()).map(|k| (at(k).coords - mean).cross(&(at(k + 1).coords - mean)));
            let normal = doubled.sum::<Vector>();
            let unit = normal.try_normalize(0.0).unwrap_or_else(Vector::zeros);
            (unit, Point::from(mean))
        };
        self.faces.iter().map(plane).collect()
    }

    /// Returns the energy and its gradient. Normals count as fixed in the gradients of the
    /// penalties for bent faces and reflex corners.
    pub fn energy(
        &self,
        corners: &[Point],
        field: &Field,
        weights: &Weights,
    ) -> (f64, Vec<Vector>) {
        let mut gradient = vec![Vector::zeros(); corners.len()];
        let mut energy = self.add_volume(corners, field.scale_mm, &mut gradient);
        energy += self.add_nearness(corners, field, weights.near, &mut gradient);
        let planes = self.planes(corners);
        for (face, (normal, mean)) in self.faces.iter().zip(&planes) {
            for (k, corner) in corners.iter().enumerate() {
                let above = normal.dot(&(corner - mean)) / field.scale_mm;
                let is_own = face.contains(&(k as u32));
                let weight = if is_own { weights.bent } else { weights.reflex };
                if is_own || above > 0.0 {
                    energy += weight * above * above;
                    gradient[k] += normal * (2.0 * weight * above / field.scale_mm);
                }
            }
        }
        energy += self.add_sheet(corners, field, weights.bent, &mut gradient);
        (energy, gradient)
    }

    /// Adds the penalty of faces that are larger than the sheet.
    fn add_sheet(
        &self,
        corners: &[Point],
        field: &Field,
        weight: f64,
        gradient: &mut [Vector],
    ) -> f64 {
        let Some(sheet) = field.sheet else {
            return 0.0;
        };
        let mut energy = 0.0;
        for (face, (normal, _)) in self.faces.iter().zip(self.planes(corners)) {
            let own = points_of(face, corners);
            let (penalty, slopes) = sheet.penalty(&own, &normal, field.scale_mm);
            energy += weight * penalty;
            for (&corner, slope) in face.iter().zip(slopes) {
                gradient[corner as usize] += slope * weight;
            }
        }
        energy
    }

    /// Returns true if the samples keep the distance, and every face goes into the sheet.
    pub fn keeps(&self, corners: &[Point], field: &Field) -> bool {
        let fits = |sheet: Sheet| {
            let mut faces = self.faces.iter().zip(self.planes(corners));
            faces.all(|(face, (normal, _))| sheet.holds(&points_of(face, corners), &normal))
        };
        field.sheet.is_none_or(fits) && self.least_mm(corners, field.distance) >= field.distance_mm
    }

    fn add_volume(&self, corners: &[Point], scale_mm: f64, gradient: &mut [Vector]) -> f64 {
        let unit = scale_mm.powi(3);
        for triangle in &self.triangles {
            let at = triangle.each_ref().map(|sample| sample.at(corners).coords);
            for k in 0..3 {
                let slope = at[(k + 1) % 3].cross(&at[(k + 2) % 3]) / 6.0;
                triangle[k].spread(&(slope * (-1.0 / unit)), gradient);
            }
        }
        -self.volume_mm3(corners) / unit
    }

    fn add_nearness(
        &self,
        corners: &[Point],
        field: &Field,
        weight: f64,
        gradient: &mut [Vector],
    ) -> f64 {
        let share = weight / self.samples.len() as f64;
        let found: Vec<Option<(f64, Vector)>> = self
            .samples
            .par_iter()
            .map(|sample| nearness(&sample.at(corners), field))
            .collect();
        let mut energy = 0.0;
        for (sample, found) in self.samples.iter().zip(found) {
            if let Some((lack, inward)) = found {
                energy += share * lack * lack;
                let slope = inward * (-2.0 * share * lack / field.scale_mm);
                sample.spread(&slope, gradient);
            }
        }
        energy
    }
}

/// Returns the corners of a face.
fn points_of(face: &[u32], corners: &[Point]) -> Vec<Point> {
    face.iter().map(|&k| corners[k as usize]).collect()
}

/// Returns by how much a point is too near to the surface, over the scale, and the direction away
/// from it; `None` if it is far enough.
pub(super) fn nearness(at: &Point, field: &Field) -> Option<(f64, Vector)> {
    let signed = field.distance.signed(at);
    if signed >= field.distance_mm {
        return None;
    }
    let nearest = field.distance.bvh().closest(at, f64::INFINITY, &[])?;
    let away = (at - nearest.point).try_normalize(0.0)?;
    let inward = if signed >= 0.0 { away } else { -away };
    Some(((field.distance_mm - signed) / field.scale_mm, inward))
}

impl Sample {
    fn at(&self, corners: &[Point]) -> Point {
        let sum = self.weights.iter();
        let sum = sum.map(|&(corner, weight)| corners[corner as usize].coords * weight);
        Point::from(sum.sum::<Vector>())
    }

    /// Adds the gradient with respect to the sample to those of the corners.
    fn spread(&self, slope: &Vector, gradient: &mut [Vector]) {
        for &(corner, weight) in &self.weights {
            gradient[corner as usize] += slope * weight;
        }
    }
}

/// Returns the triangles of a face: itself, or a fan about the mean of its corners.
fn fan(face: &[u32]) -> Vec<[Sample; 3]> {
    let single = |corner: u32| Sample {
        weights: vec![(corner, 1.0)],
    };
    if let [a, b, c] = *face {
        return vec![[a, b, c].map(single)];
    }
    let weight = 1.0 / face.len() as f64;
    let mean = Sample {
        weights: face.iter().map(|&corner| (corner, weight)).collect(),
    };
    let sides = (0..face.len()).map(|k| [face[k], face[(k + 1) % face.len()]]);
    sides
        .map(|[a, b]| [single(a), single(b), mean.clone()])
        .collect()
}

/// Returns the mean of a triangle's points with these weights; equal means have equal form.
fn blend(triangle: &[Sample; 3], weights: [f64; 3]) -> Sample {
    /// Weights are rounded to this, so that points of shared edges are found to be the same.
    const STEPS: f64 = 1e12;
    let mut sum: Vec<(u32, f64)> = Vec::new();
    for (sample, weight) in triangle.iter().zip(weights) {
        for &(corner, share) in &sample.weights {
            match sum.iter_mut().find(|(known, _)| *known == corner) {
                Some((_, total)) => *total += weight * share,
                None => sum.push((corner, weight * share)),
            }
        }
    }
    let round = |(corner, weight): (u32, f64)| (corner, (weight * STEPS).round() / STEPS);
    let mut weights: Vec<(u32, f64)> = sum.into_iter().map(round).collect();
    weights.retain(|&(_, weight)| weight > 0.0);
    weights.sort_by_key(|&(corner, _)| corner);
    Sample { weights }
}

#[cfg(test)]
mod tests {
    use super::super::start::StartSolid;
    use super::*;
    use crate::mesh::primitives;

    #[test]
    fn samples_are_as_many_as_the_supplement_says() {
        for (solid, [v, e, t]) in
            StartSolid::ALL
                .iter()
                .zip([[8 + 6, 12 + 24, 24], [20 + 12, 30 + 60, 60], [12, 30, 20]])
        {
            let shape = solid.shape(&Point::origin(), 1.0).unwrap();
            for k in [1, 2, 5] {
                let structure = Structure::new(&shape, k);
                assert_eq!(structure.sample_count(), v + k * e + k * (k - 1) / 2 * t);
            }
        }
    }

    #[test]
    fn the_gradients_of_volume_and_nearness_are_those_of_differences() {
        let ball = primitives::ball(&Point::origin(), 50.0, 4);
        let distance = MeshDistance::new(&ball);
        let field = Field {
            distance: &distance,
            distance_mm: 5.0,
            scale_mm: 50.0,
            sheet: None,
        };
        let weights = Weights {
            near: 3.0,
            bent: 0.0,
            reflex: 0.0,
        };
        let shape = StartSolid::Icosahedron
            .shape(&Point::new(1.0, 2.0, -3.0), 46.0)
            .unwrap();
        let structure = Structure::new(&shape, 3);
        let energy = |corners: &[Point]| structure.energy(corners, &field, &weights).0;
        let (_, gradient) = structure.energy(&shape.corners, &field, &weights);
        for k in 0..shape.corners.len() {
            for axis in 0..3 {
                const STEP: f64 = 1e-4;
                let moved = |step: f64| {
                    let mut corners = shape.corners.clone();
                    corners[k][axis] += step;
                    energy(&corners)
                };
                let slope = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
                assert!(
                    (slope - gradient[k][axis]).abs() < 1e-5,
                    "{slope} {}",
                    gradient[k][axis]
                );
            }
        }
    }
}
