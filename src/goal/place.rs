//! Placing a goal: the request's words and the solid's geometry become a frame.

use super::{
    Contact, Goal, GoalKind, Objective, Placement, Request, RequestError, SpinPoint, Up, balance,
    float, stand, top, yoyo,
};
use crate::geom::{Frame, Point, Vector};
use crate::mass::{Body, Moments, moments_of_mesh};
use crate::mesh::Solid;

/// Heights closer than this part of the model's extent count as equal. Below 1e-12 rounding decides
/// between the two senses of a symmetric model's axis; above 1e-6 a real difference would be
/// ignored.
const TIE_RATIO: f64 = 1e-9;

/// How many of the model's lengths a point may lie off it. No tip reaches farther than one; beyond
/// some thousands rounding would decide.
const FAR_LENGTHS: f64 = 10.0;

/// Why a goal cannot be placed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GoalError {
    /// A direction without direction.
    #[error("up = {0} is not a direction; give three finite numbers that are not all zero")]
    NoDirection(Up),
    /// A direction that is still to be chosen.
    #[error("up = auto is no direction yet; have one chosen first (advice::best_orientation)")]
    NotChosen,
    /// A point with a coordinate that is not a number.
    #[error("{name} = ({x}, {y}, {z}) is not a point; give three finite numbers in mm")]
    NotAPoint {
        /// Which option.
        name: &'static str,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
        /// Its z.
        z: f64,
    },
    /// A point far away from the model.
    #[error(
        "{name} lies more than {FAR_LENGTHS} times the model's length away from it; give a point of the model, in mm of its \
         final size"
    )]
    FarAway {
        /// Which option.
        name: &'static str,
    },
    /// The wall is zero, negative or not a number.
    #[error("a wall of {0} mm is not a wall; give a positive thickness")]
    NoWall(f64),
    /// The parts of the request do not go together.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// A top that hangs from its contact.
    #[error(
        "the centre of mass lies {depth_mm:.3} mm below the contact point: that is a pendulum, not a top; choose a contact below the centre, or turn the model over"
    )]
    ContactAboveCenter {
        /// How far the centre lies below, mm.
        depth_mm: f64,
    },
    /// A tip where there is nothing to hold it.
    #[error(
        "the spin axis passes through no part of the model above the contact point, so that no tip can be put in; give another contact"
    )]
    NoSeat,
    /// A support without area.
    #[error(
        "the {vertices} lowest vertices of the model support it on a point or a line only; turn it, or give it a flat foot"
    )]
    NoSupport {
        /// How many vertices lie at the support plane.
        vertices: usize,
    },
    /// A waterline above the model.
    #[error(
        "a waterline of {waterline_mm:.3} mm leaves nothing of {height_mm:.3} mm above the water; give a lower one"
    )]
    UnderWater {
        /// The waterline asked for, mm above the lowest point.
        waterline_mm: f64,
        /// The height of the model, mm.
        height_mm: f64,
    },
    /// The density is zero, negative or not a number.
    #[error("a density of {0} g/cm³ is none; give a positive one")]
    NoDensity(f64),
}

/// What a model is made of, as far as the goal needs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stock {
    /// The least wall, mm.
    pub wall_mm: f64,
    /// The density, g/cm³; only what floats depends on it.
    pub density_g_cm3: f64,
}

/// The density that [`place`] assumes, g/cm³.
const PLAIN_DENSITY_G_CM3: f64 = 1.0;

/// The goal that `request` asks for, placed in `solid`; walls of `wall_mm` decide how much stays
/// solid at a contact.
///
/// The moments of the goal are exact for the mesh. Costs a few passes over the triangles. What
/// floats is of 1 g/cm³; [`place_made_of`] takes any density.
pub fn place(solid: &Solid, wall_mm: f64, request: &Request) -> Result<Placement, GoalError> {
    place_made_of(
        solid,
        &Stock {
            wall_mm,
            density_g_cm3: PLAIN_DENSITY_G_CM3,
        },
        request,
    )
}

/// The same for a solid of any material. Where the waterline is free, half the height stands for
/// it: to find the best one takes the solver.
pub fn place_made_of(
    solid: &Solid,
    stock: &Stock,
    request: &Request,
) -> Result<Placement, GoalError> {
    place_weighed(
        &Weighed {
            solid,
            moments: moments_of_mesh(solid.mesh()),
        },
        stock,
        request,
    )
}

/// A solid whose moments are known already.
#[derive(Debug, Clone, Copy)]
pub struct Weighed<'a> {
    /// The solid.
    pub solid: &'a Solid,
    /// Its moments, model frame, mm: those of [`moments_of_mesh`].
    pub moments: Moments,
}

