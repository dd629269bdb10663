//! The order of answers, possible or not.

use crate::goal::Goal;
use crate::hollow::{Solution, Status};

/// The rank of an answer: first its kind, then a number; less is better.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct Rank(u8, f64);

/// It meets the goal as asked.
const FULL: u8 = 0;
/// It meets the goal by another objective: a rotor within its grade that cannot be balanced fully.
const PARTIAL: u8 = 1;
/// The constraints can be met, but the goal cannot.
const MISSED: u8 = 2;
/// The constraints cannot be met.
const INFEASIBLE: u8 = 3;
/// Even its mass is wrong.
const TOO_HEAVY_OR_LIGHT: u8 = 4;
/// The solver gave no decision.
const UNDECIDED: u8 = 5;

impl Rank {
    /// Returns the rank of a solver's answer.
    pub fn of(solution: &Solution, goal: &Goal) -> Self {
        if solution.is_usable() {
            let kind = if solution.objective == goal.objective {
                FULL
            } else {
                PARTIAL
            };
            let certificate = &solution.certificate;
            return Self(kind, certificate.figure.cost(certificate.value));
        }
        match solution.status {
            Status::NotDominant { least_ratio } => Self(MISSED, least_ratio),
            Status::UnstableForEveryInterior { least_ratio, .. } => Self(MISSED, least_ratio),
            Status::CannotStand { greatest_angle_rad } => Self(MISSED, -greatest_angle_rad),
            Status::Capsizes { greatest_gm_mm } => Self(MISSED, -greatest_gm_mm),
            Status::CannotBalance {
                least_grade_mm_s, ..
            } => Self(MISSED, least_grade_mm_s),
            Status::ConstraintsInfeasible { least_miss, .. } => Self(INFEASIBLE, least_miss),
            Status::CannotTrim {
                least_offset_mm, ..
            } => Self(INFEASIBLE, least_offset_mm),
            Status::Sinks { least_ratio } => Self(TOO_HEAVY_OR_LIGHT, least_ratio),
            Status::RidesHigh { greatest_ratio } => Self(TOO_HEAVY_OR_LIGHT, -greatest_ratio),
            _ => Self(UNDECIDED, solution.certificate.residual),
        }
    }

    /// Returns true if it meets the goal as asked.
    pub fn is_full(self) -> bool {
        self.0 == FULL
    }

    /// Returns true if this is better than the other by more than rounding.
    pub fn beats(self, other: Self) -> bool {
        self.0 < other.0 || (self.0 == other.0 && self.1 < other.1 - GAIN_RATIO * other.1.abs())
    }
}

/// A gain below this share is not worth another place. The solver's own gap is a thousandth of it.
const GAIN_RATIO: f64 = 1e-4;
