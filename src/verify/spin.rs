//! The foot of a top: the lowest point it spins on, and how far it leans there.

use serde::{Deserialize, Serialize};

use super::{Aim, Hardware, HardwareKind};
use crate::geom::{Point, Vector};
use crate::goal::{GoalKind, Lean};
use crate::mesh::{Csg, MeshDistance, TriMesh};

/// The facts about the contact of a top that stands upright on it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpinFacts {
    /// The depth of the lowest point below the contact, mm.
    pub below_mm: f64,
    /// The distance from the contact to the tip's end, or to the surface without a tip, mm.
    pub gap_mm: f64,
    /// True if it spins on a tip.
    pub has_tip: bool,
    /// The radius of the tip's end or of the foot, mm; zero for a point.
    pub radius_mm: f64,
    /// The lean at which more than the tip or the foot touches the floor, degrees.
    pub lean_deg: f64,
}

impl SpinFacts {
    /// Finds the facts of a top from its outer surface (model frame) and its hardware; `None` for
    /// other goals.
    pub fn of_top(aim: &Aim, hardware: &[Hardware], outer: &TriMesh) -> Option<Self> {
        if aim.kind != GoalKind::Top {
            return None;
        }
        let frame = aim.frame();
        let corners = hull_corners(outer);
        let corners: Vec<Point> = corners.iter().map(|p| frame.to_local(p)).collect();
        let tip = hardware
            .iter()
            .find(|piece| piece.kind == HardwareKind::Tip);
        let lowest_mm = corners.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        let (gap_mm, end_mm, lean) = match tip {
            Some(tip) => {
                let (end, radius_mm) = (Point::from(tip.to_mm), 0.5 * tip.diameter_mm);
                let end = frame.to_local(&end);
                let over_end = corners.iter().map(|p| p - Vector::z() * end.z);
                (end.coords.norm(), end.z, Lean::on_tip(over_end, radius_mm))
            }
            None => {
                let gap_mm = MeshDistance::new(outer).signed(&frame.origin).abs();
                let lean = Lean::on_foot(&corners, outer.longest_side_mm());
                (gap_mm, f64::INFINITY, lean)
            }
        };
        Some(Self {
            below_mm: (-lowest_mm.min(end_mm)).max(0.0),
            gap_mm,
            has_tip: tip.is_some(),
            radius_mm: lean.radius_mm,
            lean_deg: lean.lean_rad.to_degrees(),
        })
    }
}

/// Returns the corners of the convex hull; all vertices if there is no hull.
fn hull_corners(mesh: &TriMesh) -> Vec<Point> {
    let hull = Csg::convex_hull(mesh.vertices()).and_then(|hull| hull.to_mesh());
    match hull {
        Ok(hull) if !hull.vertices().is_empty() => hull.vertices().to_vec(),
        _ => mesh.vertices().to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::test_meshes::block;

    /// Returns a plate of 40 × 40 × 10 mm that begins 8 mm over its contact.
    fn plate() -> TriMesh {
        block(Point::new(-20.0, -20.0, 8.0), [40.0, 40.0, 10.0])
    }

    fn tip(end_z: f64) -> Hardware {
        Hardware {
            id: "H1".into(),
            kind: HardwareKind::Tip,
            from_mm: [0.0, 0.0, 12.0],
            to_mm: [0.0, 0.0, end_z],
            diameter_mm: 2.0,
            hole_mm: 0.0,
            round_end: true,
            density_g_cm3: 7.85,
            mass_g: 0.0,
            depth_mm: 4.0,
            socket_mm: 2.2,
        }
    }

    fn facts(hardware: &[Hardware]) -> SpinFacts {
        let aim = Aim::new(GoalKind::Top, [0.0; 3], [0.0, 0.0, 1.0]);
        SpinFacts::of_top(&aim, hardware, &plate()).unwrap()
    }

    #[test]
    fn a_plate_on_a_tip_leans_until_its_corner_touches() {
        let found = facts(&[tip(0.0)]);
        // The corner is 28.28 mm out and 7 mm over the middle of the tip's ball of 1 mm.
        let (out, up) = (800f64.sqrt(), 7.0_f64);
        let lean = (1.0 / out.hypot(up)).asin() + up.atan2(out);
        assert!((found.lean_deg - lean.to_degrees()).abs() < 1e-9);
        assert_eq!((found.below_mm, found.gap_mm), (0.0, 0.0));
    }

    #[test]
    fn a_tip_that_ends_too_low_or_too_high_is_off_the_contact() {
        let deep = facts(&[tip(-0.5)]);
        assert_eq!((deep.below_mm, deep.gap_mm), (0.5, 0.5));
        assert_eq!(facts(&[tip(0.25)]).gap_mm, 0.25);
    }

    #[test]
    fn without_a_tip_a_contact_in_the_air_is_as_far_off_as_the_surface() {
        let bare = facts(&[]);
        assert!((bare.gap_mm - 8.0).abs() < 1e-12 && !bare.has_tip);
        assert_eq!(bare.lean_deg, 0.0);
    }
}
