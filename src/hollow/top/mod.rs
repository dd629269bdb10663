//! The top: the best height of its centre, its stability, and the proof over all heights.

pub(crate) mod course;
mod cover;
mod frontier;
pub(crate) mod heights;
mod lever;
mod posts;
mod search;
mod valley;
mod weighed;

use self::cover::{Cover, Doubt};
use self::frontier::Frontier;
use self::heights::Heights;
use self::posts::{Post, check_posts};
use self::valley::Start;
use self::valley::{Bottom, Sample, Valley};
use self::weighed::Weighed;
use crate::goal::Objective;
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::ascent::Climb;
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::units::index;
use crate::hollow::dual::work::Work;
use crate::hollow::solution::Warm;
use crate::hollow::status::Status;

/// Part of the value by which another height might still beat the answer. A hundredth of it costs a
/// quarter more posts. Below 1e-8 the bottom itself is not known well enough.
const COVER_RATIO: f64 = 5e-7;
/// Limit on how often the proof may find a lower valley.
const MOST_VALLEYS: usize = 16;
/// Limit on the proofs planned with a scout that fail on all columns. The second claims so much
/// less that few fail.
const MOST_PLANS: usize = 2;
/// Limit on the passes over all columns that mend a scout; three are typical.
const MOST_LOOKS: usize = 8;

/// Finds the best interior of a top, or the proof that no interior makes it stable.
pub(crate) fn solve(work: &Work, objective: Objective) -> Answer {
    solve_with_scout(work, objective).unwrap_or_else(|| solve_cold(work, objective))
}

/// Solves with a scout. `None` if there is none, or if its result does not hold on all columns;
/// then the search needs all columns.
fn solve_with_scout(work: &Work, objective: Objective) -> Option<Answer> {
    let scout = work.scout()?;
    let heights = Heights {
        work,
        objective,
        range: Heights::range_from_scout(work, &scout)?,
    };
    let rough = Heights {
        work: &scout,
        ..heights
    };
    let solid = &work.reach.solid;
    let guess = rough
        .find_bottom_from(solid[index::Z] / solid[index::ONE])?
        .warm();
    let (bottom, scout) = find_bottom(&heights, scout, guess)?;
    let bound_over_heights = Some(prove_with_scout(&heights, scout, &bottom)?.0);
    Some(
        Lowest {
            bottom,
            bound_over_heights,
        }
        .answer(objective),
    )
}

/// Finds the bottom of the valley near a scout's result; returns it with the scout mended there.
///
/// Each pass over all columns mends the scout for its next search. Once no other height promises a
/// gain, Newton's method on all columns finishes.
fn find_bottom<'a>(
    heights: &Heights,
    mut scout: Work<'a>,
    mut guess: Warm,
) -> Option<(Bottom, Work<'a>)> {
    let mut course = Vec::new();
    for _ in 0..MOST_LOOKS {
        let (height, lever) = (guess.height?, guess.lever);
        let programme = heights.programme_at(height.at, lever);
        let here = heights.work.evaluate(&programme, guess.point);
        scout = scout.mend_at(&here);
        let at = |climb: Climb| heights.bottom_of(height, lever, climb);
        if heights.is_level(&at(Climb::of(here.clone()))) {
            let bottom = at(heights
                .work
                .climb_from(&programme, here.clone())
                .after(&course));
            if heights.work.accepts(&bottom.sample.climb) && heights.is_level(&bottom) {
                let scout = scout.mend_at(&bottom.sample.climb.best);
                return is_stable(heights.work, &bottom.sample).then_some((bottom, scout));
            }
        }
        course.push(here.pass());
        let mended = Heights {
            work: &scout,
            ..*heights
        };
        guess = mended
            .find_bottom(
                Valley::near(height),
                Some(Start {
                    point: &here.point,
                    lever,
                }),
            )?
            .warm();
    }
    None
}

/// Proves a bound just below the bottom of a valley for every height. A scout finds the posts; all
/// columns check them.
fn prove_with_scout(
    heights: &Heights,
    mut scout: Work,
    bottom: &Bottom,
) -> Option<(f64, Vec<Post>)> {
    for _ in 0..MOST_PLANS {
        let (bound, proof) = prove(
            &Heights {
                work: &scout,
                ..*heights
            },
            bottom,
        );
        let posts = proof.ok()?;
        if check_posts(heights.work, &posts) {
            return Some((bound, posts));
        }
        scout = scout.with_double_prudence();
    }
    None
}

