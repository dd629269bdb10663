//! The moves of a request: its contact or spin point shifted, its axis tilted.

use super::case::Case;
use super::directions::lattice;
use super::orientation::over_corners;
use crate::geom::{Frame, Point, Vector};
use crate::goal::{Contact, Goal, GoalKind, Request, SpinPoint, TipChoice, Up};
use crate::mass::{Body, Moments};

/// The number of lattice directions that are tried in turn, the least tilt first: 20° apart.
const FAR_DIRECTIONS: usize = 100;

/// The part of a request that is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// A top's contact point, across the axis.
    Contact,
    /// A yo-yo's spin point, anywhere.
    SpinPoint,
    /// The axis; the contact follows by the request's own rule.
    Axis,
}

/// The requests around the one that was asked for; a step of zero leads to that one.
///
/// A step is in the coordinates of the goal's frame. For a point it is in mm. For the axis it
/// points across the axis in the direction of the tilt, and its length is the angle in rad.
#[derive(Debug, Clone)]
pub(super) struct Moves {
    pub part: Part,
    pub asked: Request,
    pub frame: Frame,
    /// The longest step.
    pub limit: f64,
    /// The steps whose directions are tried first.
    pub seeds: Vec<Vector>,
    /// Further steps to try, the shortest first, as long as they are shorter than the best so far.
    pub far: Vec<Vector>,
}

impl Moves {
    /// Returns the moves for the goal of a request.
    pub fn of(case: &Case, goal: &Goal) -> Vec<Self> {
        let point = Moves {
            limit: 0.5 * case.solid.mesh().aabb().size().norm(),
            ..Self::none(case, goal)
        };
        let center = goal.solid.centroid().coords;
        let level = Vector::new(center.x, center.y, 0.0);
        match goal.kind {
            GoalKind::Top => {
                vec![
                    Self {
                        part: Part::Contact,
                        seeds: vec![level],
                        ..point
                    },
                    Self::tilts(case, goal),
                ]
            }
            GoalKind::Yoyo => {
                vec![
                    Self {
                        part: Part::SpinPoint,
                        seeds: vec![center],
                        ..point
                    },
                    Self::tilts(case, goal),
                ]
            }
            GoalKind::Float => vec![Self::tilts(case, goal)],
            _ => Vec::new(),
        }
    }

    fn none(case: &Case, goal: &Goal) -> Self {
        Self {
            part: Part::Axis,
            asked: with_tip_to_come(case.request),
            frame: goal.frame,
            limit: 0.0,
            seeds: Vec::new(),
            far: Vec::new(),
        }
    }

    fn tilts(case: &Case, goal: &Goal) -> Self {
        let has_sense = goal.kind != GoalKind::Yoyo;
        let local = |axis: Vector| goal.frame.direction_to_local(&axis);
        let is_nearer = |axis: &Vector| has_sense || axis.z >= 0.0;
        let corners = if case.request.contact == Some(Contact::Lowest) {
            over_corners(case.solid.mesh())
        } else {
            Vec::new()
        };
        let far = lattice(FAR_DIRECTIONS)
            .into_iter()
            .chain(corners)
            .map(local)
            .filter(is_nearer);
        let mut far: Vec<Vector> = far.map(|axis| tilt_to(&axis)).collect();
        far.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        let seeds = tilts_to_principal(has_sense, &goal.solid);
        Self {
            limit: std::f64::consts::PI,
            seeds,
            far,
            ..Self::none(case, goal)
        }
    }

    /// Returns the same tilts with the contact below the centre of mass. `None` if it is there
    /// already, or there is no contact.
    pub fn with_centered_contact(&self) -> Option<Self> {
        let is_other =
            self.part == Part::Axis && self.asked.contact.is_some_and(|c| c != Contact::Center);
        let asked = Request {
            contact: Some(Contact::Center),
            ..self.asked
        };
        is_other.then(|| Self {
            asked,
            ..self.clone()
        })
    }

    /// Returns the number of coordinates of a step; the others are zero.
    pub fn dimension(&self) -> usize {
        if self.part == Part::SpinPoint { 3 } else { 2 }
    }

    /// Returns the request one step away.
    pub fn request(&self, step: &Vector) -> Request {
        let point: [f64; 3] = self.frame.to_model(&Point::from(*step)).into();
        match self.part {
            Part::Contact => Request {
                contact: Some(Contact::At(point)),
                ..self.asked
            },
            Part::SpinPoint => Request {
                spin_point: Some(SpinPoint::At(point)),
                ..self.asked
            },
            Part::Axis => Request {
                up: Up::Along(self.axis(step).into()),
                ..self.asked
            },
        }
    }

    /// Returns the axis tilted by a step, a unit vector of the model.
    fn axis(&self, step: &Vector) -> Vector {
        let tilt = step.norm();
        let across = if tilt > 0.0 {
            step / tilt
        } else {
            Vector::zeros()
        };
        self.frame
            .direction_to_model(&(across * tilt.sin() + Vector::z() * tilt.cos()))
    }
}

/// Returns the request with a tip if its new place needs one, also if none was ordered. A contact
/// in the air is no remedy.
fn with_tip_to_come(request: Request) -> Request {
    let is_waived = request.tip == TipChoice::None && request.least_lean_deg > 0.0;
    Request {
        tip: if is_waived {
            TipChoice::Auto
        } else {
            request.tip
        },
        ..request
    }
}

/// Returns the steps that tilt the axis onto the solid's axis of the largest moment: in both
/// senses, or in the nearer one.
fn tilts_to_principal(has_sense: bool, solid: &Moments) -> Vec<Vector> {
    let axis: Vector = Body::new(solid, 1.0).principal().axes.column(2).into();
    let nearer = if axis.z < 0.0 { -axis } else { axis };
    let senses = if has_sense {
        vec![nearer, -nearer]
    } else {
        vec![nearer]
    };
    senses.into_iter().map(|axis| tilt_to(&axis)).collect()
}

/// Returns the step that tilts z onto a unit vector of the goal's frame.
fn tilt_to(axis: &Vector) -> Vector {
    let across = Vector::new(axis.x, axis.y, 0.0);
    let sine = across.norm();
    let towards = if sine > 0.0 {
        across / sine
    } else {
        Vector::x()
    };
    towards * sine.atan2(axis.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilt_leads_to_the_axis_it_was_made_for() {
        for axis in [
            Vector::new(0.6, 0.0, 0.8),
            Vector::new(0.0, -0.8, -0.6),
            -Vector::z(),
        ] {
            let step = tilt_to(&axis);
            let tilt = step.norm();
            let reached = step / tilt * tilt.sin() + Vector::z() * tilt.cos();
            assert!((reached - axis).norm() < 1e-12, "{axis}");
            assert!((tilt - axis.angle(&Vector::z())).abs() < 1e-7);
        }
    }
}
