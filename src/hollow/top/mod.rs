//! The top: the best height of the centre, whether any is stable, and the proof over all of them.

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
use self::posts::{Post, hold};
use self::valley::Start;
use self::valley::{Bottom, Sample, Valley};
use self::weighed::Weighed;
use crate::goal::Objective;
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::ascent::Climb;
use crate::hollow::dual::programme::Programme;
use crate::hollow::dual::units::index;
use crate::hollow::dual::work::Work;
use crate::hollow::solution::Warm;
use crate::hollow::status::Status;

/// By how much of the value another height might still be better than the bound over all heights
/// says. A hundredth of it costs a quarter more posts; below 1e-8 the bottom itself is not known
/// well enough.
const COVER_RATIO: f64 = 5e-7;
/// How often a better valley may be found by the proof that there is none.
const MOST_VALLEYS: usize = 16;
/// Plans of a proof that may fail before it is made on all columns. The second claims so much less
/// that few fail.
const MOST_PLANS: usize = 2;
/// Looks at all columns after which a scout is not asked again. Three are the rule.
const MOST_LOOKS: usize = 8;

/// The best interior of a top, or the proof that no interior makes it stable.
pub(crate) fn solve(work: &Work, objective: Objective) -> Answer {
    scouted(work, objective).unwrap_or_else(|| from_nothing(work, objective))
}

/// The same by way of a scout. None where there is none, or where what it saw does not hold: then
/// all is to be asked of all columns.
fn scouted(work: &Work, objective: Objective) -> Option<Answer> {
    let scout = work.scout()?;
    let heights = Heights {
        work,
        objective,
        range: Heights::scouted_range(work, &scout)?,
    };
    let rough = Heights {
        work: &scout,
        ..heights
    };
    let solid = &work.reach.solid;
    let seen = rough
        .bottom_from(solid[index::Z] / solid[index::ONE])?
        .warm();
    let (bottom, scout) = looked_up(&heights, scout, seen)?;
    let bound_over_heights = Some(planned(&heights, scout, &bottom)?);
    Some(
        Found {
            bottom,
            bound_over_heights,
        }
        .answer(objective),
    )
}

