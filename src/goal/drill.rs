//! The material along an axis, felt by upright lines: the room for a socket.

use super::site::Site;
use crate::geom::{Frame, Point};
use crate::mesh::NearAxis;

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

/// The surface of a model near an axis, over a point of it; upright, mm.
pub(super) struct Drill(NearAxis);

/// A bore to feel for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hole {
    pub radius_mm: f64,
    /// The wall around it and behind its bottom, mm.
    pub wall_mm: f64,
    pub depth_mm: f64,
}

impl Drill {
    /// Collects the surface that comes within `reach_mm` of the upright axis through `seat`.
    pub fn new(site: &Site, seat: &Point, reach_mm: f64) -> Self {
        let frame = Frame {
            origin: site.upright.to_model(seat),
            ..site.upright
        };
        Self(NearAxis::new(site.solid.mesh(), &frame, reach_mm))
    }

    /// Returns true if a hole upward from the seat has its wall: at its bottom, behind it, and
    /// around at least half of its depth.
    pub fn holds(&self, hole: Hole) -> bool {
        let around = self.0.ring(LINES, hole.radius_mm + hole.wall_mm, TURN_RAD);
        let is_walled = |z: f64| around.iter().all(|line| line.is_inside(z));
        let looks = (0..LOOKS).map(|i| hole.depth_mm * (1.0 - i as f64 / LOOKS as f64));
        let held = looks.filter(|z| is_walled(*z)).count();
        let behind_mm = hole.depth_mm + hole.wall_mm;
        let bottom = self
            .0
            .ring(BOTTOM_LINES, BOTTOM_RATIO * hole.radius_mm, TURN_RAD);
        is_walled(hole.depth_mm)
            && bottom.iter().all(|line| line.is_inside(behind_mm))
            && held as f64 >= HELD_RATIO * LOOKS as f64
    }
}
