//! The model as every kind of goal sees it: upright, with its moments and its extent.

use std::sync::OnceLock;

use super::error::{FAR_LENGTHS, GoalError};
use super::kind::{GoalKind, Objective};
use super::placement::Goal;
use super::request::Request;
use super::sites::Up;
use crate::geom::{Frame, Point, Vector};
use crate::mass::{Body, Moments, moments_of_mesh};
use crate::mesh::{Csg, Solid};

/// Heights closer than this part of the model's extent count as equal. Below 1e-12 rounding decides
/// between the two senses of a symmetric model's axis. Above 1e-6 a real difference would be
/// ignored.
const TIE_RATIO: f64 = 1e-9;

/// A solid with its moments and, once they were asked for, the corners of its convex hull.
#[derive(Debug, Clone)]
pub struct MeasuredSolid<'a> {
    /// The solid.
    pub solid: &'a Solid,
    /// Its moments, model frame, mm: those of [`crate::mass::moments_of_mesh`].
    pub moments: Moments,
    hull_corners: OnceLock<Vec<Point>>,
}

impl<'a> MeasuredSolid<'a> {
    /// Measures the moments of a solid.
    pub fn new(solid: &'a Solid) -> Self {
        Self {
            solid,
            moments: moments_of_mesh(solid.mesh()),
            hull_corners: OnceLock::new(),
        }
    }

    /// Returns the corners of the convex hull, model frame, mm; all vertices if there is no hull.
    fn hull_corners(&self) -> &[Point] {
        self.hull_corners.get_or_init(|| {
            let vertices = self.solid.mesh().vertices();
            let hull = Csg::convex_hull(vertices).and_then(|hull| hull.to_mesh());
            match hull {
                Ok(hull) if !hull.vertices().is_empty() => hull.vertices().to_vec(),
                _ => vertices.to_vec(),
            }
        })
    }
}

/// The facts of the model that every kind of goal needs.
pub(super) struct Site<'a> {
    measured: &'a MeasuredSolid<'a>,
    pub solid: &'a Solid,
    pub kind: GoalKind,
    pub objective: Objective,
    /// The direction that is up, as it was asked for.
    pub up: Up,
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
    pub fn new(measured: &'a MeasuredSolid<'a>, request: &Request) -> Result<Self, GoalError> {
        let (solid, moments) = (measured.solid, measured.moments);
        let body = Body::new(&moments, 1.0);
        let up = up_direction(request.up, solid, &body)?;
        let (lowest_mm, highest_mm) = extent_along(solid, &up);
        let upright = Frame::with_axis(Point::origin(), &up);
        Ok(Self {
            measured,
            solid,
            kind: request.kind,
            objective: request.objective,
            up: request.up,
            moments,
            body,
            upright,
            lowest_mm,
            highest_mm,
        })
    }

    /// Returns the goal whose frame has this origin, given in the upright frame.
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
            wanted: None,
            solid,
        }
    }

    /// Returns the model's vertices in the upright frame.
    pub fn upright_vertices(&self) -> impl Iterator<Item = Point> + '_ {
        self.solid
            .mesh()
            .vertices()
            .iter()
            .map(|vertex| self.upright.to_local(vertex))
    }

    /// Returns the corners of the model's convex hull in the upright frame.
    pub fn hull_corners(&self) -> impl Iterator<Item = Point> + '_ {
        let corners = self.measured.hull_corners().iter();
        corners.map(|corner| self.upright.to_local(corner))
    }

    /// Returns the solid's centre of mass in the upright frame.
    pub fn upright_center(&self) -> Point {
        self.upright.to_local(&self.body.center)
    }

    /// Returns the point that an option gives, in the upright frame. Refuses points far from the
    /// model.
    pub fn locate_point(
        &self,
        name: &'static str,
        [x, y, z]: [f64; 3],
    ) -> Result<Point, GoalError> {
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

    /// Returns the height of the model, mm.
    pub fn height_mm(&self) -> f64 {
        self.highest_mm - self.lowest_mm
    }
}

fn up_direction(up: Up, solid: &Solid, body: &Body) -> Result<Vector, GoalError> {
    match up {
        Up::Principal => Ok(principal_direction(solid, body)),
        Up::Auto | Up::Natural => Err(GoalError::NotChosen(up)),
        _ => up.direction().ok_or(GoalError::NoDirection(up)),
    }
}

/// Returns the axis of the largest moment, in the sense in which the centre stands lower. On a tie
/// the first component of z, y, x that is not zero is positive.
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

/// Returns the least and greatest coordinate of the solid along a unit direction, mm.
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
