//! The judge's own hydrostatics, which integrate the pressure of the water over the wet triangles.
//!
//! They share nothing with the code that placed the goal, which integrates volumes. Here
//! p = ρ g ζ acts on every wet triangle at depth ζ; buoyancy and its centre follow. The metacentric
//! height does not come from the waterplane: the body is heeled a little and its righting arm
//! measured.

use serde::{Deserialize, Serialize};

use crate::geom::{Frame, Point, Vector};
use crate::mesh::TriMesh;

/// The liquid a body must float in, and its waterline.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WaterOrder {
    /// The density of the liquid, g/cm³.
    pub liquid_g_cm3: f64,
    /// The waterline above the lowest point, mm.
    pub waterline_mm: f64,
}

/// The floating position and stability of a body with a given mass and centre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Afloat {
    /// The waterline above the lowest point at which the upright body displaces its mass, mm.
    pub waterline_mm: f64,
    /// Horizontal distance of its centre of mass from the centre of buoyancy there, mm.
    pub offset_mm: f64,
    /// The height of the lower metacentre over the centre of mass, mm. The body stays upright if it
    /// is positive.
    pub metacentric_height_mm: f64,
    /// The greatest of the heels tried from which it rights itself in every direction, degrees; 0
    /// if there is none.
    pub rights_from_deg: f64,
}

/// The heels tried, degrees.
const HEELS_DEG: [f64; 6] = [1.0, 2.0, 5.0, 10.0, 20.0, 45.0];
/// Number of directions of heel that are tried around the axis.
const DIRECTIONS: usize = 12;
/// The heel whose righting arm gives the metacentric height, degrees. Above 0.1° the waterplane of
/// a rough model changes with it; below 0.001° rounding shows.
const PROBE_DEG: f64 = 0.02;
/// Rounds of the search for the level; Newton's method takes about five.
const LEVEL_ROUNDS: usize = 60;
/// Relative accuracy of the displaced volume. Below 1e-13 rounding decides; above 1e-9 the
/// metacentric height suffers.
const VOLUME_TOLERANCE_RATIO: f64 = 1e-11;

/// The outside of a body in the goal frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Hull {
    triangles: Vec<[Point; 3]>,
    lowest_mm: f64,
}

/// The outside of a body at a given waterline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Level {
    /// The displaced volume, mm³.
    pub volume_mm3: f64,
    /// The centre of buoyancy across the vertical, mm.
    pub center_mm: [f64; 2],
    /// The height of the lower metacentre over the origin, mm.
    pub metacenter_mm: f64,
}

/// The buoyancy of a body: the displaced volume and its first moments.
#[derive(Debug, Clone, Copy, Default)]
struct Buoyancy {
    volume: f64,
    /// The area of the section at the water level: the growth of the volume with the level.
    section: f64,
    /// ∫x over the displaced volume, across the vertical.
    first_across: Vector,
}

impl Hull {
    /// Returns the outer surface in a goal frame.
    pub fn new(outer: &TriMesh, frame: &Frame) -> Self {
        let triangles: Vec<[Point; 3]> = outer
            .iter_corners()
            .map(|corners| corners.map(|corner| frame.to_local(&corner)))
            .collect();
        let heights = triangles.iter().flatten().map(|corner| corner.z);
        Self {
            lowest_mm: heights.fold(f64::INFINITY, f64::min),
            triangles,
        }
    }

    /// Floats a body with this outside, displaced volume and centre of mass (goal frame). `None` if
    /// it sinks or has no mass.
    pub fn float(&self, volume_mm3: f64, center: &Point) -> Option<Afloat> {
        let (level, buoyancy) = self.find_level(volume_mm3, &Vector::z(), center.z)?;
        let upright = Upright {
            volume_mm3,
            center: *center,
            level,
        };
        let aside = center.coords.xy() - buoyancy.first_across.xy() / buoyancy.volume;
        Some(Afloat {
            waterline_mm: level - self.lowest_mm,
            offset_mm: aside.norm(),
            metacentric_height_mm: self.metacentric_height(&upright)?,
            rights_from_deg: self.rights_from_deg(&upright),
        })
    }

    /// Returns the body upright at this waterline above its lowest point, mm; `None` if it
    /// displaces nothing there.
    pub(super) fn at_waterline(&self, waterline_mm: f64) -> Option<Level> {
        let level = self.lowest_mm + waterline_mm;
        let buoyancy = self.buoyancy(&Vector::z(), level);
        let volume_mm3 = buoyancy.volume;
        let center = buoyancy.first_across / volume_mm3;
        let upright = Upright {
            volume_mm3,
            center: Point::new(center.x, center.y, 0.0),
            level,
        };
        Some(Level {
            volume_mm3,
            center_mm: [center.x, center.y],
            metacenter_mm: self.metacentric_height(&upright)?,
        })
    }

