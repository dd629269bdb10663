//! The material along an axis, felt by upright lines: the room for a socket.

use super::site::Site;
use crate::geom::{Frame, Point};
use crate::mesh::{AxialLine, NearAxis};

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

/// The lines around a bore and through its bottom, at whatever depth it ends.
pub(super) struct Bore {
    around: Vec<AxialLine>,
    bottom: Vec<AxialLine>,
    wall_mm: f64,
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

    /// Feels for a bore of this radius, with a wall around it and behind its bottom, mm.
    pub fn bore(&self, radius_mm: f64, wall_mm: f64) -> Bore {
        let ring = |count, radius_mm| self.0.ring(count, radius_mm, TURN_RAD);
        Bore {
            around: ring(LINES, radius_mm + wall_mm),
            bottom: ring(BOTTOM_LINES, BOTTOM_RATIO * radius_mm),
            wall_mm,
        }
    }
}

impl Bore {
    /// Returns true if a hole of this depth, upward from the seat, has its wall. That is wanted at
    /// its bottom, behind it, and around at least half of its depth.
    pub fn holds(&self, depth_mm: f64) -> bool {
        let is_walled = |z: f64| self.around.iter().all(|line| line.is_inside(z));
        let looks = (0..LOOKS).map(|i| depth_mm * (1.0 - i as f64 / LOOKS as f64));
        let held = looks.filter(|z| is_walled(*z)).count();
        let behind_mm = depth_mm + self.wall_mm;
        is_walled(depth_mm)
            && self.bottom.iter().all(|line| line.is_inside(behind_mm))
            && held as f64 >= HELD_RATIO * LOOKS as f64
    }
}
