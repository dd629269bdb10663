//! Probing a written part from points of the model, by rays and winding numbers.

use super::PartEvidence;
use crate::geom::{Bvh, Point, Vector};

/// A part with its surface ready for rays. Points and directions are in the model frame.
pub(super) struct PartProbe<'a> {
    pub(super) part: &'a PartEvidence,
    /// The tree over its triangles, print frame.
    pub(super) surface: Bvh,
}

impl<'a> PartProbe<'a> {
    pub(super) fn new(part: &'a PartEvidence) -> Self {
        Self {
            part,
            surface: Bvh::new(part.mesh.iter_corners()),
        }
    }

    /// Returns true if the part's surface does not cross the segment between two points.
    pub(super) fn is_clear(&self, from: &Point, to: &Point) -> bool {
        let [from, to] = [from, to].map(|p| self.part.pose.to_print(p));
        !self.surface.crosses_segment(&from, &to)
    }

    /// Returns the distance of a point from the part's surface, mm; `None` if it has none.
    pub(super) fn distance_mm(&self, model: &Point) -> Option<f64> {
        let at = self.part.pose.to_print(model);
        let nearest = self.surface.closest(&at, f64::INFINITY, &[])?;
        Some(nearest.distance_squared.sqrt())
    }

    /// Returns true if a point lies in the part's material.
    pub(super) fn contains(&self, model: &Point) -> bool {
        self.surface.winding(&self.part.pose.to_print(model)) != 0
    }

    /// Returns the distance from a point to the part's surface along a unit direction, mm; `None`
    /// if it is more than `reach_mm`.
    pub(super) fn distance_along(
        &self,
        model: &Point,
        direction: &Vector,
        reach_mm: f64,
    ) -> Option<f64> {
        let [from, to] =
            [*model, model + direction * reach_mm].map(|p| self.part.pose.to_print(&p));
        self.surface
            .first_crossing(&from, &to)
            .map(|share| share * reach_mm)
    }
}
