//! A drain hole as the kit states it, and the prism that it takes away.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::geom::{Point, orthonormal_basis};
use crate::mesh::{Csg, TriMesh};

/// Number of sides of every bore, around the circle of its diameter.
const SIDES: u32 = 48;
/// Distance from the flank of a bore up to which points lie on it, mm.
const ON_FLANK_MM: f64 = 1e-3;

/// A drain hole as the kit states it: a straight bore from the outside into a void.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedHole {
    /// The name on the sheet, such as `D1`.
    pub id: String,
    /// The name of the void that it opens, such as `V1`.
    pub void: String,
    /// The outer end of its axis, just outside the body, model frame, mm.
    pub from_mm: [f64; 3],
    /// The inner end, just inside the void, model frame, mm.
    pub to_mm: [f64; 3],
    /// The free diameter, mm.
    pub diameter_mm: f64,
    /// The diameter at the outer end, mm, if the hole is wider there for a plug.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mouth_mm: Option<f64>,
    /// The plug that closes it afterwards.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plug: Option<PromisedPlug>,
    /// The volume of material that it takes, mm³.
    pub volume_mm3: f64,
}

/// A printed plug that closes a drain hole once the void is empty.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedPlug {
    /// The name of its part, such as `P02`.
    pub part: String,
    /// The gap between its flank and that of the hole, mm.
    pub gap_mm: f64,
}

impl PromisedHole {
    /// Returns the plug as it should be in a body with this outside; `None` if it gets none, or if
    /// its numbers bound none.
    pub(super) fn plug_in(&self, outer: &Csg) -> Option<TriMesh> {
        let gap_mm = self.plug.as_ref()?.gap_mm;
        let plug = outer.intersect(&self.prism_less(gap_mm)?).ok()?;
        plug.to_mesh()
            .ok()
            .filter(|mesh| !mesh.triangles().is_empty())
    }

    /// Returns by how much the plug is wider than the narrowest place of the hole in the wall, on
    /// each side, mm; `None` if the numbers bound no hole.
    pub(super) fn hold_mm(&self, plug: &TriMesh, body: &Csg) -> Option<f64> {
        let taken = body.intersect(&self.prism()?).ok()?;
        let taken = taken.to_mesh().ok()?;
        let across = |p: &Point| self.across_mm(p).unwrap_or([0.0, f64::INFINITY]);
        let widths = plug.vertices().iter().map(|p| across(p)[0]);
        let flank = taken.vertices().iter().map(across);
        let flank = flank.filter(|[across, flank]| *across > flank - ON_FLANK_MM);
        let narrowest_mm = flank
            .map(|[across, _]| across)
            .fold(f64::INFINITY, f64::min);
        Some(widths.fold(0.0, f64::max) - narrowest_mm)
    }

    /// Returns how far a point is from the axis, as flats are, and how far the flats are at its
    /// height, mm.
    fn across_mm(&self, p: &Point) -> Option<[f64; 2]> {
        let (from, to) = (Point::from(self.from_mm), Point::from(self.to_mm));
        let axis = (to - from).try_normalize(f64::EPSILON)?;
        let (u, v) = orthonormal_basis(&axis);
        let (x, y) = ((p - from).dot(&u), (p - from).dot(&v));
        let step = TAU / f64::from(SIDES);
        let beside = y.atan2(x).rem_euclid(step) - 0.5 * step;
        let share = (p - from).dot(&axis) / (to - from).norm();
        let mouth_mm = self.mouth_mm.unwrap_or(self.diameter_mm);
        let flank_mm = 0.5 * (mouth_mm + (self.diameter_mm - mouth_mm) * share);
        Some([x.hypot(y) * beside.cos(), flank_mm])
    }

    /// Returns its diameter at the wider end, mm.
    pub(super) fn widest_mm(&self) -> f64 {
        self.diameter_mm.max(self.mouth_mm.unwrap_or(0.0))
    }

    /// Returns the prism that is bored; `None` if its numbers bound none.
    pub(super) fn prism(&self) -> Option<Csg> {
        self.prism_less(0.0)
    }

    /// Returns the prism that is bored, smaller by a gap normal to its flanks, mm.
    fn prism_less(&self, gap_mm: f64) -> Option<Csg> {
        let (from, to) = (Point::from(self.from_mm), Point::from(self.to_mm));
        let along = to - from;
        let axis = along.try_normalize(f64::EPSILON)?;
        let (u, v) = orthonormal_basis(&axis);
        let mouth_mm = self.mouth_mm.unwrap_or(self.diameter_mm);
        let slope = 0.5 * (mouth_mm - self.diameter_mm) / along.norm();
        let less_mm = 2.0 * gap_mm * slope.hypot(1.0);
        let rim = |middle: Point, diameter_mm: f64| {
            let radius_mm = 0.5 * (diameter_mm - less_mm) / (PI / f64::from(SIDES)).cos();
            (0..SIDES).map(move |side| {
                let (sin, cos) = (TAU * f64::from(side) / f64::from(SIDES)).sin_cos();
                middle + (u * cos + v * sin) * radius_mm
            })
        };
        let ends = rim(from, mouth_mm).chain(rim(to, self.diameter_mm));
        let ends: Vec<Point> = ends.collect();
        Csg::convex_hull(&ends)
            .ok()
            .filter(|prism| !prism.is_empty())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::ball;

    /// Returns a hole of 2 mm through a wall of 2 mm at the top of a ball, and how far its plug
    /// holds. The hole widens by a slope, and begins at a height over the ball.
    fn hold_mm(radius_mm: f64, slope: f64, over_mm: f64) -> f64 {
        let length_mm = over_mm + 2.6;
        let hole = PromisedHole {
            id: "D1".to_owned(),
            void: "V1".to_owned(),
            from_mm: [0.0, 0.0, radius_mm + over_mm],
            to_mm: [0.0, 0.0, radius_mm + over_mm - length_mm],
            diameter_mm: 2.0,
            mouth_mm: Some(2.0 + 2.0 * slope * length_mm),
            plug: Some(PromisedPlug {
                part: "P02".to_owned(),
                gap_mm: 0.15,
            }),
            volume_mm3: 0.0,
        };
        let [outer, inner] = [radius_mm, radius_mm - 2.0]
            .map(|radius_mm| Csg::of_mesh(&ball(&Point::origin(), radius_mm, 5)).unwrap());
        let plug = hole.plug_in(&outer).unwrap();
        hole.hold_mm(&plug, &outer.subtract(&inner).unwrap())
            .unwrap()
    }

    #[test]
    fn flanks_that_lean_hold_a_plug_in_a_curved_wall_and_steep_ones_do_not() {
        for radius_mm in [6.0, 8.0, 20.0] {
            assert!(hold_mm(radius_mm, 0.25, 0.3) > 0.2, "{radius_mm}");
            assert!(hold_mm(radius_mm, 0.08, 0.3) < 0.05, "{radius_mm}");
        }
    }

    #[test]
    fn a_hole_that_begins_far_out_is_as_wide_in_the_wall_as_it_is_there() {
        // The same mouth over a long way makes steep flanks.
        let slope = 0.25 * 2.9 / 302.6;
        assert!(hold_mm(8.0, slope, 300.0) < 0.05);
    }
}
