//! Which of two answers is the better one, possible or not.

use crate::goal::Goal;
use crate::hollow::{Solution, Status};

/// How far an answer is from the best: first its kind, then a number; less is better.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct Rank(u8, f64);

/// It does all that was asked.
const FULL: u8 = 0;
/// It does what was asked by another way: a rotor within its grade that cannot be balanced wholly.
const PARTIAL: u8 = 1;
/// The rows can be met, but the goal cannot.
const MISSED: u8 = 2;
/// The rows cannot be met.
const ASIDE: u8 = 3;
/// Even its mass is wrong.
const TOO_HEAVY_OR_LIGHT: u8 = 4;
/// Nothing is known.
const UNKNOWN: u8 = 5;

impl Rank {
    /// The rank of what the solver says.
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
            Status::ConstraintsInfeasible { least_miss, .. } => Self(ASIDE, least_miss),
            Status::CannotTrim {
                least_offset_mm, ..
            } => Self(ASIDE, least_offset_mm),
            Status::Sinks { least_ratio } => Self(TOO_HEAVY_OR_LIGHT, least_ratio),
            Status::RidesHigh { greatest_ratio } => Self(TOO_HEAVY_OR_LIGHT, -greatest_ratio),
            _ => Self(UNKNOWN, solution.certificate.residual),
        }
    }

    /// Whether it does all that was asked.
    pub fn is_full(self) -> bool {
        self.0 == FULL
    }

    /// Whether this is better than the other by more than rounding.
    pub fn beats(self, other: Self) -> bool {
        self.0 < other.0 || (self.0 == other.0 && self.1 < other.1 - GAIN_RATIO * other.1.abs())
    }
}

/// What is gained by less than this share is not worth another place: the solver's own gap is a
/// thousandth of it.
const GAIN_RATIO: f64 = 1e-4;
