//! The rotor: it turns about a given axis without shaking its bearings.

use super::error::GoalError;
use super::placement::Placement;
use super::rotor::{Rotor, Spindle};
use super::site::Site;
use super::sites::SpinPoint;
use crate::base::units::Length;
use crate::geom::Point;
use crate::shell::Keep;

pub(super) fn place(
    site: &Site,
    wall_mm: f64,
    point: SpinPoint,
    rotor: Rotor,
) -> Result<Placement, GoalError> {
    let origin = match point {
        SpinPoint::Center => site.upright_center(),
        SpinPoint::At(point) => site.locate_point("spin-point", point)?,
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
        footing: None,
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
        let request = Request {
            up: Up::X,
            spin_point: Some(SpinPoint::At([3., 1., 2.])),
            rotor: Some(rotor),
            ..Request::new(GoalKind::Balance)
        };
        let placed = place(&block([0., 0., 0.], [10., 4., 6.]), 1.5, &request).unwrap();
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
    fn a_speed_or_grade_that_is_not_positive_is_refused() {
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
            .validate();
            assert!(
                matches!(refused, Err(RequestError::Rotor { .. })),
                "{speed_rpm} {grade_mm_s}"
            );
        }
    }
}