/// The same for a solid that is placed many times.
pub fn place_weighed(
    weighed: &Weighed,
    stock: &Stock,
    request: &Request,
) -> Result<Placement, GoalError> {
    let Stock {
        wall_mm,
        density_g_cm3,
    } = *stock;
    if !(wall_mm > 0.0 && wall_mm.is_finite()) {
        return Err(GoalError::NoWall(wall_mm));
    }
    if !(density_g_cm3 > 0.0 && density_g_cm3.is_finite()) {
        return Err(GoalError::NoDensity(density_g_cm3));
    }
    let request = request.checked()?;
    let site = Site::new(weighed, &request)?;
    match request.kind {
        GoalKind::Top => {
            let contact = request.contact.unwrap_or(Contact::Lowest);
            top::place(
                &site,
                wall_mm,
                contact,
                request.hardware.and_then(|hardware| hardware.tip),
            )
        }
        GoalKind::Yoyo => yoyo::place(&site, request.spin_point.unwrap_or(SpinPoint::Center)),
        GoalKind::Stand => stand::place(&site),
        GoalKind::Float => float::place(&site, density_g_cm3, request.water.unwrap_or_default()),
        GoalKind::Balance => {
            let point = request.spin_point.unwrap_or(SpinPoint::Center);
            balance::place(&site, wall_mm, point, request.rotor.unwrap_or_default())
        }
    }
}

/// What every kind of goal needs to know of the model.
pub(super) struct Site<'a> {
    pub solid: &'a Solid,
    pub kind: GoalKind,
    pub objective: Objective,
    /// The solid's moments, model frame.
    pub moments: Moments,
    /// Mass properties for unit density, model frame.
    pub body: Body,
    /// The model turned so that z is up, its origin at the model's own.
    pub upright: Frame,
    /// The lowest and highest z of the turned model, mm.
    pub lowest_mm: f64,
    pub highest_mm: f64,
}

impl<'a> Site<'a> {
    fn new(
        &Weighed { solid, moments }: &Weighed<'a>,
        request: &Request,
    ) -> Result<Self, GoalError> {
        let body = Body::new(&moments, 1.0);
        let up = up_direction(request.up, solid, &body)?;
        let (lowest_mm, highest_mm) = extent_along(solid, &up);
        let upright = Frame::with_axis(Point::origin(), &up);
        Ok(Self {
            solid,
            kind: request.kind,
            objective: request.objective,
            moments,
            body,
            upright,
            lowest_mm,
            highest_mm,
        })
    }

    /// The goal whose frame has this origin, given in the upright frame.
    pub fn goal_at(&self, upright_origin: &Point, support: Vec<[f64; 2]>) -> Goal {
        let frame = Frame {
            origin: self.upright.to_model(upright_origin),
            axes: self.upright.axes,
        };
        let solid = self.moments.in_frame(&frame);
        Goal {
            kind: self.kind,
            frame,
            objective: self.objective,
            support,
            spindle: None,
            afloat: None,
            solid,
        }
    }

    /// The model's vertices in the upright frame.
    pub fn upright_vertices(&self) -> impl Iterator<Item = Point> + '_ {
        self.solid
            .mesh()
            .vertices()
            .iter()
            .map(|vertex| self.upright.to_local(vertex))
    }

    /// The solid's centre of mass in the upright frame.
    pub fn upright_center(&self) -> Point {
        self.upright.to_local(&self.body.center)
    }

    /// The point an option names, in the upright frame, if it is one on the model or not far from
    /// it.
    pub fn given_point(&self, name: &'static str, [x, y, z]: [f64; 3]) -> Result<Point, GoalError> {
        if !(x.is_finite() && y.is_finite() && z.is_finite()) {
            return Err(GoalError::NotAPoint { name, x, y, z });
        }
        let (point, mesh) = (Point::new(x, y, z), self.solid.mesh());
        let far_mm = FAR_LENGTHS * mesh.longest_side_mm();
        if mesh.aabb().distance_squared(&point) > far_mm * far_mm {
            return Err(GoalError::FarAway { name });
        }
        Ok(self.upright.to_local(&point))
    }

    /// The height of the model, mm.
    pub fn height_mm(&self) -> f64 {
        self.highest_mm - self.lowest_mm
    }
}

fn up_direction(up: Up, solid: &Solid, body: &Body) -> Result<Vector, GoalError> {
    match up {
        Up::Principal => Ok(principal_direction(solid, body)),
        Up::Auto => Err(GoalError::NotChosen),
        _ => up.direction().ok_or(GoalError::NoDirection(up)),
    }
}

