//! Regions that must stay solid besides the wall.

use crate::geom::Point;

/// A region that stays solid, in model coordinates: the points within `radius_mm` of the segment from `from` to `to`
/// (a ball when the two ends are the same point).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Keep {
    /// One end of the segment.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// The radius about the segment, mm.
    pub radius_mm: f64,
}

impl Keep {
    /// A ball that stays solid.
    pub fn ball(center: Point, radius_mm: f64) -> Self {
        Self { from: center, to: center, radius_mm }
    }
}
