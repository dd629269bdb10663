//! The yo-yo: the requested functional, and the dominance that decides whether it is stable.

use crate::goal::Objective;
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::ascent::{Climb, End};
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::work::Work;
use crate::hollow::status::Status;

/// Finds the best interior of a yo-yo, or the proof that its axis cannot be made dominant.
pub(crate) fn solve(work: &Work, objective: Objective, start: Option<&DualPoint>) -> Answer {
    if objective == Objective::Dominance {
        return minimise_dominance(work, start);
    }
    let programme = Programme::yoyo_functional(&work.reach);
    let climb = work.ascend(&programme, start);
    if matches!(climb.end, End::Infeasible(_) | End::Cancelled) || is_dominant(work, &climb) {
        return Answer::new(objective, climb);
    }
    minimise_dominance(work, None)
}

/// Finds the interior with the most dominant axis; if its ratio is 1 or more, none is stable.
fn minimise_dominance(work: &Work, start: Option<&DualPoint>) -> Answer {
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
