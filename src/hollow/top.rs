//! The top: the best height of the centre, whether any is stable, and the proof over all of them.

use super::answer::Answer;
use super::cover::{Cover, can_cover};
use super::heights::Heights;
use super::programme::Programme;
use super::solution::Warm;
use super::status::Status;
use super::valley::{Bottom, Sample, Valley};
use super::work::Work;
use crate::goal::Objective;

/// By how much of the value another height might still be better than the bound over all heights says. A hundredth of
/// it would cost ten times the intervals.
const COVER_RATIO: f64 = 2e-3;

/// The best interior of a top, or the proof that no interior makes it stable.
pub(super) fn solve(work: &Work, objective: Objective) -> Answer {
    let range = match Heights::range(work) {
        Ok(range) => range,
        Err(climb) => return Answer::new(objective, *climb),
    };
    let heights = Heights { work, objective };
    let Some(bottom) = heights.lowest(range) else {
        return heights.given_up(range);
    };
    if is_stable(work, &bottom.sample) {
        return with_cover(work, range, answer(objective, bottom));
    }
    match objective {
        Objective::CriticalSpeed => unstable(work, range, bottom),
        _ => solve(work, Objective::CriticalSpeed),
    }
}

/// The same search near a known answer, in a few passes: its dual point, height and curvature are aimed by. None where
/// the ground has changed too much for that.
pub(super) fn refine(work: &Work, objective: Objective, warm: &Warm) -> Option<Answer> {
    let heights = Heights { work, objective };
    let bottom = Valley::near(warm.height?).bottom(|height, near| {
        let known = near.map_or((&warm.point, warm.mass), Sample::start);
        heights.sample(height, Some(known), 0.0)
    })?;
    let usable = is_stable(work, &bottom.sample) && work.accepts(&bottom.sample.climb);
    usable.then(|| answer(objective, bottom))
}

fn answer(objective: Objective, bottom: Bottom) -> Answer {
    Answer {
        height: Some(bottom.tangent()),
        mass: bottom.sample.mass,
        ..Answer::new(objective, bottom.sample.climb)
    }
}

/// Whether some speed is enough for the interior of a sample.
fn is_stable(work: &Work, sample: &Sample) -> bool {
    let programme = Programme::top_critical_speed(&work.reach, sample.at);
    programme.numerator_at(&sample.climb.best.extreme.s) < 0.0
}

/// No height has a stable interior: the least I_b/I_c over all of them is the number that says so.
fn unstable(work: &Work, range: [f64; 2], tried: Bottom) -> Answer {
    let heights = Heights { work, objective: Objective::Dominance };
    let bottom = heights.lowest(range).unwrap_or(tried);
    let answer = with_cover(work, range, answer(Objective::Dominance, bottom));
    let proved = answer.bound_over_heights.filter(|&bound| bound >= 1.0);
    let least_ratio = proved.unwrap_or(answer.climb.best.bound);
    answer.with_verdict(Status::UnstableForEveryInterior { least_ratio, proved: proved.is_some() })
}

/// The answer, with a bound over every height of the range where one can be proved.
fn with_cover(work: &Work, range: [f64; 2], answer: Answer) -> Answer {
    if !can_cover(answer.objective) {
        return answer;
    }
    let best = answer.climb.best.bound;
    let target = best - COVER_RATIO * best.abs();
    // Where 1 decides, a ratio just above it is compared with 1 itself.
    let decides = answer.objective == Objective::Dominance && best > 1.0;
    let target = if decides { target.max(1.0) } else { target };
    let cover = Cover { heights: Heights { work, objective: answer.objective }, target };
    let bound_over_heights = cover.holds_over(range, &answer.climb.best.point).then_some(target);
    Answer { bound_over_heights, ..answer }
}
