//! The material along an axis, felt by upright lines: the room for a socket.

use std::f64::consts::TAU;

use super::site::Site;
use crate::geom::{Point, Vector};

/// The number of lines around a socket, and the number of depths that are felt.
const LINES: usize = 16;
const LOOKS: usize = 8;
/// The number of lines that feel the bottom, and their distance from the axis in radii of the bore.
const BOTTOM_LINES: usize = 4;
const BOTTOM_RATIO: f64 = 0.3;
/// The angle of the first line, rad: off a model's planes of symmetry.
const TURN_RAD: f64 = 0.3;
/// The share of its depth over which a socket must have a wall all around.
const HELD_RATIO: f64 = 0.5;

/// The triangles of a model near an axis, over a point of its surface; upright, mm.
pub(super) struct Drill {
    triangles: Vec<[Vector; 3]>,
}

/// A bore to feel for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hole {
    pub radius_mm: f64,
    /// The wall around it and behind its bottom, mm.
    pub wall_mm: f64,
    pub depth_mm: f64,
}

impl Drill {
    /// Collects the triangles that come within `reach_mm` of the upright axis through `seat`.
    pub fn new(site: &Site, seat: &Point, reach_mm: f64) -> Self {
        let triangles = site.solid.mesh().iter_corners();
        let local = triangles.map(|corners| corners.map(|p| site.upright.to_local(&p) - seat));
        let is_near = |corners: &[Vector; 3]| {
            (0..2).all(|axis| {
                let along = corners.map(|corner| corner[axis]);
                let most = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
                let least = along.into_iter().fold(f64::INFINITY, f64::min);
                least <= reach_mm && most >= -reach_mm
            })
        };
        Self {
            triangles: local.filter(is_near).collect(),
        }
    }

    /// Returns true if a hole upward from the seat has its wall: at its bottom, behind it, and
    /// around at least half of its depth.
    pub fn holds(&self, hole: Hole) -> bool {
        let around = self.lines(LINES, hole.radius_mm + hole.wall_mm);
        let is_walled = |z: f64| around.iter().all(|line| is_inside(line, z));
        let looks = (0..LOOKS).map(|i| hole.depth_mm * (1.0 - i as f64 / LOOKS as f64));
        let held = looks.filter(|z| is_walled(*z)).count();
        let behind_mm = hole.depth_mm + hole.wall_mm;
        let bottom = self.lines(BOTTOM_LINES, BOTTOM_RATIO * hole.radius_mm);
        is_walled(hole.depth_mm)
            && bottom.iter().all(|line| is_inside(line, behind_mm))
            && held as f64 >= HELD_RATIO * LOOKS as f64
    }

    /// Returns the crossings of upright lines on a circle about the axis.
    fn lines(&self, count: usize, radius_mm: f64) -> Vec<Vec<Crossing>> {
        let line = |i: usize| {
            let (sin, cos) = (TAU * i as f64 / count as f64 + TURN_RAD).sin_cos();
            let at = Vector::new(radius_mm * cos, radius_mm * sin, 0.0);
            let crossings = self.triangles.iter();
            crossings
                .filter_map(|c| cross(&c.map(|p| p - at)))
                .collect()
        };
        (0..count).map(line).collect()
    }
}

/// A place at which a line enters or leaves the material.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    height_mm: f64,
    enters: bool,
}

/// Returns the crossing of the z axis with a triangle, if it passes through it.
fn cross([a, b, c]: &[Vector; 3]) -> Option<Crossing> {
    let turn = |p: &Vector, q: &Vector| p.x * q.y - p.y * q.x;
    let weights = [turn(b, c), turn(c, a), turn(a, b)];
    let area: f64 = weights.iter().sum();
    let is_met = area != 0.0 && weights.iter().all(|w| w * area.signum() >= 0.0);
    is_met.then(|| Crossing {
        height_mm: (weights[0] * a.z + weights[1] * b.z + weights[2] * c.z) / area,
        enters: area < 0.0,
    })
}

/// Returns true if a height on a line lies in the material.
fn is_inside(line: &[Crossing], height_mm: f64) -> bool {
    let below = line
        .iter()
        .filter(|crossing| crossing.height_mm < height_mm);
    below
        .map(|crossing| if crossing.enters { 1 } else { -1 })
        .sum::<i32>()
        > 0
}
