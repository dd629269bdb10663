//! The standing object: the largest toppling angle, or the lowest centre over the middle of its
//! support.

use crate::goal::Objective;
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::work::Work;
use crate::hollow::status::Status;

/// Finds the best interior of a standing object, or the proof that none stands.
pub(crate) fn solve(work: &Work, objective: Objective, start: Option<&DualPoint>) -> Answer {
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
