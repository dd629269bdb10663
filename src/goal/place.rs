//! Placing a goal: a request and a solid become a frame.

use super::error::GoalError;
use super::kind::GoalKind;
use super::placement::Placement;
use super::request::Request;
use super::site::{MeasuredSolid, Site};
use super::sites::SpinPoint;
use super::{balance, float, matching, stand, top, yoyo};
use crate::mesh::Solid;

/// The wall and the material of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintStock {
    /// The minimum wall, mm.
    pub wall_mm: f64,
    /// The density, g/cm³; only floating depends on it.
    pub density_g_cm3: f64,
}

/// The density that [`place`] assumes, g/cm³.
const PLAIN_DENSITY_G_CM3: f64 = 1.0;

/// Places the goal that `request` asks for in `solid`. The wall, `wall_mm`, decides how much stays
/// solid at a contact.
///
/// The moments of the goal are exact for the mesh. Costs a few passes over the triangles. The
/// density is taken as 1 g/cm³; [`place_in_material`] takes any.
pub fn place(solid: &Solid, wall_mm: f64, request: &Request) -> Result<Placement, GoalError> {
    place_in_material(
        solid,
        &PrintStock {
            wall_mm,
            density_g_cm3: PLAIN_DENSITY_G_CM3,
        },
        request,
    )
}

/// Places a goal in a solid of any material. If the waterline is free, it is set to half the
/// height: finding the best one takes the solver.
pub fn place_in_material(
    solid: &Solid,
    stock: &PrintStock,
    request: &Request,
) -> Result<Placement, GoalError> {
    place_measured(&MeasuredSolid::new(solid), stock, request)
}

/// Places a goal in a solid whose moments are known, which saves time when it is placed often.
pub fn place_measured(
    weighed: &MeasuredSolid,
    stock: &PrintStock,
    request: &Request,
) -> Result<Placement, GoalError> {
    let PrintStock {
        wall_mm,
        density_g_cm3,
    } = *stock;
    if !(wall_mm > 0.0 && wall_mm.is_finite()) {
        return Err(GoalError::NoWall(wall_mm));
    }
    if !(density_g_cm3 > 0.0 && density_g_cm3.is_finite()) {
        return Err(GoalError::NoDensity(density_g_cm3));
    }
    let request = request.validate()?;
    let site = Site::new(weighed, &request)?;
    match request.kind {
        GoalKind::Top => top::place(&site, wall_mm, top::Order::of(&request)),
        GoalKind::Yoyo => yoyo::place(&site, request.spin_point.unwrap_or(SpinPoint::Center)),
        GoalKind::Stand => stand::place(&site),
        GoalKind::Float => float::place(&site, density_g_cm3, request.water.unwrap_or_default()),
        GoalKind::Balance => {
            let point = request.spin_point.unwrap_or(SpinPoint::Center);
            balance::place(&site, wall_mm, point, request.rotor.unwrap_or_default())
        }
        GoalKind::Match => matching::place(&site, density_g_cm3, request.target),
    }
}

/// Returns true if a top keeps its promise on the lowest point of the model, without a tip but for
/// one that was ordered.
///
/// # Errors
/// The goal cannot be placed there.
pub fn spins_on_lowest(
    weighed: &MeasuredSolid,
    wall_mm: f64,
    request: &Request,
) -> Result<bool, GoalError> {
    let request = request.validate()?;
    let site = Site::new(weighed, &request)?;
    top::spins_on_lowest(&site, wall_mm, top::Order::of(&request))
}

/// Returns whether a top keeps its promise of contact and lean on the contact of its request, with
/// the tip that the request brings.
///
/// # Errors
/// The request cannot be placed.
pub fn keeps_its_lean(
    weighed: &MeasuredSolid,
    wall_mm: f64,
    request: &Request,
) -> Result<bool, GoalError> {
    let request = request.validate()?;
    let site = Site::new(weighed, &request)?;
    let order = top::Order::of(&request);
    Ok(order.is_kept_by(&top::place(&site, wall_mm, order)?))
}

#[cfg(test)]
mod tests {
    use super::super::{Contact, Objective, RequestError, TipChoice, Up, Warning, testing::*};
    use super::*;
    use crate::geom::{Point, Vector};

    fn request(kind: GoalKind) -> Request {
        Request::new(kind)
    }

