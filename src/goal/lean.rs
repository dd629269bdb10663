//! The lean of a spinning top: the angle at which more than its tip or its foot touches the floor.
//!
//! A top that slows down leans over and precesses. Up to some lean it must touch the floor in one
//! patch around its contact only. That patch is the round end of a tip, or a convex foot on which
//! it rolls. The leaning body touches the floor with points of its convex hull, so the hull's
//! corners tell everything.
//!
//! On a tip the answer is a closed form. Let the end be a ball of radius R about (0, 0, R). Leaned
//! by θ towards a corner at distance r and height z, that corner reaches the floor if
//!
//! ```text
//! r sin θ − (z − R) cos θ = R,   so θ = asin(R/d) + atan2(z − R, r),   d² = r² + (z − R)²
//! ```
//!
//! On a foot the contact walks over the hull as the top leans. It rolls as long as the contact goes
//! on in short steps, and no further than on a ball as large as the top. A long step is the way
//! from one foot to another, or over the rim of a flat one.

use std::f64::consts::{FRAC_PI_2, TAU};

use serde::{Deserialize, Serialize};

use crate::geom::Point;

/// The number of directions in which a foot is leaned. With 36 a foot beside the contact may be
/// met half a degree too late.
const DIRECTIONS: usize = 72;
/// The longest step of the contact that counts as rolling, as a part of the longest side. The
/// facets of scans and of coarse balls are 1 to 4 % long; two feet stand further apart.
const STEP_RATIO: f64 = 0.05;
/// The radius of the roundest foot on which a top rolls, in longest sides. A flatter one is a floor
/// of its own.
const FLATTEST_RATIO: f64 = 1.0;
/// The lean at which the radius of a foot is measured, rad: the facets of a mesh hardly show.
const ROLL_RAD: f64 = 10.0 * TAU / 360.0;

/// The lean of a top, and the roundness of its foot.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lean {
    /// The lean at which more than the tip or the foot touches the floor, rad; at most a quarter
    /// turn.
    pub lean_rad: f64,
    /// The radius of the tip's end, or of the ball that rolls like the foot up to 10° of lean, mm.
    /// Zero for a point, and if it leans not at all.
    pub radius_mm: f64,
}

impl Lean {
    /// Returns the lean on a tip with a round end of this radius.
    ///
    /// `corners` are those of the body's convex hull in the goal frame, mm. The tip ends in the
    /// origin. Exact to rounding; zero if a corner lies below the origin.
    pub fn on_tip(corners: impl IntoIterator<Item = Point>, radius_mm: f64) -> Self {
        let leans = corners.into_iter().map(|p| lean_to_corner(&p, radius_mm));
        let least_rad = leans.fold(FRAC_PI_2, f64::min);
        Self {
            lean_rad: least_rad.max(0.0),
            radius_mm,
        }
    }

    /// Returns the lean on the body's own foot, the least over 72 directions.
    ///
    /// `corners` are those of the body's convex hull in the goal frame, mm; `size_mm` is its
    /// longest side. The contact is the origin. Costs a sort of the corners for every direction.
    pub fn on_foot(corners: &[Point], size_mm: f64) -> Self {
        let foot = Foot { corners, size_mm };
        let walks: Vec<Walk> = (0..DIRECTIONS).map(|i| foot.walk(i)).collect();
        let leans = walks.iter().map(|walk| walk.lean_rad);
        let lean_rad = leans.fold(FRAC_PI_2, f64::min);
        let at_rad = lean_rad.min(ROLL_RAD);
        let radius_mm = if at_rad > 0.0 {
            let reaches = walks.iter().map(|walk| walk.reach_mm(at_rad));
            reaches.sum::<f64>() / walks.len() as f64 / at_rad.sin()
        } else {
            0.0
        };
        Self {
            lean_rad,
            radius_mm,
        }
    }
}

/// Returns the lean at which a corner reaches the floor beside a round end, rad.
fn lean_to_corner(corner: &Point, radius_mm: f64) -> f64 {
    let (out, up) = (corner.x.hypot(corner.y), corner.z - radius_mm);
    let reach = out.hypot(up);
    if reach > radius_mm {
        (radius_mm / reach).asin() + up.atan2(out)
    } else {
        FRAC_PI_2
    }
}

/// Returns the height above the tip's end, mm, at which the lowest point of a body must begin. The
/// body then leans by `lean_rad` on a tip with this radius; its corners are given over that point.
pub(super) fn least_height_mm(corners: &[Point], radius_mm: f64, lean_rad: f64) -> f64 {
    let (sin, cos) = lean_rad.sin_cos();
    let height = |p: &Point| (p.x.hypot(p.y) * sin - radius_mm) / cos + radius_mm - p.z;
    corners.iter().map(height).fold(0.0, f64::max)
}

