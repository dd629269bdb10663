//! The yo-yo: the functional asked for, and the dominance that decides whether it is worth
//! anything.

use crate::goal::Objective;
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::ascent::{Climb, End};
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::work::Work;
use crate::hollow::status::Status;

/// The best interior of a yo-yo, or the proof that its axis cannot be made dominant.
pub(crate) fn solve(work: &Work, objective: Objective, start: Option<&DualPoint>) -> Answer {
    if objective == Objective::Dominance {
        return dominance(work, start);
    }
    let programme = Programme::yoyo_functional(&work.reach);
    let climb = work.ascend(&programme, start);
    if matches!(climb.end, End::Infeasible(_) | End::Cancelled) || is_dominant(work, &climb) {
        return Answer::new(objective, climb);
    }
    dominance(work, None)
}

/// The interior whose axis is the most dominant; at a ratio of 1 or more none is stable.
fn dominance(work: &Work, start: Option<&DualPoint>) -> Answer {
    let programme = Programme::yoyo_dominance(&work.reach);
    let climb = work.ascend(&programme, start);
    let least_ratio = climb.best.bound;
    let answer = Answer::new(Objective::Dominance, climb);
    if least_ratio >= 1.0 {
        answer.with_verdict(Status::NotDominant { least_ratio })
    } else {
        answer
    }
}

fn is_dominant(work: &Work, climb: &Climb) -> bool {
    let programme = Programme::yoyo_dominance(&work.reach);
    let s = &climb.best.extreme.s;
    programme.numerator_at(s) < programme.denominator_at(s)
}
