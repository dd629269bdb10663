//! The match: a dummy that has the mass, the centre of mass and the inertia of another body.

use super::error::GoalError;
use super::placement::Placement;
use super::request::RequestError;
use super::site::Site;
use super::target::{Target, Wanted};
use crate::base::units::MM3_PER_CM3;

/// Places a match: its frame has the wanted centre of mass as its origin, and the model's z axis.
pub(super) fn place(
    site: &Site,
    density_g_cm3: f64,
    target: Option<Target>,
) -> Result<Placement, GoalError> {
    let body = target.ok_or(GoalError::NoTarget)?.body();
    let aabb = site.solid.mesh().aabb();
    if aabb.distance_squared(&body.center) > 0.0 {
        return Err(GoalError::CenterOutside {
            center_mm: body.center.into(),
            low_mm: aabb.min.into(),
            high_mm: aabb.max.into(),
        });
    }
    let density_g_mm3 = density_g_cm3 / MM3_PER_CM3;
    let moments = body.moments(density_g_mm3).map_err(RequestError::from)?;
    let mut goal = site.goal_at(&site.upright.to_local(&body.center), Vec::new());
    goal.wanted = Some(Wanted {
        moments: moments.in_frame(&goal.frame),
        density_g_mm3,
    });
    Ok(Placement {
        goal,
        keeps: Vec::new(),
        warnings: Vec::new(),
        footing: None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::{GoalKind, PrintStock, Request, place_in_material, testing::block};
    use super::*;
    use crate::mass::{Body, moments_of_mesh};

    fn request(target: Target) -> Request {
        Request {
            target: Some(target),
            ..Request::new(GoalKind::Match)
        }
    }

    const STOCK: PrintStock = PrintStock {
        wall_mm: 1.0,
        density_g_cm3: 2.0,
    };

    #[test]
    fn a_match_with_the_solid_itself_wants_the_moments_of_the_solid() {
        let solid = block([1., -2., 3.], [5., 4., 9.]);
        let body = Body::new(&moments_of_mesh(solid.mesh()), 0.002);
        let placed = place_in_material(&solid, &STOCK, &request(Target::of(&body))).unwrap();
        let goal = placed.goal;
        assert!((goal.frame.origin - body.center).norm() < 1e-12);
        let wanted = goal.wanted.unwrap().moments;
        for (wanted, solid) in wanted.0.iter().zip(goal.solid.0) {
            assert!((wanted - solid).abs() < 1e-9, "{wanted} {solid}");
        }
    }

    #[test]
    fn a_body_that_cannot_be_is_refused_by_the_triangle_inequality() {
        let target = Target {
            mass_g: 1.0,
            center_mm: [1.0; 3],
            inertia_g_mm2: [1.0, 1.0, 3.0, 0.0, 0.0, 0.0],
        };
        let refused = request(target).validate().unwrap_err().to_string();
        assert!(refused.contains("triangle inequality"), "{refused}");
        assert!(refused.contains("3.000000"), "{refused}");
        let weightless = Target {
            mass_g: 0.0,
            ..target
        };
        assert!(request(weightless).validate().is_err());
    }

    #[test]
    fn a_centre_outside_of_the_model_and_a_match_with_nothing_are_refused() {
        let solid = block([0., 0., 0.], [2., 2., 6.]);
        let target = Target {
            mass_g: 1.0,
            center_mm: [1.0, 1.0, 6.5],
            inertia_g_mm2: [2.0, 2.0, 2.0, 0.0, 0.0, 0.0],
        };
        let refused = place_in_material(&solid, &STOCK, &request(target));
        assert!(matches!(refused, Err(GoalError::CenterOutside { .. })));
        let nothing = place_in_material(&solid, &STOCK, &Request::new(GoalKind::Match));
        assert_eq!(nothing, Err(GoalError::NoTarget));
    }
}