    #[test]
    fn a_block_on_its_face_touches_at_the_faces_middle() {
        let lowest = Request {
            contact: Some(Contact::Lowest),
            ..request(GoalKind::Top).unpromised()
        };
        let placed = place(&block([-1., -2., 3.], [5., 4., 9.]), 1.0, &lowest).unwrap();
        assert!((placed.goal.frame.origin - Point::new(2., 1., 3.)).norm() < 1e-12);
        assert!(placed.warnings.is_empty());
        assert_eq!(placed.keeps.len(), 1);
        assert!((placed.keeps[0].radius_mm - 2.0).abs() < 1e-15);
    }

    #[test]
    fn below_the_center_of_two_legs_is_air_and_the_height_is_named() {
        // A table: a plate from z = 6 to 8 on two legs; its centre is over the gap.
        let table = arch();
        let request = Request {
            contact: Some(Contact::Center),
            tip: TipChoice::None,
            ..request(GoalKind::Top)
        };
        // Without a tip it spins on nothing, and is refused. A trial asks no more than a void.
        let refused = place(&table, 1.0, &request).unwrap_err().to_string();
        assert!(refused.contains("6.0 mm below the model"), "{refused}");
        let placed = place(&table, 1.0, &request.unpromised()).unwrap();
        assert_eq!(placed.goal.frame.origin.z, 0.0);
        let [Warning::ContactInAir { missing_mm }] = placed.warnings[..] else {
            panic!("{:?}", placed.warnings)
        };
        assert!((missing_mm - 6.0).abs() < 1e-12);
    }

    #[test]
    fn a_flat_slab_spins_easiest_about_its_normal() {
        let slab = block([0., 0., 0.], [10., 2., 8.]);
        let request = Request {
            up: Up::Principal,
            ..request(GoalKind::Yoyo)
        };
        let placed = place(&slab, 1.0, &request).unwrap();
        assert!((placed.goal.frame.axis() - Vector::y()).norm() < 1e-12);
        assert!((placed.goal.frame.origin - Point::new(5., 1., 4.)).norm() < 1e-12);
    }

    #[test]
    fn turned_upside_down_the_solid_keeps_its_mass_and_stands_on_its_other_end() {
        let solid = block([0., 0., 0.], [2., 3., 7.]);
        let request = Request {
            up: Up::NegZ,
            ..request(GoalKind::Stand)
        };
        let goal = place(&solid, 1.0, &request).unwrap().goal;
        assert!((goal.solid.volume() - 42.0).abs() < 1e-12);
        assert!((goal.frame.origin - Point::new(1., 1.5, 7.)).norm() < 1e-12);
        assert!((goal.solid.centroid().z - 3.5).abs() < 1e-12);
    }

    #[test]
    fn a_top_that_hangs_from_its_contact_is_refused() {
        let request = Request {
            contact: Some(Contact::At([1., 1., 5.])),
            ..request(GoalKind::Top)
        };
        let refused = place(&block([0., 0., 0.], [2., 2., 6.]), 1.0, &request);
        let Err(GoalError::ContactAboveCenter { depth_mm }) = refused else {
            panic!("{refused:?}")
        };
        assert!((depth_mm - 2.0).abs() < 1e-12);
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let solid = block([0., 0., 0.], [2., 2., 6.]);
        let zero = Request {
            up: Up::Along([0., 0., 0.]),
            ..request(GoalKind::Top)
        };
        assert!(matches!(
            place(&solid, 1.0, &zero),
            Err(GoalError::NoDirection(..))
        ));
        let nan = Request {
            spin_point: Some(SpinPoint::At([0., f64::NAN, 0.])),
            ..request(GoalKind::Yoyo)
        };
        assert!(matches!(
            place(&solid, 1.0, &nan),
            Err(GoalError::NotAPoint {
                name: "spin-point",
                ..
            })
        ));
        assert!(matches!(
            place(&solid, 0.0, &request(GoalKind::Top)),
            Err(GoalError::NoWall(_))
        ));
    }

    #[test]
    fn an_objective_of_another_goal_is_refused() {
        let request = Request {
            objective: Objective::CriticalSpeed,
            ..request(GoalKind::Stand)
        };
        let refused = place(&block([0., 0., 0.], [2., 2., 6.]), 1.0, &request);
        assert!(matches!(
            refused,
            Err(GoalError::Request(RequestError::Objective { .. }))
        ));
    }
}