/// A body that leans on its own foot.
struct Foot<'a> {
    corners: &'a [Point],
    size_mm: f64,
}

/// The walk of the contact as the top leans in one direction.
struct Walk {
    /// The lean at which the contact no longer rolls, rad.
    lean_rad: f64,
    /// The leans at which the contact steps on, ascending, and its level distance from the axis
    /// from there on, mm.
    steps: Vec<Step>,
}

#[derive(Clone, Copy)]
struct Step {
    lean_rad: f64,
    from_axis_mm: f64,
}

impl Walk {
    /// Returns the level distance of the contact from the axis at a lean, mm.
    fn reach_mm(&self, lean_rad: f64) -> f64 {
        let taken = self.steps.iter().take_while(|s| s.lean_rad <= lean_rad);
        taken.last().map_or(0.0, |step| step.from_axis_mm)
    }
}

impl Foot<'_> {
    fn walk(&self, direction: usize) -> Walk {
        let (sin, cos) = (TAU * direction as f64 / DIRECTIONS as f64).sin_cos();
        let lower = lower_hull(self.corners, |p| cos * p.x + sin * p.y);
        let mut at = Point::origin();
        let mut steps = Vec::new();
        let mut out_mm = 0.0;
        for (index, (out, corner)) in lower.into_iter().enumerate() {
            let slope_rad = (corner.z - at.z).atan2(out - out_mm);
            let lean_rad = if index == 0 { 0.0 } else { slope_rad };
            let from_axis_mm = corner.x.hypot(corner.y);
            let patch_mm =
                (STEP_RATIO + FLATTEST_RATIO * lean_rad.min(FRAC_PI_2).sin()) * self.size_mm;
            let is_step = (corner - at).norm() <= STEP_RATIO * self.size_mm;
            if !is_step || from_axis_mm > patch_mm || lean_rad >= FRAC_PI_2 {
                let lean_rad = lean_rad.clamp(0.0, FRAC_PI_2);
                return Walk { lean_rad, steps };
            }
            steps.push(Step {
                lean_rad,
                from_axis_mm,
            });
            (at, out_mm) = (corner, out);
        }
        Walk {
            lean_rad: FRAC_PI_2,
            steps,
        }
    }
}

