//! The top: for each height of the centre a quasi-convex programme, and a search over the heights.

use super::answer::{Answer, functional};
use super::ascent::{Climb, End};
use super::cover::{Cover, relaxation};
use super::programme::{DualPoint, Programme, index};
use super::solution::{Stage, Tangent, Warm};
use super::status::Status;
use super::valley::{Bottom, Sample, Valley};
use super::work::Work;
use crate::goal::Objective;

/// How exact the coarse look over all heights is: only the places of the valleys are wanted.
const LOOK_TOLERANCE: f64 = 1e-2;
/// How exact the ends of the range of heights are; the outer bounds are used.
const RANGE_TOLERANCE: f64 = 1e-3;
/// How much better another height might be than the bound over all heights says; a tenth of it would cost three times
/// the intervals.
const COVER_RATIO: f64 = 2e-3;
/// Part of the value that a further correction of the height must promise to be worth making on fine columns.
const REFINE_RATIO: f64 = 1e-9;
/// Corrections of the height on fine columns at most; each squares the last one's error.
const REFINE_ROUNDS: usize = 4;

/// The best interior of a top, or the proof that no interior makes it stable.
pub(super) fn solve(work: &Work, objective: Objective) -> Answer {
    let range = match height_range(work) {
        Ok(range) => range,
        Err(climb) => return Answer::new(objective, *climb),
    };
    let Some(bottom) = lowest(work, objective, range) else {
        return stopped(work, objective, range);
    };
    match objective {
        Objective::CriticalSpeed if bottom.sample.value >= 0.0 => unstable(work, range, bottom),
        Objective::SpinIt { .. } if !is_stable(work, &bottom.sample) => solve_stable(work, range, bottom),
        _ => with_cover(work, range, answer(objective, bottom)),
    }
}

/// The same search near a known answer, with a few passes: the height is corrected by its slope's known growth.
/// None where the ground has changed too much for that.
pub(super) fn refine(work: &Work, objective: Objective, warm: &Warm) -> Option<Answer> {
    let Tangent { at, mut curvature } = warm.height?;
    let mut sample = sample_at(work, objective, at, Some((&warm.point, warm.mass)))?;
    for _ in 0..REFINE_ROUNDS {
        let step = -sample.slope / curvature;
        let promise = 0.5 * (sample.slope * step).abs();
        if promise <= REFINE_RATIO * sample.value.abs() || !step.is_finite() {
            break;
        }
        let start = (&sample.climb.best.point, sample.mass);
        let next = sample_at(work, objective, sample.at + step, Some(start))?;
        curvature = (next.slope - sample.slope) / step;
        if curvature <= 0.0 || next.value > sample.value + promise {
            return None;
        }
        sample = next;
    }
    let usable = objective != Objective::CriticalSpeed || sample.value < 0.0;
    let bottom = Bottom { sample, curvature };
    (usable && work.accepts(&bottom.sample.climb)).then(|| answer(objective, bottom))
}

fn answer(objective: Objective, bottom: Bottom) -> Answer {
    Answer {
        height: Some(Tangent { at: bottom.sample.at, curvature: bottom.curvature }),
        mass: bottom.sample.mass,
        ..Answer::new(objective, bottom.sample.climb)
    }
}

/// The heights the centre can have: outer bounds, so that none is missed.
fn height_range(work: &Work) -> Result<[f64; 2], Box<Climb>> {
    let end = |sense: f64| {
        let programme = Programme::top_height(&work.reach, sense);
        let climb =
            work.climb(Stage::HeightRange, &programme, programme.cold_start(&work.reach), RANGE_TOLERANCE);
        match climb.end {
            End::Infeasible(_) | End::Cancelled => Err(Box::new(climb)),
            _ => Ok(sense * climb.best.bound),
        }
    };
    Ok([end(1.0)?.max(0.0), end(-1.0)?])
}

/// The lowest of all valleys over the range.
fn lowest(work: &Work, objective: Objective, [low, high]: [f64; 2]) -> Option<Bottom> {
    let samples = look_over(work, objective, [low, high])?;
    let bottoms = Valley::all_between(low, high, &samples).into_iter().filter_map(|valley| {
        valley.bottom(|height, near| {
            sample_at(work, objective, height, near.map(|sample| (&sample.climb.best.point, sample.mass)))
        })
    });
    bottoms.min_by(|a, b| a.sample.value.total_cmp(&b.sample.value))
}