/// The bottom of the valley near what a scout has seen: each look at all columns mends the scout's
/// for the next, until there is nothing to be gained by another height and Newton's method ends it.
/// With the scout as mended there.
fn looked_up<'a>(
    heights: &Heights,
    mut scout: Work<'a>,
    mut seen: Warm,
) -> Option<(Bottom, Work<'a>)> {
    let mut course = Vec::new();
    for _ in 0..MOST_LOOKS {
        let (height, lever) = (seen.height?, seen.lever);
        let programme = heights.programme_at(height.at, lever);
        let here = heights.work.look(&programme, seen.point);
        scout = scout.mended(&here);
        let at = |climb: Climb| heights.bottom_of(height, lever, climb);
        if heights.is_level(&at(Climb::of(here.clone()))) {
            let bottom = at(heights
                .work
                .climb_from(&programme, here.clone())
                .after(&course));
            if heights.work.accepts(&bottom.sample.climb) && heights.is_level(&bottom) {
                let scout = scout.mended(&bottom.sample.climb.best);
                return is_stable(heights.work, &bottom.sample).then_some((bottom, scout));
            }
        }
        course.push(here.pass());
        let mended = Heights {
            work: &scout,
            ..*heights
        };
        seen = mended
            .bottom(
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

/// A bound just below the bottom of a valley that holds at every height, by posts that a scout
/// finds and all columns bear.
fn planned(heights: &Heights, mut scout: Work, bottom: &Bottom) -> Option<f64> {
    for _ in 0..MOST_PLANS {
        let (bound, proof) = proof(
            &Heights {
                work: &scout,
                ..*heights
            },
            bottom,
        );
        if hold(heights.work, &proof.ok()?) {
            return Some(bound);
        }
        scout = scout.doubly_prudent();
    }
    None
}

fn from_nothing(work: &Work, objective: Objective) -> Answer {
    let heights = match Heights::new(work, objective) {
        Ok(heights) => heights,
        Err(climb) => return Answer::new(objective, *climb),
    };
    let Some(found) = lowest(&heights) else {
        return heights.given_up();
    };
    if is_stable(work, &found.bottom.sample) {
        return found.answer(objective);
    }
    match objective {
        Objective::CriticalSpeed => unstable(heights, found),
        _ => from_nothing(work, Objective::CriticalSpeed),
    }
}

/// The same search near a known answer, in a few passes: its dual point, height and curvature are
/// aimed by. None where the ground has changed too much for that.
pub(crate) fn refine(work: &Work, objective: Objective, warm: &Warm) -> Option<Answer> {
    let hint = warm.height?;
    let heights = Heights {
        work,
        objective,
        range: [0.5 * hint.at, 2.0 * hint.at],
    };
    let looked = work
        .scout()
        .and_then(|scout| looked_up(&heights, scout, warm.clone()));
    let bottom = match looked {
        Some((bottom, _)) => bottom,
        None => heights.bottom(
            Valley::near(hint),
            Some(Start {
                point: &warm.point,
                lever: warm.lever,
            }),
        )?,
    };
    let usable = is_stable(work, &bottom.sample) && work.accepts(&bottom.sample.climb);
    usable.then(|| {
        Found {
            bottom,
            bound_over_heights: None,
        }
        .answer(objective)
    })
}

/// A lower bound of the ratio over all heights and levers, proved on all columns near a known
/// answer; none where that does not succeed.
pub(crate) fn bound_near(work: &Work, objective: Objective, warm: &Warm) -> Option<f64> {
    let scout = work.scout()?;
    let heights = Heights {
        work,
        objective,
        range: Heights::scouted_range(work, &scout)?,
    };
    let height = warm.height?;
    let here = work.look(
        &heights.programme_at(height.at, warm.lever),
        warm.point.clone(),
    );
    let scout = scout.mended(&here);
    planned(
        &heights,
        scout,
        &heights.bottom_of(height, warm.lever, Climb::of(here)),
    )
}

/// The lowest valley, and what is proved of all the others.
struct Found {
    bottom: Bottom,
    bound_over_heights: Option<f64>,
}

impl Found {
    fn answer(self, objective: Objective) -> Answer {
        Answer {
            height: Some(self.bottom.tangent()),
            lever: self.bottom.sample.lever,
            bound_over_heights: self.bound_over_heights,
            ..Answer::new(objective, self.bottom.sample.climb)
        }
    }
}

/// The lowest of all valleys: down into one, then the proof that there is no lower one, which finds
/// it if there is.
fn lowest(heights: &Heights) -> Option<Found> {
    let solid = &heights.work.reach.solid;
    let mut bottom = heights.bottom_from(solid[index::Z] / solid[index::ONE])?;
    for _ in 0..MOST_VALLEYS {
        let (bound, proof) = proof(heights, &bottom);
        match proof {
            Ok(_) => {
                return Some(Found {
                    bottom,
                    bound_over_heights: Some(bound),
                });
            }
            Err(Doubt::Open) => break,
            Err(Doubt::Refuted(height)) => match heights.bottom_from(height) {
                Some(lower) if lower.sample.value < bottom.sample.value => bottom = lower,
                _ => break,
            },
        }
    }
    Some(Found {
        bottom,
        bound_over_heights: None,
    })
}

/// A bound just below the bottom of a valley, and the posts that prove it at every height.
fn proof(heights: &Heights, bottom: &Bottom) -> (f64, Result<Vec<Post>, Doubt>) {
    let best = &bottom.sample.climb.best;
    let Some(weighed) = Weighed::of(heights.objective, heights.work) else {
        let target = target_below(heights.objective, best.bound);
        return (target, Cover::of_all(heights, target).proof(bottom));
    };
    let target = bottom.sample.value * (1.0 - COVER_RATIO);
    // As the ratio with which the interior at hand would have this value.
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
        .proof(bottom),
    )
}

/// What is claimed of all heights where the bottom of one valley is this low.
fn target_below(objective: Objective, best: f64) -> f64 {
    let target = best - COVER_RATIO * best.abs();
    // Where 1 decides, a ratio just above it is compared with 1 itself.
    let decides = objective == Objective::Dominance && best > 1.0;
    if decides { target.max(1.0) } else { target }
}

/// Whether some speed is enough for the interior of a sample.
fn is_stable(work: &Work, sample: &Sample) -> bool {
    let best = &sample.climb.best;
    let height = best.center_height();
    Programme::top_critical_speed(&work.reach, height, [height; 2]).numerator_at(&best.extreme.s)
        < 0.0
}

/// No height has a stable interior: the least I_b/I_c over all of them is the number that says so.
fn unstable(heights: Heights, tried: Found) -> Answer {
    let heights = Heights {
        objective: Objective::Dominance,
        ..heights
    };
    let answer = lowest(&heights)
        .unwrap_or(tried)
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
                let by_scout = scouted(work, objective).expect("the egg has columns enough");
                let alone = from_nothing(work, objective);
                let [one, other] = [&by_scout, &alone].map(|answer| answer.climb.best.value);
                // Two heights within the bottom's precision of 1e-8 of the value differ by so much
                // in it.
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
                let (heights, bottom, scout) = ready(work, objective);
                let posts = proof(
                    &Heights {
                        work: &scout,
                        ..heights
                    },
                    &bottom,
                )
                .1
                .expect("the claim is true");
                assert!(hold(work, &posts));
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
            let (heights, bottom, scout) = ready(work, Objective::CriticalSpeed);
            let mut posts = proof(
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
            assert!(!hold(work, &posts));
        });
    }

    /// The heights, the bottom of the valley, and a scout as mended there.
    fn ready<'a>(work: &'a Work<'a>, objective: Objective) -> (Heights<'a>, Bottom, Work<'a>) {
        let scout = work.scout().expect("the egg has columns enough");
        let range = Heights::scouted_range(work, &scout).expect("the egg can be balanced");
        let heights = Heights {
            work,
            objective,
            range,
        };
        let seen = Heights {
            work: &scout,
            ..heights
        }
        .bottom_from(range[1])
        .expect("there is a valley");
        let (bottom, scout) = looked_up(&heights, scout, seen.warm()).expect("it is stable");
        (heights, bottom, scout)
    }
}
