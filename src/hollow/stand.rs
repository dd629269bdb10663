//! The standing object: the largest tilt before it topples, or the lowest centre over the middle of
//! its support.

use super::answer::Answer;
use super::programme::{DualPoint, Programme};
use super::status::Status;
use super::work::Work;
use crate::goal::Objective;

/// The best interior of a standing object, or the proof that none stands.
pub(super) fn solve(work: &Work, objective: Objective, start: Option<&DualPoint>) -> Answer {
    let programme = match objective {
        Objective::LowestCenter => Programme::stand_lowest_center(&work.reach),
        _ => Programme::stand_toppling(&work.reach, work.goal),
    };
    let climb = work.ascend(&programme, start);
    let least = climb.best.bound;
    let answer = Answer::new(objective, climb);
    if objective == Objective::TopplingAngle && least >= 0.0 {
        return answer.with_verdict(Status::CannotStand {
            greatest_angle_rad: -least.atan(),
        });
    }
    answer
}