/// A coarse look at heights spread evenly over the range, ascending.
fn look_over(work: &Work, objective: Objective, [low, high]: [f64; 2]) -> Option<Vec<Sample>> {
    let count = work.settings.heights.max(2);
    let mut samples: Vec<Sample> = Vec::with_capacity(count);
    for i in 0..count {
        let height = low + (high - low) * (i as f64 + 0.5) / count as f64;
        let near = samples.last().map(|sample| (&sample.climb.best.point, sample.mass));
        samples.extend(sample_within(work, objective, height, near, LOOK_TOLERANCE));
        if work.is_cancelled() {
            return None;
        }
    }
    Some(samples)
}

/// A dual point to start from, and the mass it belongs to.
type Start<'a> = Option<(&'a DualPoint, Option<f64>)>;

fn sample_at(work: &Work, objective: Objective, height: f64, near: Start) -> Option<Sample> {
    sample_within(work, objective, height, near, 0.0)
}

/// The objective at a height, and its slope by the envelope theorem: −λ_ℓ s₁/(e·s) for the ratio itself.
fn sample_within(
    work: &Work,
    objective: Objective,
    height: f64,
    near: Start,
    tolerance: f64,
) -> Option<Sample> {
    if let Objective::SpinIt { gamma_c, .. } = objective
        && gamma_c > 0.0
    {
        return lightest_enough(work, objective, height, near, tolerance);
    }
    let programme = programme_at(work, objective, height);
    let climb = climb_at(work, &programme, height, near.map(|(point, _)| point), tolerance)?;
    let (value, slope) = (climb.best.value, height_slope(&climb));
    let squared = matches!(objective, Objective::SpinIt { .. });
    let chain = if squared { 2.0 * value } else { 1.0 };
    let value = if squared { value * value } else { value };
    Some(Sample { at: height, value, slope: chain * slope, climb, mass: None })
}

fn programme_at(work: &Work, objective: Objective, height: f64) -> Programme {
    match objective {
        Objective::SpinIt { .. } => Programme::top_functional(&work.reach, height, None),
        Objective::Dominance => Programme::top_dominance(&work.reach, height),
        _ => Programme::top_critical_speed(&work.reach, height),
    }
}

fn climb_at(
    work: &Work,
    programme: &Programme,
    height: f64,
    near: Option<&DualPoint>,
    tolerance: f64,
) -> Option<Climb> {
    let start = programme.start_near(&work.reach, near);
    let climb = work.climb(Stage::AtHeight { height_mm: work.to_mm(height) }, programme, start, tolerance);
    (!matches!(climb.end, End::Infeasible(_) | End::Cancelled)).then_some(climb)
}

/// The derivative of the ratio by the height.
fn height_slope(climb: &Climb) -> f64 {
    -climb.best.point.lambda[HEIGHT_ROW] * climb.best.extreme.s[index::ONE] / climb.best.denominator
}

/// Which row of a top's programme fixes the height, and which the mass.
const HEIGHT_ROW: usize = 4;
const MASS_ROW: usize = 5;

/// Spin-It's functional at a height, least over the mass: between the lightest interior and the one whose inertia
/// alone is best, beyond which both terms grow.
fn lightest_enough(
    work: &Work,
    objective: Objective,
    height: f64,
    near: Start,
    tolerance: f64,
) -> Option<Sample> {
    let free = Programme::top_functional(&work.reach, height, None);
    let heaviest = climb_at(work, &free, height, None, tolerance)?.best.extreme.s[index::ONE];
    let lightest = Programme::top_lightest(height);
    let lightest = climb_at(work, &lightest, height, None, RANGE_TOLERANCE)?.best.bound;
    let mut start = near.map(|(point, _)| point.clone());
    let bottom = Valley::unknown(lightest, heaviest).bottom(|mass, _| {
        let sample = sample_at_mass(work, objective, [height, mass], start.as_ref(), tolerance)?;
        start = Some(sample.climb.best.point.clone());
        Some(sample)
    })?;
    let mass = bottom.sample.at;
    let slope = functional_slopes(work, objective, [height, mass], &bottom.sample.climb)[0];
    Some(Sample { at: height, slope, mass: Some(mass), ..bottom.sample })
}