fn solve_cold(work: &Work, objective: Objective) -> Answer {
    let heights = match Heights::new(work, objective) {
        Ok(heights) => heights,
        Err(climb) => return Answer::new(objective, *climb),
    };
    let Some(lowest) = find_lowest(&heights) else {
        return heights.report_failure();
    };
    if is_stable(work, &lowest.bottom.sample) {
        return lowest.answer(objective);
    }
    match objective {
        Objective::CriticalSpeed => report_instability(heights, lowest),
        _ => solve_cold(work, Objective::CriticalSpeed),
    }
}

/// Searches near a known answer, in a few passes, from its dual point, height and curvature. `None`
/// if the problem has changed too much.
pub(crate) fn refine(work: &Work, objective: Objective, warm: &Warm) -> Option<Answer> {
    let hint = warm.height?;
    let heights = Heights {
        work,
        objective,
        range: [0.5 * hint.at, 2.0 * hint.at],
    };
    let scouted = work
        .scout()
        .and_then(|scout| find_bottom(&heights, scout, warm.clone()));
    let bottom = match scouted {
        Some((bottom, _)) => bottom,
        None => heights.find_bottom(
            Valley::near(hint),
            Some(Start {
                point: &warm.point,
                lever: warm.lever,
            }),
        )?,
    };
    let usable = is_stable(work, &bottom.sample) && work.accepts(&bottom.sample.climb);
    usable.then(|| {
        Lowest {
            bottom,
            bound_over_heights: None,
        }
        .answer(objective)
    })
}

/// The proof of a bound at all heights, as dual points.
pub(crate) struct Proved {
    /// The lower bound of the ratio.
    pub bound: f64,
    /// The posts.
    pub posts: Vec<Post>,
    /// The dual points of the least and the greatest height.
    pub ends: [DualPoint; 2],
}

/// Proves a lower bound of the ratio over all heights and levers, on all columns, near a known
/// answer. `None` if the proof fails.
pub(crate) fn prove_bound_near(work: &Work, objective: Objective, warm: &Warm) -> Option<Proved> {
    let scout = work.scout()?;
    let ends = Heights::ends_from_scout(&scout)?;
    let heights = Heights {
        work,
        objective,
        range: Heights::range_of(work, &ends)?,
    };
    let height = warm.height?;
    let here = work.evaluate(
        &heights.programme_at(height.at, warm.lever),
        warm.point.clone(),
    );
    let scout = scout.mend_at(&here);
    let bottom = heights.bottom_of(height, warm.lever, Climb::of(here));
    let (bound, posts) = prove_with_scout(&heights, scout, &bottom)?;
    Some(Proved { bound, posts, ends })
}

/// The lowest valley, and the bound proved for all others.
struct Lowest {
    bottom: Bottom,
    bound_over_heights: Option<f64>,
}

impl Lowest {
    fn answer(self, objective: Objective) -> Answer {
        Answer {
            height: Some(self.bottom.tangent()),
            lever: self.bottom.sample.lever,
            bound_over_heights: self.bound_over_heights,
            ..Answer::new(objective, self.bottom.sample.climb)
        }
    }
}

/// Finds the lowest valley: descends into one, then proves that none is lower. A failed proof gives
/// the next start.
fn find_lowest(heights: &Heights) -> Option<Lowest> {
    let solid = &heights.work.reach.solid;
    let mut bottom = heights.find_bottom_from(solid[index::Z] / solid[index::ONE])?;
    for _ in 0..MOST_VALLEYS {
        let (bound, proof) = prove(heights, &bottom);
        match proof {
            Ok(_) => {
                return Some(Lowest {
                    bottom,
                    bound_over_heights: Some(bound),
                });
            }
            Err(Doubt::Open) => break,
            Err(Doubt::Refuted(height)) => match heights.find_bottom_from(height) {
                Some(lower) if lower.sample.value < bottom.sample.value => bottom = lower,
                _ => break,
            },
        }
    }
    Some(Lowest {
        bottom,
        bound_over_heights: None,
    })
}

/// Returns a bound just below the bottom of a valley, and the posts that prove it at every height.
fn prove(heights: &Heights, bottom: &Bottom) -> (f64, Result<Vec<Post>, Doubt>) {
    let best = &bottom.sample.climb.best;
    let Some(weighed) = Weighed::of(heights.objective, heights.work) else {
        let target = target_below(heights.objective, best.bound);
        return (target, Cover::of_all(heights, target).prove(bottom));
    };
    let target = bottom.sample.value * (1.0 - COVER_RATIO);
    // The ratio at which the current interior would have this value.
    let bound = ((target - weighed.lever * best.lever().powi(2)) / weighed.inertia)
        .max(0.0)
        .sqrt();
    (
        bound,
        Frontier {
            heights,
            weighed,
            target,
        }
        .prove(bottom),
    )
}

