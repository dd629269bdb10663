//! Regions that no cut enters, and the test of it.

use crate::geom::{Parting, Plane, Point};

/// A region of the body that no cut enters, such as that around a bore: the convex hull of some
/// points.
///
/// Balls ([`KeepClear`](crate::cut::KeepClear)) keep the seam away, which is seen. A region keeps
/// the plane away, wherever the surface is.
#[derive(Debug, Clone, PartialEq)]
pub struct KeepWhole {
    corners: Vec<Point>,
}

impl KeepWhole {
    /// Returns the region between some points of the model frame, mm.
    pub fn between(corners: Vec<Point>) -> Self {
        Self { corners }
    }

    /// Returns whether an endless plane enters the region.
    pub(crate) fn is_entered(&self, plane: &Plane) -> bool {
        let heights = self.corners.iter().map(|corner| plane.distance(corner));
        let ends = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
            [low.min(at), high.max(at)]
        });
        ends[0] < 0.0 && ends[1] > 0.0
    }

    /// Returns whether a cut enters the region within its limits. No limit may enter it.
    pub(crate) fn is_entered_within(&self, parting: &Parting) -> bool {
        let mut limits = parting.within.iter();
        self.is_entered(&parting.plane)
            && limits.all(|(limit, is_above)| self.is_above(limit) == *is_above)
    }

    /// Returns whether the region lies above a plane that does not enter it.
    pub(crate) fn is_above(&self, plane: &Plane) -> bool {
        let heights = self.corners.iter().map(|corner| plane.distance(corner));
        heights.sum::<f64>() >= 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;

    fn region() -> KeepWhole {
        let corner = |i: usize| {
            let pick = |axis: usize| [2.0, 4.0][i >> axis & 1];
            Point::new(pick(0), pick(1), pick(2))
        };
        KeepWhole::between((0..8).map(corner).collect())
    }

    #[test]
    fn a_cut_enters_a_region_that_it_parts_but_not_beyond_its_limits() {
        let level = |offset_mm: f64| Plane {
            normal: Vector::z(),
            offset_mm,
        };
        assert!(region().is_entered(&level(3.0)));
        assert!(!region().is_entered(&level(4.5)) && !region().is_entered(&level(1.5)));
        let aside = Plane {
            normal: Vector::x(),
            offset_mm: 5.0,
        };
        let parting = |is_above| Parting {
            plane: level(3.0),
            within: vec![(aside, is_above)],
        };
        assert!(region().is_entered_within(&parting(false)));
        assert!(!region().is_entered_within(&parting(true)));
    }
}