    /// Returns the metacentric height, mm: the least growth of the righting arm with the heel over
    /// all directions. It is the lesser eigenvalue of the 2 × 2 form that three directions
    /// determine.
    fn metacentric_height(&self, body: &Upright) -> Option<f64> {
        let heel = PROBE_DEG.to_radians();
        let growth = |direction_rad: f64| {
            let [there, back] =
                [heel, -heel].map(|heel| self.righting_arm(body, direction_rad, heel));
            Some((there? - back?) / (2.0 * heel.sin()))
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        let (along_x, along_y, between) = (growth(0.0)?, growth(quarter)?, growth(0.5 * quarter)?);
        let (mean, cross) = (
            0.5 * (along_x + along_y),
            between - 0.5 * (along_x + along_y),
        );
        Some(mean - (0.5 * (along_x - along_y)).hypot(cross))
    }

    /// Returns the greatest heel tried up to which the body rights itself in every direction,
    /// degrees.
    fn rights_from_deg(&self, body: &Upright) -> f64 {
        let direction = |i: usize| std::f64::consts::TAU * i as f64 / DIRECTIONS as f64;
        let is_righted = |heel_deg: &&f64| {
            let arm = |i| self.righting_arm(body, direction(i), heel_deg.to_radians());
            (0..DIRECTIONS).all(|i| arm(i).is_some_and(|arm| arm > 0.0))
        };
        HEELS_DEG
            .iter()
            .take_while(is_righted)
            .last()
            .copied()
            .unwrap_or(0.0)
    }

    /// Returns the righting arm of the body, mm, with its side at `direction_rad` about the axis
    /// lifted by `heel_rad`. The body displaces the same volume as upright. `None` if it sinks.
    fn righting_arm(&self, body: &Upright, direction_rad: f64, heel_rad: f64) -> Option<f64> {
        let lifted = Vector::new(direction_rad.cos(), direction_rad.sin(), 0.0);
        let up = Vector::z() * heel_rad.cos() + lifted * heel_rad.sin();
        let across = lifted * heel_rad.cos() - Vector::z() * heel_rad.sin();
        let near = up.dot(&Vector::new(body.center.x, body.center.y, body.level));
        let (_, buoyancy) = self.find_level(body.volume_mm3, &up, near)?;
        Some(across.dot(&body.center.coords) - across.dot(&buoyancy.first_across) / buoyancy.volume)
    }

    /// Finds the level along `up` at which the body displaces this volume, with the buoyancy there.
    /// `None` if the body has less volume. Newton's method from `near`, kept between the levels
    /// known to be too low and too high.
    fn find_level(&self, volume_mm3: f64, up: &Vector, near: f64) -> Option<(f64, Buoyancy)> {
        let heights = self
            .triangles
            .iter()
            .flatten()
            .map(|corner| up.dot(&corner.coords));
        let [mut low, mut high] = heights
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
                [low.min(height), high.max(height)]
            });
        if !(volume_mm3 > 0.0 && self.buoyancy(up, high).volume > volume_mm3) {
            return None;
        }
        let mut level = near;
        for _ in 0..LEVEL_ROUNDS {
            if !(low < level && level < high) {
                level = 0.5 * (low + high);
            }
            let buoyancy = self.buoyancy(up, level);
            let excess = buoyancy.volume - volume_mm3;
            if excess.abs() <= VOLUME_TOLERANCE_RATIO * volume_mm3 {
                return Some((level, buoyancy));
            }
            if excess < 0.0 {
                low = level;
            } else {
                high = level;
            }
            level -= excess / buoyancy.section;
        }
        Some((level, self.buoyancy(up, level)))
    }

    /// Sums the pressure of the water over the triangles below a level across `up`.
    ///
    /// With the height ζ over the level, the divergence theorem turns ∬ ζ n·u dA into the displaced
    /// volume. It turns ∬ x ζ n·u dA into its first moments across u. The plane of the level, at
    /// ζ = 0, adds nothing. The section is the area that the wet triangles leave open.
    fn buoyancy(&self, up: &Vector, level: f64) -> Buoyancy {
        let mut buoyancy = Buoyancy::default();
        for corners in &self.triangles {
            let height = corners.map(|corner| up.dot(&corner.coords) - level);
            let (wet, count) = wet_part(corners, &height);
            for i in 2..count.max(2) {
                buoyancy.add_triangle([wet[0], wet[i - 1], wet[i]], up);
            }
        }
        buoyancy
    }
}

/// A body held upright in the water: its displaced volume, its centre, and the level.
#[derive(Debug, Clone, Copy)]
struct Upright {
    volume_mm3: f64,
    center: Point,
    level: f64,
}

