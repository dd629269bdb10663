//! The bore of a rod through the parts of the shell.

use crate::geom::{Frame, Point, Vector};
use crate::mesh::{TriMesh, primitives};
use crate::shell::Keep;

/// Number of sides of a bore.
const BORE_SIDES: u32 = 48;
/// Distance by which a bore begins before its part and ends beyond it, mm.
const BEYOND_MM: f64 = 0.25;

/// A bore for a rod through the parts over a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RodBore {
    /// The index of the face.
    pub face: usize,
    /// The point at which it enters the parts, and the one on the plane at which they end.
    pub ends: [Point; 2],
    /// Its diameter, mm.
    pub diameter_mm: f64,
}

impl RodBore {
    /// Returns its depth in the parts, mm.
    pub fn depth_mm(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    fn way(&self) -> Vector {
        (self.ends[1] - self.ends[0]).normalize()
    }

    /// Returns it as a body to take away. Its flats lie outside of its diameter.
    pub(super) fn body(&self) -> TriMesh {
        let way = self.way();
        let frame = Frame::with_axis(self.ends[0] - way * BEYOND_MM, &way);
        let half_rad = std::f64::consts::PI / f64::from(BORE_SIDES);
        let radius_mm = 0.5 * self.diameter_mm / half_rad.cos();
        primitives::cylinder(radius_mm, self.depth_mm() + 2.0 * BEYOND_MM, BORE_SIDES)
            .map_vertices(|p| frame.to_model(p))
    }

    /// Returns the material about it that stays solid.
    pub(super) fn keep(&self, wall_mm: f64) -> Keep {
        Keep {
            from: self.ends[0] - self.way() * (3.0 * wall_mm),
            to: self.ends[1],
            radius_mm: 0.5 * self.diameter_mm + wall_mm,
        }
    }
}