/// The axis of the largest moment, in the sense in which the centre stands lower; on a tie, in the
/// sense whose z (then y, then x) component is positive.
fn principal_direction(solid: &Solid, body: &Body) -> Vector {
    let axis: Vector = body.principal().axes.column(2).into();
    let (lowest, highest) = extent_along(solid, &axis);
    let center = axis.dot(&body.center.coords);
    let (below, above) = (center - lowest, highest - center);
    if (below - above).abs() > TIE_RATIO * (highest - lowest) {
        return if below < above { axis } else { -axis };
    }
    let first = [axis.z, axis.y, axis.x]
        .into_iter()
        .find(|component| component.abs() > TIE_RATIO);
    if first.unwrap_or(1.0) > 0.0 {
        axis
    } else {
        -axis
    }
}

/// The least and greatest coordinate of the solid along a unit direction, mm.
fn extent_along(solid: &Solid, direction: &Vector) -> (f64, f64) {
    let heights = solid
        .mesh()
        .vertices()
        .iter()
        .map(|vertex| direction.dot(&vertex.coords));
    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| {
        (low.min(height), high.max(height))
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Warning, testing::*};
    use super::*;

    fn request(kind: GoalKind) -> Request {
        Request::new(kind)
    }

    #[test]
    fn a_block_on_its_face_touches_at_the_faces_middle() {
        let placed = place(
            &block([-1., -2., 3.], [5., 4., 9.]),
            1.0,
            &request(GoalKind::Top),
        )
        .unwrap();
        assert!((placed.goal.frame.origin - Point::new(2., 1., 3.)).norm() < 1e-12);
        assert!(placed.warnings.is_empty());
        assert_eq!(placed.keeps.len(), 1);
        assert!((placed.keeps[0].radius_mm - 2.0).abs() < 1e-15);
    }

    #[test]
    fn below_the_center_of_two_legs_is_air_and_the_height_is_named() {
        // A table: a plate from z = 6 to 8 on two legs; its centre is over the gap.
        let table = arch();
        let wish = Request {
            contact: Some(Contact::Center),
            ..request(GoalKind::Top)
        };
        let placed = place(&table, 1.0, &wish).unwrap();
        assert_eq!(placed.goal.frame.origin.z, 0.0);
        assert!(
            matches!(placed.warnings[..], [Warning::ContactInAir { missing_mm }] if (missing_mm - 6.0).abs() < 1e-12)
        );
    }

    #[test]
    fn a_flat_slab_spins_easiest_about_its_normal() {
        let slab = block([0., 0., 0.], [10., 2., 8.]);
        let wish = Request {
            up: Up::Principal,
            ..request(GoalKind::Yoyo)
        };
        let placed = place(&slab, 1.0, &wish).unwrap();
        assert!((placed.goal.frame.axis() - Vector::y()).norm() < 1e-12);
        assert!((placed.goal.frame.origin - Point::new(5., 1., 4.)).norm() < 1e-12);
    }

    #[test]
    fn turned_upside_down_the_solid_keeps_its_mass_and_stands_on_its_other_end() {
        let solid = block([0., 0., 0.], [2., 3., 7.]);
        let wish = Request {
            up: Up::NegZ,
            ..request(GoalKind::Stand)
        };
        let goal = place(&solid, 1.0, &wish).unwrap().goal;
        assert!((goal.solid.volume() - 42.0).abs() < 1e-12);
        assert!((goal.frame.origin - Point::new(1., 1.5, 7.)).norm() < 1e-12);
        assert!((goal.solid.centroid().z - 3.5).abs() < 1e-12);
    }

    #[test]
    fn a_top_that_hangs_from_its_contact_is_refused() {
        let wish = Request {
            contact: Some(Contact::At([1., 1., 5.])),
            ..request(GoalKind::Top)
        };
        let refused = place(&block([0., 0., 0.], [2., 2., 6.]), 1.0, &wish);
        assert!(
            matches!(refused, Err(GoalError::ContactAboveCenter { depth_mm }) if (depth_mm - 2.0).abs() < 1e-12)
        );
    }

    #[test]
    fn what_is_no_number_is_refused_by_name() {
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
        let wish = Request {
            objective: Objective::CriticalSpeed,
            ..request(GoalKind::Stand)
        };
        let refused = place(&block([0., 0., 0.], [2., 2., 6.]), 1.0, &wish);
        assert!(matches!(
            refused,
            Err(GoalError::Request(RequestError::Objective { .. }))
        ));
    }
}