/// Returns the bound to claim for all heights, given the lowest bottom.
fn target_below(objective: Objective, best: f64) -> f64 {
    let target = best - COVER_RATIO * best.abs();
    // If 1 is the criterion, compare a ratio just above 1 with 1 itself.
    let decides = objective == Objective::Dominance && best > 1.0;
    if decides { target.max(1.0) } else { target }
}

/// Returns true if some speed makes the interior of a sample stable.
fn is_stable(work: &Work, sample: &Sample) -> bool {
    let best = &sample.climb.best;
    let height = best.center_height();
    Programme::top_critical_speed(&work.reach, height, [height; 2]).numerator_at(&best.extreme.s)
        < 0.0
}

/// Reports that no height has a stable interior, with the least I_b/I_c over all heights.
fn report_instability(heights: Heights, best_tried: Lowest) -> Answer {
    let heights = Heights {
        objective: Objective::Dominance,
        ..heights
    };
    let answer = find_lowest(&heights)
        .unwrap_or(best_tried)
        .answer(Objective::Dominance);
    let proved = answer.bound_over_heights.filter(|&bound| bound >= 1.0);
    let least_ratio = proved.unwrap_or(answer.climb.best.bound);
    answer.with_verdict(Status::UnstableForEveryInterior {
        least_ratio,
        proved: proved.is_some(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::geom::Quadric;
    use crate::hollow::{Settings, worlds};
    use crate::interior::moments_where_positive;

    const OBJECTIVES: [Objective; 3] = [
        Objective::CriticalSpeed,
        Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        },
        Objective::SpinIt {
            gamma_c: 0.8,
            gamma_i: 1.2,
        },
    ];

    fn with_work(objective: Objective, check: impl Fn(&worlds::World, &Work)) {
        let world = worlds::egg_on_its_side(objective);
        let (settings, watch, problem) = (Settings::default(), Watch::silent(), world.problem());
        check(&world, &Work::new(&problem, &settings, &watch));
    }

    #[test]
    fn what_a_scout_leads_to_is_what_all_columns_find_alone() {
        for objective in OBJECTIVES {
            with_work(objective, |_, work| {
                let by_scout =
                    solve_with_scout(work, objective).expect("the egg has columns enough");
                let alone = solve_cold(work, objective);
                let [one, other] = [&by_scout, &alone].map(|answer| answer.climb.best.value);
                // Heights within the bottom's accuracy, 1e-8 of the value, differ by this much in
                // it.
                assert!(
                    (one - other).abs() < 1e-6 * other.abs(),
                    "{objective:?}: {one} {other}"
                );
            });
        }
    }

    #[test]
    fn every_post_of_a_scout_is_an_inequality_that_all_interiors_meet() {
        for objective in OBJECTIVES {
            with_work(objective, |world, work| {
                let (heights, bottom, scout) = set_up(work, objective);
                let posts = prove(
                    &Heights {
                        work: &scout,
                        ..heights
                    },
                    &bottom,
                )
                .1
                .expect("the claim is true");
                assert!(check_posts(work, &posts));
                for seed in 0..40 {
                    let Quadric(random) = worlds::some_quadric(seed, 12.0);
                    let emptied = moments_where_positive(&world.columns, &Quadric(random));
                    let s = work.reach.scale.moments_to_units(&(world.fixed - emptied));
                    let spare = posts
                        .iter()
                        .map(|post| post.stake.direction.dot(&s) - post.stake.least);
                    assert!(
                        spare.fold(f64::INFINITY, f64::min) >= 0.0,
                        "{objective:?} {seed}"
                    );
                }
            });
        }
    }

    #[test]
    fn posts_that_claim_more_than_there_is_do_not_stand() {
        with_work(Objective::CriticalSpeed, |_, work| {
            let (heights, bottom, scout) = set_up(work, Objective::CriticalSpeed);
            let mut posts = prove(
                &Heights {
                    work: &scout,
                    ..heights
                },
                &bottom,
            )
            .1
            .expect("the claim is true");
            let last = posts.last_mut().expect("there is a post");
            last.stake.direction[index::ONE] -= 0.5 * last.margin;
            assert!(!check_posts(work, &posts));
        });
    }

    /// Returns the heights, the bottom of the valley, and a scout mended there.
    fn set_up<'a>(work: &'a Work<'a>, objective: Objective) -> (Heights<'a>, Bottom, Work<'a>) {
        let scout = work.scout().expect("the egg has columns enough");
        let range = Heights::range_from_scout(work, &scout).expect("the egg can be balanced");
        let heights = Heights {
            work,
            objective,
            range,
        };
        let guess = Heights {
            work: &scout,
            ..heights
        }
        .find_bottom_from(range[1])
        .expect("there is a valley");
        let (bottom, scout) = find_bottom(&heights, scout, guess.warm()).expect("it is stable");
        (heights, bottom, scout)
    }
}