fn sample_at_mass(
    work: &Work,
    objective: Objective,
    [height, mass]: [f64; 2],
    near: Option<&DualPoint>,
    tolerance: f64,
) -> Option<Sample> {
    let programme = Programme::top_functional(&work.reach, height, Some(mass));
    let stage =
        Stage::AtMass { height_mm: work.to_mm(height), volume_mm3: mass * work.reach.scale.volume_mm3 };
    let climb = work.climb(stage, &programme, programme.start_near(&work.reach, near), tolerance);
    if matches!(climb.end, End::Infeasible(_) | End::Cancelled) {
        return None;
    }
    let value = functional(work, objective, &climb.best.extreme.s, climb.best.value);
    let slope = functional_slopes(work, objective, [height, mass], &climb)[1];
    Some(Sample { at: mass, value, slope, climb, mass: Some(mass) })
}

/// The derivatives of Spin-It's functional by the height and by the mass.
fn functional_slopes(work: &Work, objective: Objective, [height, mass]: [f64; 2], climb: &Climb) -> [f64; 2] {
    let Objective::SpinIt { gamma_c, gamma_i } = objective else { return [0.0; 2] };
    let lever = work.reach.scale.moments_to_units(&work.goal.solid)[index::Z];
    let lowering = 2.0 * gamma_c * height * mass / (lever * lever);
    let chain = 2.0 * gamma_i * climb.best.value;
    let by_mass = -climb.best.point.lambda[MASS_ROW] / climb.best.denominator;
    [lowering * mass + chain * height_slope(climb), lowering * height + chain * by_mass]
}

/// Whether some speed is enough for the interior of a sample.
fn is_stable(work: &Work, sample: &Sample) -> bool {
    let programme = Programme::top_critical_speed(&work.reach, sample.at);
    programme.numerator_at(&sample.climb.best.extreme.s) < 0.0
}

/// The least critical speed where what was asked for is not stable.
fn solve_stable(work: &Work, range: [f64; 2], asked: Bottom) -> Answer {
    match lowest(work, Objective::CriticalSpeed, range) {
        Some(bottom) if bottom.sample.value < 0.0 => {
            with_cover(work, range, answer(Objective::CriticalSpeed, bottom))
        }
        Some(bottom) => unstable(work, range, bottom),
        None => answer(Objective::CriticalSpeed, asked),
    }
}

/// No height has a stable interior: the least I_b/I_c over all of them is the number that says so.
fn unstable(work: &Work, range: [f64; 2], fallback: Bottom) -> Answer {
    let bottom = lowest(work, Objective::Dominance, range).unwrap_or(fallback);
    let answer = with_cover(work, range, answer(Objective::Dominance, bottom));
    let tried = answer.climb.best.bound;
    let proved = answer.bound_over_heights.filter(|&bound| bound >= 1.0);
    let least_ratio = proved.unwrap_or(tried);
    answer.with_verdict(Status::UnstableForEveryInterior { least_ratio, proved: proved.is_some() })
}

/// The answer, with a bound over every height of the range where one can be proved.
fn with_cover(work: &Work, range: [f64; 2], answer: Answer) -> Answer {
    let best = answer.climb.best.bound;
    let Some(relaxation) = relaxation(answer.objective) else { return answer };
    let target = best - COVER_RATIO * best.abs();
    // Where 1 decides, a ratio just above it is compared with 1 itself.
    let target =
        if answer.objective == Objective::Dominance && best > 1.0 { target.max(1.0) } else { target };
    let cover =
        Cover { relaxation, target, programme_at: &|height| programme_at(work, answer.objective, height) };
    let bound_over_heights = cover.holds_over(work, range, &answer.climb.best.point).then_some(target);
    Answer { bound_over_heights, ..answer }
}

/// What a run that was stopped on the way shows: the solid itself.
fn stopped(work: &Work, objective: Objective, [low, high]: [f64; 2]) -> Answer {
    let programme = programme_at(work, objective, 0.5 * (low + high));
    let start = programme.cold_start(&work.reach);
    Answer::new(objective, work.climb(Stage::Goal, &programme, start, 0.0))
}
