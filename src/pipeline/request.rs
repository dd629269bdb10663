//! From the words of a job to the request the goal is placed by.

use crate::goal;
use crate::job::{Contact, GoalChoice, GoalKind, Objective, SpinPoint, Up};

/// The request that a job's goal stands for, with the defaults filled in.
pub fn request_of(choice: &GoalChoice) -> goal::Request {
    goal::Request {
        kind: kind_of(choice.kind),
        up: up_of(choice.up),
        contact: contact_of(choice.contact.unwrap_or(Contact::Lowest)),
        spin_point: spin_point_of(choice.spin_point.unwrap_or(SpinPoint::Center)),
        objective: Some(objective_of(choice.objective)),
    }
}

fn kind_of(kind: GoalKind) -> goal::GoalKind {
    match kind {
        GoalKind::Top => goal::GoalKind::Top,
        GoalKind::Yoyo => goal::GoalKind::Yoyo,
        GoalKind::Stand => goal::GoalKind::Stand,
    }
}

fn up_of(up: Up) -> goal::Up {
    match up {
        Up::X => goal::Up::X,
        Up::Y => goal::Up::Y,
        Up::Z => goal::Up::Z,
        Up::NegX => goal::Up::MinusX,
        Up::NegY => goal::Up::MinusY,
        Up::NegZ => goal::Up::MinusZ,
        Up::Along(along) => goal::Up::Vector(along),
        Up::Principal => goal::Up::Principal,
    }
}

fn contact_of(contact: Contact) -> goal::Contact {
    match contact {
        Contact::Lowest => goal::Contact::Lowest,
        Contact::Center => goal::Contact::Center,
        Contact::At(point) => goal::Contact::Point(point),
    }
}

fn spin_point_of(point: SpinPoint) -> goal::SpinPoint {
    match point {
        SpinPoint::Center => goal::SpinPoint::Center,
        SpinPoint::At(point) => goal::SpinPoint::Point(point),
    }
}

/// Spin-It's functional comes with its own weights: γ_c = γ_I = 1 for a top (its eq. 7), γ_I alone for a yo-yo.
fn objective_of(objective: Objective) -> goal::Objective {
    match objective {
        Objective::CriticalSpeed => goal::Objective::CriticalSpeed,
        Objective::SpinIt => goal::Objective::SpinIt { gamma_c: 1.0, gamma_i: 1.0 },
        Objective::Dominance => goal::Objective::Dominance,
        Objective::TopplingAngle => goal::Objective::TopplingAngle,
        Objective::LowestCenter => goal::Objective::LowestCenter,
    }
}