/// A corner and its height over the level, mm.
type Sounding = (Point, f64);

/// Returns the corners of the part of a triangle under water, and their number.
fn wet_part(corners: &[Point; 3], height: &[f64; 3]) -> ([Sounding; 4], usize) {
    let mut wet = [(Point::origin(), 0.0); 4];
    let mut count = 0;
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        if height[i] < 0.0 {
            wet[count] = (corners[i], height[i]);
            count += 1;
        }
        if (height[i] < 0.0) != (height[j] < 0.0) {
            let share = height[i] / (height[i] - height[j]);
            wet[count] = (corners[i] + (corners[j] - corners[i]) * share, 0.0);
            count += 1;
        }
    }
    (wet, count)
}

impl Buoyancy {
    /// Adds the pressure on one wet triangle. The midpoints of its edges integrate the product of
    /// two linear functions exactly.
    fn add_triangle(&mut self, corners: [Sounding; 3], up: &Vector) {
        let [(a, p), (b, q), (c, r)] = corners;
        let area_up = 0.5 * (b - a).cross(&(c - a)).dot(up);
        self.section -= area_up;
        for (from, to, depth) in [(a, b, p + q), (b, c, q + r), (c, a, r + p)] {
            let share = area_up / 3.0 * 0.5 * depth;
            let middle = nalgebra::center(&from, &to).coords;
            self.volume += share;
            self.first_across += (middle - up * up.dot(&middle)) * share;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::test_meshes::{ball, block};

    /// Returns a block 40 × 60 × 30 with its bottom at z = 5.
    fn pontoon() -> Hull {
        Hull::new(
            &block(Point::new(-20.0, -30.0, 5.0), [40.0, 60.0, 30.0]),
            &Frame::identity(),
        )
    }

    #[test]
    fn a_pontoon_has_the_draught_and_the_metacentric_height_of_the_textbook() {
        // T = V/(L B), KB = T/2, BM = B²/(12 T), with KG = 8.
        let found = pontoon()
            .float(40.0 * 60.0 * 12.0, &Point::new(0.0, 0.0, 13.0))
            .unwrap();
        assert!((found.waterline_mm - 12.0).abs() < 1e-10 && found.offset_mm < 1e-10);
        let gm = 6.0 + 1600.0 / (12.0 * 12.0) - 8.0;
        // A wall-sided body's arm is sin φ (GM + BM/2 tan² φ): 1e-7 BM at a fiftieth of a degree.
        assert!(
            (found.metacentric_height_mm - gm).abs() < 1e-5,
            "{} {gm}",
            found.metacentric_height_mm
        );
        assert!(found.rights_from_deg >= 20.0);
    }

    #[test]
    fn a_pontoon_heeled_five_degrees_has_the_arm_of_the_wall_sided_formula() {
        let heel = 5.0_f64.to_radians();
        let body = Upright {
            volume_mm3: 40.0 * 60.0 * 12.0,
            center: Point::new(0.0, 0.0, 13.0),
            level: 17.0,
        };
        let bm = 1600.0 / (12.0 * 12.0);
        let want = heel.sin() * (6.0 + bm - 8.0 + 0.5 * bm * heel.tan().powi(2));
        let arm = pontoon().righting_arm(&body, 0.0, heel).unwrap();
        assert!((arm - want).abs() < 1e-9, "{arm} {want}");
    }

    #[test]
    fn a_pontoon_turns_over_if_top_heavy_and_sinks_if_too_heavy() {
        let volume = 40.0 * 60.0 * 12.0;
        let tall = pontoon()
            .float(volume, &Point::new(0.0, 0.0, 25.0))
            .unwrap();
        assert!(tall.metacentric_height_mm < 0.0 && tall.rights_from_deg == 0.0);
        assert_eq!(
            pontoon().float(40.0 * 60.0 * 30.1, &Point::new(0.0, 0.0, 13.0)),
            None
        );
        assert_eq!(pontoon().float(0.0, &Point::origin()), None);
    }

    #[test]
    fn a_ball_has_its_metacentre_in_its_middle_whatever_it_weighs() {
        let hull = Hull::new(
            &ball(Point::new(1.0, 2.0, 3.0), 10.0, 60),
            &Frame::identity(),
        );
        for share in [0.2, 0.5, 0.9] {
            let volume = share * 4.0 / 3.0 * std::f64::consts::PI * 1000.0 * 0.997;
            let found = hull.float(volume, &Point::new(1.0, 2.0, 1.0)).unwrap();
            // Sixty rings: chords lie up to 1.4e-3 of the radius inside.
            assert!(
                (found.metacentric_height_mm - 2.0).abs() < 0.03,
                "{share}: {found:?}"
            );
            assert!(found.rights_from_deg == 45.0 && found.offset_mm < 1e-6);
        }
    }
}