/// Returns the corners that touch the floor one after the other, with their distances out. The body
/// leans from upright in the direction in which `out` grows.
fn lower_hull(corners: &[Point], out: impl Fn(&Point) -> f64) -> Vec<(f64, Point)> {
    let mut sorted: Vec<(f64, Point)> = corners.iter().map(|p| (out(p), *p)).collect();
    sorted.sort_by(|(a, p), (b, q)| a.total_cmp(b).then(p.z.total_cmp(&q.z)));
    let mut hull: Vec<(f64, Point)> = Vec::new();
    for (x, p) in sorted {
        while let [.., (x0, p0), (x1, p1)] = hull[..]
            && (x1 - x0) * (p.z - p0.z) <= (p1.z - p0.z) * (x - x0)
        {
            hull.pop();
        }
        hull.push((x, p));
    }
    let lowest_mm = hull.iter().map(|(_, p)| p.z).fold(f64::INFINITY, f64::min);
    let first = hull.iter().rposition(|(_, p)| p.z <= lowest_mm);
    hull.split_off(first.unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cylinder};

    /// Returns the points of circles about the z axis, each of a radius at a height, mm.
    fn rings(circles: &[[f64; 2]]) -> Vec<Point> {
        let ring = |&[radius, z]: &[f64; 2]| {
            (0..144).map(move |i| {
                let (sin, cos) = (TAU * f64::from(i) / 144.0).sin_cos();
                Point::new(radius * cos, radius * sin, z)
            })
        };
        circles.iter().flat_map(ring).collect()
    }

    fn leans_on_foot_deg(points: &[Point], size_mm: f64) -> f64 {
        Lean::on_foot(points, size_mm).lean_rad.to_degrees()
    }

    #[test]
    fn a_ball_rolls_on_itself_as_far_as_it_is_leaned_and_shows_its_radius() {
        let mesh = ball(&Point::new(0.0, 0.0, 20.0), 20.0, 5);
        let lean = Lean::on_foot(mesh.vertices(), 40.0);
        assert!(lean.lean_rad.to_degrees() > 80.0, "{lean:?}");
        // Its facets are 0.7 mm wide, and the contact is up to half of that from a ball's. That
        // makes 2 mm of radius in one direction, and less in the mean over 72.
        assert!((lean.radius_mm - 20.0).abs() < 1.0, "{lean:?}");
    }

    #[test]
    fn a_cone_on_its_point_leans_until_its_side_lies_down() {
        for half_angle in [20.0_f64, 45.0, 70.0] {
            let base_mm = 50.0 * half_angle.to_radians().tan();
            let mut cone = rings(&[[base_mm, 50.0]]);
            cone.push(Point::origin());
            let lean = Lean::on_foot(&cone, 100.0);
            // The base has a corner in each of the 72 directions, so the angle is exact.
            assert!((lean.lean_rad.to_degrees() - (90.0 - half_angle)).abs() < 1e-9);
            assert_eq!(lean.radius_mm, 0.0);
        }
    }

    #[test]
    fn a_flat_footed_cylinder_leans_not_at_all() {
        let disc = cylinder(8.0, 30.0, 72);
        let floor = disc.aabb().min.z;
        let points: Vec<Point> = disc
            .vertices()
            .iter()
            .map(|p| Point::new(p.x, p.y, p.z - floor))
            .collect();
        assert_eq!(leans_on_foot_deg(&points, 30.0), 0.0);
        // Shaved to a foot of 1 mm, less than 5 % of 30 mm, it is a blunt point. The rim, 8 mm out
        // and 3 mm up, ends the lean at atan(3/7).
        let shaved = rings(&[[1.0, 0.0], [8.0, 3.0], [8.0, 30.0]]);
        let expected = (3.0_f64 / 7.0).atan().to_degrees();
        assert!((leans_on_foot_deg(&shaved, 30.0) - expected).abs() < 1e-9);
    }

    #[test]
    fn two_feet_are_not_one_foot_though_both_are_round() {
        let foot = |x: f64| ball(&Point::new(x, 0.0, 5.0), 5.0, 4);
        let mut feet = foot(0.0).vertices().to_vec();
        assert!(leans_on_foot_deg(&feet, 60.0) > 80.0);
        feet.extend(foot(30.0).vertices());
        assert!(leans_on_foot_deg(&feet, 60.0) < 0.5);
        // The other foot is lifted by 30 tan 7°: the two are met by one plane at 7°.
        let lift = 30.0 * 7f64.to_radians().tan();
        let lifted = foot(30.0)
            .vertices()
            .iter()
            .map(|p| p + lift * crate::geom::Vector::z())
            .collect::<Vec<_>>();
        let mut feet = foot(0.0).vertices().to_vec();
        feet.extend(lifted);
        assert!((leans_on_foot_deg(&feet, 60.0) - 7.0).abs() < 0.2);
    }

    #[test]
    fn a_body_on_a_tip_leans_by_the_angle_of_its_common_tangent() {
        // A disc of radius 30 has its rim 12 mm up, on a tip of radius 2. The tangent from the rim
        // to the circle about (0, 2) has θ = atan(10/30) + asin(2/√1000) = 22.06°.
        let lean = Lean::on_tip(rings(&[[30.0, 12.0], [30.0, 40.0]]), 2.0);
        let expected = (10.0_f64 / 30.0).atan() + (2.0 / 1000f64.sqrt()).asin();
        assert!((lean.lean_rad - expected).abs() < 1e-12);
        assert!((lean.lean_rad.to_degrees() - 22.06).abs() < 0.01);
    }

    #[test]
    fn the_least_height_is_the_one_at_which_the_lean_is_reached() {
        let body = rings(&[[30.0, 0.0], [42.0, 1.5], [20.0, -6.0]]);
        for (radius_mm, lean_deg) in [(1.0, 10.0_f64), (3.0, 25.0), (2.0, 0.0)] {
            let lean_rad = lean_deg.to_radians();
            let height_mm = least_height_mm(&body, radius_mm, lean_rad);
            let raised = body
                .iter()
                .map(|p| p + height_mm * crate::geom::Vector::z());
            let lean = Lean::on_tip(raised, radius_mm);
            assert!((lean.lean_rad - lean_rad).abs() < 1e-9, "{lean:?}");
        }
    }

    #[test]
    fn a_body_that_reaches_below_its_contact_does_not_lean() {
        let deep = rings(&[[10.0, -0.5]]);
        assert_eq!(Lean::on_tip(deep.clone(), 2.0).lean_rad, 0.0);
        assert_eq!(leans_on_foot_deg(&deep, 40.0), 0.0);
    }
}
