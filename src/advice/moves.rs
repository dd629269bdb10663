//! The ways a request may give: its contact or spin point shifted, its axis tilted.

use super::Case;
use super::directions::lattice;
use super::nearest::Nearest;
use super::orientation::over_corners;
use super::remedy::{Kind, Remedy};
use crate::base::units::show_mm;
use crate::geom::{Frame, Point, Vector};
use crate::goal::{Contact, Goal, GoalKind, Request, SpinPoint, Up};
use crate::mass::{Body, Moments};

/// Directions of the lattice that are tried one after the other, the least tilt first: 20° apart.
const FAR_DIRECTIONS: usize = 100;

/// What is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// A top's contact point, across the axis.
    Contact,
    /// A yo-yo's spin point, anywhere.
    SpinPoint,
    /// The axis; the contact follows by the request's own rule.
    Axis,
}

/// Requests about the one that was asked for: a step of zero is that one.
///
/// A step is in the coordinates of the goal's frame: mm for a point; for the axis the direction
/// across it towards which it tilts, as long as the angle in rad.
#[derive(Debug, Clone)]
pub(super) struct Moves {
    pub part: Part,
    request: Request,
    frame: Frame,
    /// No step is longer.
    pub limit: f64,
    /// Steps to look towards first.
    pub seeds: Vec<Vector>,
    /// Steps to try besides, as far as they are shorter than what that leads to; the shortest
    /// first.
    pub far: Vec<Vector>,
}

impl Moves {
    /// The ways in which the goal of a request may give.
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
        let (request, frame) = (case.request, goal.frame);
        Self {
            part: Part::Axis,
            request,
            frame,
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

    /// The same tilts with the contact below the centre of mass; none where it is there already, or
    /// for what has none.
    pub fn over_the_center(&self) -> Option<Self> {
        let is_other =
            self.part == Part::Axis && self.request.contact.is_some_and(|c| c != Contact::Center);
        let request = Request {
            contact: Some(Contact::Center),
            ..self.request
        };
        is_other.then(|| Self {
            request,
            ..self.clone()
        })
    }

    /// How many coordinates a step has; the others are zero.
    pub fn dimension(&self) -> usize {
        if self.part == Part::SpinPoint { 3 } else { 2 }
    }

    /// The request one step away.
    pub fn request(&self, step: &Vector) -> Request {
        let point: [f64; 3] = self.frame.to_model(&Point::from(*step)).into();
        match self.part {
            Part::Contact => Request {
                contact: Some(Contact::At(point)),
                ..self.request
            },
            Part::SpinPoint => Request {
                spin_point: Some(SpinPoint::At(point)),
                ..self.request
            },
            Part::Axis => Request {
                up: Up::Along(self.axis(step).into()),
                ..self.request
            },
        }
    }

    /// The axis tilted by a step, a unit vector of the model.
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

    /// What was found, as a remedy.
    pub fn remedy(&self, found: Option<Nearest>) -> Remedy {
        let kind = match self.part {
            Part::Contact => Kind::NearestContact,
            Part::SpinPoint => Kind::NearestSpinPoint,
            Part::Axis => Kind::NearestAxis,
        };
        let Some(nearest) = found else {
            return Remedy::nothing(kind, self.leads_nowhere().to_owned());
        };
        let length = nearest.step.norm();
        let amount = if self.part == Part::Axis {
            length.to_degrees()
        } else {
            length
        };
        Remedy::found(
            kind,
            amount,
            [flags(self.part, &nearest.request), self.words(&nearest)],
            &nearest.trial,
        )
    }

    fn leads_nowhere(&self) -> &'static str {
        match self.part {
            Part::Contact => "no contact point on the same level helps, as far as was looked",
            Part::SpinPoint => "no other spin point helps, as far as was looked",
            Part::Axis => "no other axis helps, as far as was looked",
        }
    }

    fn words(&self, nearest: &Nearest) -> String {
        let length = nearest.step.norm();
        let towards = direction_words(&self.frame.direction_to_model(&nearest.step));
        match (self.part, nearest.request.contact) {
            (Part::Contact, _) => format!(
                "move the contact point {} toward {towards}",
                show_mm(length)
            ),
            (Part::SpinPoint, _) => {
                format!("move the spin point {} toward {towards}", show_mm(length))
            }
            (Part::Axis, Some(Contact::Lowest)) => format!(
                "tilt the axis by {:.1}° toward {towards}, with the contact where the model then is lowest",
                length.to_degrees()
            ),
            (Part::Axis, Some(Contact::Center)) => format!(
                "tilt the axis by {:.1}° toward {towards}, with the contact below the centre of mass",
                length.to_degrees()
            ),
            (Part::Axis, _) => format!(
                "tilt the axis by {:.1}° toward {towards}",
                length.to_degrees()
            ),
        }
    }
}

/// The steps that tilt the axis onto the solid's axis of the largest moment: in both senses, or in
/// the nearer one.
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

/// The step that tilts z onto a unit vector of the goal's frame.
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

/// What to type for a moved part.
fn flags(part: Part, request: &Request) -> String {
    match (part, request.contact, request.spin_point) {
        (Part::Contact, Some(contact), _) => format!("--contact={contact}"),
        (Part::SpinPoint, _, Some(point)) => format!("--spin-point={point}"),
        (_, Some(Contact::Center), _) => format!("--up={} --contact=center", request.up),
        _ => format!("--up={}", request.up),
    }
}

/// A direction whose nearest coordinate axis is this near needs no numbers: cos 10°.
const ALONG_COSINE: f64 = 0.985;

/// "+x", or the unit vector.
fn direction_words(direction: &Vector) -> String {
    let unit = direction.normalize();
    let largest = unit.iamax();
    if unit[largest].abs() >= ALONG_COSINE {
        let sign = if unit[largest] > 0.0 { '+' } else { '−' };
        return format!("{sign}{}", ["x", "y", "z"][largest]);
    }
    format!("({:.2}, {:.2}, {:.2})", unit.x, unit.y, unit.z)
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

    #[test]
    fn a_direction_is_a_word_where_one_is_true_enough() {
        assert_eq!(direction_words(&Vector::new(0.1, -3.0, 0.1)), "−y");
        assert_eq!(
            direction_words(&Vector::new(3.0, 0.0, 4.0)),
            "(0.60, 0.00, 0.80)"
        );
    }
}
