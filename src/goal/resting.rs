//! The rest of a top: it may stand still on a foot that is flat, or rounder than it looks.
//!
//! A body that rolls on a level floor rests stably where the height of its centre of mass has a
//! local minimum. The source is Várkonyi and Domokos, "Static equilibria of rigid bodies: dice,
//! pebbles, and the Poincaré–Hopf theorem", J. Nonlinear Sci. 16, 2006. Over a contact of radius of
//! curvature ρ, tilted by θ, that height is ρ + (h − ρ) cos θ: least upright if h < ρ. A top made
//! of triangles has no curvature, so it is tilted by a visible angle instead.

use crate::geom::Point;

/// The angle by which a top is tilted, rad. Below a quarter of a degree the facets of a mesh, or a
/// printer's layers, hold it. Above some degrees it tips over a foot on which it would stand.
const TILT_RAD: f64 = 1.0 * RAD_PER_DEG;
const RAD_PER_DEG: f64 = std::f64::consts::PI / 180.0;
/// The number of directions in which it is tilted. With fewer, the short way over the edge of a
/// square foot is missed.
const DIRECTIONS: usize = 36;
/// The greatest tilt that is tried, rad.
const MOST_RAD: f64 = 45.0 * RAD_PER_DEG;

/// The stability of a body that stands on its foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FootStability {
    /// The radius of curvature that moves the contact as far at a tilt of a degree, mm; the least
    /// over all directions.
    pub radius_mm: f64,
    /// The height of its centre of mass over the floor, mm.
    pub center_height_mm: f64,
    /// The tilt up to which it rights itself, in whole degrees.
    pub rights_to_deg: f64,
}

/// Returns the stability of a body that stands on its lowest points, z up. `None` if a tilt of a
/// degree makes it fall, as a top must.
///
/// `points` are its corners and `center` its centre of mass, mm, in a frame whose z axis goes
/// through the contact. Costs some hundred passes over the corners near the floor.
pub fn find_foot_stability(points: &[Point], center: &Point) -> Option<FootStability> {
    let floor_mm = points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let center_height_mm = center.z - floor_mm;
    // A point that touches after a tilt t is no higher than its distance from the axis times tan t.
    let slope = MOST_RAD.tan();
    let near: Vec<Point> = points
        .iter()
        .filter(|p| p.z - floor_mm <= 2.0 * slope * p.x.hypot(p.y))
        .copied()
        .collect();
    let foot: Vec<Point> = points
        .iter()
        .filter(|p| p.z <= floor_mm)
        .copied()
        .chain(near)
        .collect();
    let reach = |tilt_rad: f64| {
        let arms = (0..DIRECTIONS).map(|i| arm_mm(&foot, center, tilt_rad, i));
        arms.fold([f64::INFINITY; 2], |[righting, out], [r, o]| {
            [righting.min(r), out.min(o)]
        })
    };
    let [righting_mm, out_mm] = reach(TILT_RAD);
    let tilts = (2..)
        .map(|i| f64::from(i) * TILT_RAD)
        .take_while(|tilt| *tilt <= MOST_RAD);
    let rights = tilts
        .take_while(|tilt| reach(*tilt)[0] > 0.0)
        .last()
        .unwrap_or(TILT_RAD);
    (righting_mm > 0.0).then(|| FootStability {
        radius_mm: out_mm / TILT_RAD.sin(),
        center_height_mm,
        rights_to_deg: rights / RAD_PER_DEG,
    })
}

/// Returns two arms in the direction of a tilt, mm. The first is the level distance of the contact
/// beyond the centre of mass after the tilt; it rights the body if positive. The second is the
/// contact's distance from the axis before the tilt.
fn arm_mm(foot: &[Point], center: &Point, tilt_rad: f64, direction: usize) -> [f64; 2] {
    let (y, x) = (std::f64::consts::TAU * direction as f64 / DIRECTIONS as f64).sin_cos();
    let (sin, cos) = tilt_rad.sin_cos();
    let out = |p: &Point| x * p.x + y * p.y;
    let depth = |p: &Point| out(p) * sin - p.z * cos;
    let touching = foot.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)));
    touching.map_or([f64::NEG_INFINITY; 2], |p| {
        [
            (out(p) - out(center)) * cos + (p.z - center.z) * sin,
            out(p),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cylinder};

    fn rest_ball(radius_mm: f64, height_mm: f64) -> Option<FootStability> {
        let mesh = ball(&Point::new(0.0, 0.0, radius_mm), radius_mm, 6);
        find_foot_stability(mesh.vertices(), &Point::new(0.0, 0.0, height_mm))
    }

    #[test]
    fn a_ball_stands_only_if_its_centre_of_mass_is_lower_than_its_radius() {
        // Its facets are 0.7° wide, so that contacts jump by as much as half of a tilt of one
        // degree.
        let stands = rest_ball(10.0, 4.0).unwrap();
        assert!(
            stands.radius_mm > 5.0 && stands.radius_mm < 15.0,
            "{stands:?}"
        );
        assert!((stands.center_height_mm - 4.0).abs() < 1e-9);
        assert_eq!(rest_ball(10.0, 16.0), None);
    }

    #[test]
    fn a_disc_stands_until_its_centre_is_over_its_rim() {
        let disc = cylinder(8.0, 30.0, 72);
        let floor = disc.aabb().min.z;
        let stands =
            find_foot_stability(disc.vertices(), &Point::new(0.0, 0.0, floor + 20.0)).unwrap();
        // atan(8/20) = 21.8°, less what a polygon of 72 sides lies inside its circle, in whole
        // degrees.
        assert_eq!(stands.rights_to_deg.round(), 21.0);
        assert!(
            (stands.radius_mm / (8.0 / TILT_RAD.sin()) - 1.0).abs() < 0.01,
            "{stands:?}"
        );
    }

    #[test]
    fn a_disc_so_small_that_a_degree_tips_it_is_a_tip() {
        // tan 1° · 20 mm = 0.349 mm.
        let stands = |radius_mm| {
            let disc = cylinder(radius_mm, 30.0, 72);
            find_foot_stability(
                disc.vertices(),
                &Point::new(0.0, 0.0, disc.aabb().min.z + 20.0),
            )
            .is_some()
        };
        assert!(!stands(0.34) && stands(0.36));
    }
}
