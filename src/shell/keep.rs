//! Regions that must stay solid besides the wall.

use crate::geom::Point;

/// A region that stays solid, in model coordinates: the points within `radius_mm` of the segment
/// from `from` to `to`. It is a ball if the two ends are the same point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Keep {
    /// One end of the segment.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// Radius about the segment, mm.
    pub radius_mm: f64,
}

impl Keep {
    /// Returns a ball that stays solid.
    pub fn ball(center: Point, radius_mm: f64) -> Self {
        Self {
            from: center,
            to: center,
            radius_mm,
        }
    }

    /// Returns the distance of a point from the region, mm; negative inside.
    pub fn distance_mm(&self, point: &Point) -> f64 {
        let (along, offset) = (self.to - self.from, point - self.from);
        let length_squared = along.norm_squared();
        let ratio = if length_squared > 0.0 {
            offset.dot(&along) / length_squared
        } else {
            0.0
        };
        (offset - along * ratio.clamp(0.0, 1.0)).norm() - self.radius_mm
    }
}
