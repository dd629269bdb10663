//! The rotor: it turns about a given axis without shaking its bearings.

use serde::{Deserialize, Serialize};

use super::place::{GoalError, Site};
use super::{Placement, SpinPoint};
use crate::base::units::Length;
use crate::geom::Point;
use crate::shell::Keep;

/// Turns a minute where nothing is said.
const DEFAULT_SPEED_RPM: f64 = 3000.0;
/// The balance quality grade where nothing is said, mm/s: G 2.5, that of machine-tool drives and
/// small electric motors (ISO 21940-11, table 1).
const DEFAULT_GRADE_MM_S: f64 = 2.5;

/// How a rotor runs, and how well it must be balanced for it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rotor {
    /// The service speed, turns a minute.
    pub speed_rpm: f64,
    /// The ISO 21940-11 balance quality grade G that must be reached at that speed, mm/s.
    pub grade_mm_s: f64,
    /// The diameter of the bore on the axis, about which a wall stays solid; none where the model
    /// has its own bore, or is to have none.
    pub bore: Option<Length>,
}

impl Default for Rotor {
    fn default() -> Self {
        Self {
            speed_rpm: DEFAULT_SPEED_RPM,
            grade_mm_s: DEFAULT_GRADE_MM_S,
            bore: None,
        }
    }
}

impl Rotor {
    /// Whether speed and grade are positive and finite.
    pub(super) fn is_sound(&self) -> bool {
        [self.speed_rpm, self.grade_mm_s]
            .into_iter()
            .all(|number| number.is_finite() && number > 0.0)
    }

    /// The angular speed, rad/s.
    pub fn omega_rad_s(&self) -> f64 {
        self.speed_rpm * std::f64::consts::TAU / 60.0
    }

    /// The permissible residual specific unbalance e = G/ω, mm (ISO 21940-11).
    pub fn permissible_mm(&self) -> f64 {
        self.grade_mm_s / self.omega_rad_s()
    }
}

/// A rotor in its place on the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spindle {
    /// How it runs.
    pub rotor: Rotor,
    /// Where the model begins and ends along the axis, goal frame, mm: the two tolerance planes.
    pub ends_mm: [f64; 2],
}

pub(super) fn place(
    site: &Site,
    wall_mm: f64,
    point: SpinPoint,
    rotor: Rotor,
) -> Result<Placement, GoalError> {
    let origin = match point {
        SpinPoint::Center => site.upright_center(),
        SpinPoint::At(point) => site.given_point("spin-point", point)?,
    };
    let mut goal = site.goal_at(&origin, Vec::new());
    let ends_mm = [site.lowest_mm, site.highest_mm].map(|end| end - origin.z);
    goal.spindle = Some(Spindle { rotor, ends_mm });
    let on_axis = |z: f64| goal.frame.to_model(&Point::new(0.0, 0.0, z));
    let hub = |bore: Length| Keep {
        from: on_axis(ends_mm[0]),
        to: on_axis(ends_mm[1]),
        radius_mm: 0.5 * bore.mm() + wall_mm,
    };
    let keeps = rotor.bore.map(hub).into_iter().collect();
    Ok(Placement {
        goal,
        keeps,
        warnings: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::{GoalKind, Request, RequestError, Up, place, testing::*};
    use super::*;

    #[test]
    fn a_rotors_planes_are_its_ends_and_its_hub_holds_the_bore_and_a_wall() {
        let rotor = Rotor {
            bore: Some("4mm".parse().unwrap()),
            ..Rotor::default()
        };
        let wish = Request {
            up: Up::X,
            spin_point: Some(SpinPoint::At([3., 1., 2.])),
            rotor: Some(rotor),
            ..Request::new(GoalKind::Balance)
        };
        let placed = place(&block([0., 0., 0.], [10., 4., 6.]), 1.5, &wish).unwrap();
        assert_eq!(placed.goal.frame.origin, Point::new(3., 1., 2.));
        assert_eq!(placed.goal.spindle.unwrap().ends_mm, [-3.0, 7.0]);
        let [hub] = placed.keeps[..] else {
            panic!("{:?}", placed.keeps)
        };
        assert_eq!(
            (hub.from, hub.to, hub.radius_mm),
            (Point::new(0., 1., 2.), Point::new(10., 1., 2.), 3.5)
        );
    }

    #[test]
    fn the_permissible_offset_is_that_of_the_standards_chart() {
        // ISO 21940-11, figure 2: G 2.5 at 3000 rpm is 8 µm (g·mm/kg); exactly 2.5/(100 π) mm.
        let permissible_mm = Rotor::default().permissible_mm();
        assert!((permissible_mm - 2.5 / (100.0 * std::f64::consts::PI)).abs() < 1e-15);
        assert!((permissible_mm - 0.008).abs() < 1e-4);
    }

    #[test]
    fn a_speed_that_is_none_is_refused() {
        for (speed_rpm, grade_mm_s) in [
            (0.0, 2.5),
            (-1.0, 2.5),
            (f64::NAN, 2.5),
            (3000.0, f64::INFINITY),
        ] {
            let rotor = Some(Rotor {
                speed_rpm,
                grade_mm_s,
                bore: None,
            });
            let refused = Request {
                rotor,
                ..Request::new(GoalKind::Balance)
            }
            .checked();
            assert!(
                matches!(refused, Err(RequestError::Rotor { .. })),
                "{speed_rpm} {grade_mm_s}"
            );
        }
    }
}
