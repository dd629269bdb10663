//! The energy of the connection of two polyhedra, after section 4 of the supplement.
//!
//! Two faces f and g with normals n and centres c are to meet: n_f + n_g = 0. One centre lies
//! before the other, c_f + t n_f = c_g with t > 0. A disc about each centre lies in its face, and
//! the cylinder between both discs keeps the distance from the surface.

use super::energy::{Field, nearness};
use crate::geom::{Point, Vector, orthonormal_basis};

/// Step of differences, over the scale.
const STEP_RATIO: f64 = 1e-6;
/// Sections of the cylinder, and samples about each.
const SECTIONS: usize = 5;
const AROUND: usize = 8;

/// The faces that are to meet, and what they are to leave.
#[derive(Debug, Clone)]
pub(super) struct Link {
    /// The loops of both faces among the corners of both polyhedra.
    pub loops: [Vec<usize>; 2],
    /// The radius of the disc, mm.
    pub radius_mm: f64,
    /// The least gap between both faces, mm.
    pub gap_mm: f64,
}

/// Two faces as they lie.
#[derive(Debug, Clone)]
pub(super) struct Facing {
    loops: [Vec<Point>; 2],
    pub normals: [Vector; 2],
    pub centers: [Point; 2],
}

impl Facing {
    pub fn of(link: &Link, corners: &[Point]) -> Self {
        let loops = link.loops.each_ref();
        let loops = loops.map(|of| of.iter().map(|&k| corners[k]).collect::<Vec<Point>>());
        let planes = loops.each_ref().map(|of| plane_of(of));
        Self {
            normals: planes.map(|(normal, _)| normal),
            centers: planes.map(|(_, center)| center),
            loops,
        }
    }

    /// Returns how far the second centre lies from the first one, along its normal and beside it,
    /// mm.
    pub fn ways_mm(&self) -> [f64; 2] {
        let way = self.centers[1] - self.centers[0];
        let along = way.dot(&self.normals[0]);
        [along, (way - self.normals[0] * along).norm()]
    }

    /// Returns the angle by which the normals are not opposed, radians.
    pub fn turn_rad(&self) -> f64 {
        let sine = 0.5 * (self.normals[0] + self.normals[1]).norm();
        2.0 * sine.min(1.0).asin()
    }

    /// Returns the least distance of a centre from an edge of its face, mm: less than zero outside.
    pub fn disc_mm(&self) -> f64 {
        let all = (0..2).flat_map(|side| self.reaches(side));
        all.fold(f64::INFINITY, f64::min)
    }

    /// Returns the distances of a centre from the edges of its face, mm.
    fn reaches(&self, side: usize) -> impl Iterator<Item = f64> + '_ {
        let (of, normal) = (&self.loops[side], self.normals[side]);
        (0..of.len()).map(move |k| {
            let [from, to] = [of[k], of[(k + 1) % of.len()]];
            let inward = normal.cross(&(to - from)).try_normalize(0.0);
            inward.map_or(0.0, |inward| inward.dot(&(self.centers[side] - from)))
        })
    }

    /// Returns samples of the cylinder between both discs, each with the share of the first centre.
    pub fn samples(&self, radius_mm: f64) -> Vec<(f64, Point)> {
        let (u, w) = orthonormal_basis(&self.normals[0]);
        let sections = (0..SECTIONS).map(|k| k as f64 / (SECTIONS - 1) as f64);
        let samples = sections.flat_map(|share| {
            let way = (self.centers[0] - self.centers[1]) * share;
            let middle = self.centers[1] + way;
            (0..AROUND).map(move |k| {
                let (sine, cosine) = (std::f64::consts::TAU * k as f64 / AROUND as f64).sin_cos();
                (share, middle + (u * cosine + w * sine) * radius_mm)
            })
        });
        samples.collect()
    }
}

/// Returns the normal and the mean of a loop.
fn plane_of(of: &[Point]) -> (Vector, Point) {
    let at = |k: usize| of[k % of.len()];
    let mean = (0..of.len()).map(|k| at(k).coords).sum::<Vector>() / of.len() as f64;
    let doubled = (0..of.len()).map(|k| (at(k).coords - mean).cross(&(at(k + 1).coords - mean)));
    let normal = doubled.sum::<Vector>().try_normalize(0.0);
    (normal.unwrap_or_else(Vector::zeros), Point::from(mean))
}

impl Link {
    /// Adds the gradient of the connection, and returns its energy.
    pub fn energy(
        &self,
        corners: &[Point],
        field: &Field,
        [shape, near]: [f64; 2],
        gradient: &mut [Vector],
    ) -> f64 {
        let step_mm = STEP_RATIO * field.scale_mm;
        let mut moved = corners.to_vec();
        for &corner in self.loops.iter().flatten() {
            for axis in 0..3 {
                let value = corners[corner][axis];
                let [low, high] = [-step_mm, step_mm].map(|step_mm| {
                    moved[corner][axis] = value + step_mm;
                    self.shape_energy(&moved, field.scale_mm)
                });
                moved[corner][axis] = value;
                gradient[corner][axis] += shape * (high - low) / (2.0 * step_mm);
            }
        }
        shape * self.shape_energy(corners, field.scale_mm)
            + self.add_nearness(corners, field, near, gradient)
    }

    fn shape_energy(&self, corners: &[Point], scale_mm: f64) -> f64 {
        let facing = Facing::of(self, corners);
        let [apart_mm, beside_mm] = facing.ways_mm();
        let lack = |lack_mm: f64| (lack_mm.max(0.0) / scale_mm).powi(2);
        let reaches = (0..2).flat_map(|side| facing.reaches(side));
        let discs = reaches.map(|reach_mm| lack(self.radius_mm - reach_mm));
        let turned = (facing.normals[0] + facing.normals[1]).norm_squared();
        turned + lack(beside_mm) + lack(self.gap_mm - apart_mm) + discs.sum::<f64>()
    }

    /// Adds the penalty of samples of the cylinder that are too near to the surface. Their places
    /// about the axis count as fixed.
    fn add_nearness(
        &self,
        corners: &[Point],
        field: &Field,
        weight: f64,
        gradient: &mut [Vector],
    ) -> f64 {
        let samples = Facing::of(self, corners).samples(self.radius_mm);
        let weight = weight / samples.len() as f64;
        let mut energy = 0.0;
        for (share, at) in &samples {
            let Some((lack, inward)) = nearness(at, field) else {
                continue;
            };
            energy += weight * lack * lack;
            let slope = inward * (-2.0 * weight * lack / field.scale_mm);
            for (of, share) in self.loops.iter().zip([*share, 1.0 - share]) {
                let each = slope * (share / of.len() as f64);
                of.iter().for_each(|&corner| gradient[corner] += each);
            }
        }
        energy
    }
}
