//! The proof over every height: finitely many intervals, in each of which no interior is better.

use super::heights::Heights;
use super::posts::{Post, Stake};
use super::valley::Bottom;
use crate::hollow::dual::ascent::End;
use crate::hollow::dual::programme::DualPoint;
use crate::hollow::dual::visit::{Slack, Visit};
use crate::hollow::log::Stage;

/// Limit on the posts; a smooth valley takes about twenty.
const MOST_POSTS: usize = 400;
/// Share of a margin that is not worth another pass. A fifth of it doubles the passes per post and
/// saves a tenth of the posts.
const MARGIN_SLACK: f64 = 0.5;
/// Multiple of the expected margin that suffices. If no interior is possible there, the margin
/// grows without bound, and so do the multipliers.
const CONTENT_RATIO: f64 = 4.0;
/// Longest extrapolation of the multipliers, in steps. Beyond, the last multipliers are better than
/// their line.
const FARTHEST_AHEAD: f64 = 4.0;
/// First guess of a post's reach, as a part of its distance from the bottom.
const FIRST_REACH: f64 = 0.6;
/// Share of the predicted reach that is relied on. With a share nearer to one, posts miss the edge
/// that they have to overlap.
const COUNTED_REACH: f64 = 0.85;

/// The claim that no interior has a ratio below `target`, whatever the height of its centre.
///
/// Let the tensor be linear at ℓ, and let an interior have its centre at h. Since s_z²/s₁ = 2ℓs_z −
/// ℓ²s₁ + s₁(h − ℓ)², its true numerator is smaller than the linear one by κs₁(h − ℓ)². This holds
/// for any weights y of the dual; κ = 1 for λ_max. Suppose that every interior has
///
/// ```text
/// n_ℓ·s + max yᵀJ_ℓs − target·e·s ≥ δ s₁
/// ```
///
/// This is one more quasi-convex programme, with a bound from any dual point. Then no interior with
/// its centre within √(δ/κ) of ℓ is below the target. Such a *post* at ℓ needs no row for the
/// height.
///
/// Let T have its bottom at ℓ* with curvature c. Then δ ≈ ½c(ℓ − ℓ*)², so a post's reach grows with
/// its distance from the bottom. A precision of ε takes about log(1/ε) posts, not 1/√ε.
pub(crate) struct Cover<'a> {
    pub heights: &'a Heights<'a>,
    pub target: f64,
    /// Lever of the interiors in the claim; `None` if it covers all levers.
    pub lever: Option<f64>,
    /// Share of a post's margin that has to remain at the end of its reach.
    pub level_ratio: f64,
}

/// The reason a claim was not proved.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Doubt {
    /// An interior below the target has its centre at this height.
    Refuted(f64),
    /// The proof was not completed.
    Open,
}

impl<'a> Cover<'a> {
    /// Returns the claim about interiors of any lever.
    pub fn of_all(heights: &'a Heights<'a>, target: f64) -> Self {
        Self {
            heights,
            target,
            lever: None,
            level_ratio: 0.0,
        }
    }

    /// Finds the posts that prove the claim at every height of the range, from the bottom of a
    /// valley up and down.
    pub fn prove(&self, bottom: &Bottom) -> Result<Vec<Post>, Doubt> {
        let best = &bottom.sample.climb.best;
        let margin = (best.bound - self.target) * best.denominator / best.mass();
        let start = DualPoint {
            tau: margin,
            ..best.point.clone()
        };
        self.posts(bottom.sample.at, start)
    }

    /// Finds the posts of a claim. The first is at `height`, which is best placed at the least
    /// margin.
    pub fn posts(&self, height: f64, start: DualPoint) -> Result<Vec<Post>, Doubt> {
        let middle = self.post(height, start)?;
        let [low, high] = self.heights.range;
        let up = self.march(&middle, None, high)?;
        let down = self.march(&middle, up.first(), low)?;
        Ok(std::iter::once(middle).chain(up).chain(down).collect())
    }

    /// Places posts from the middle one to an end of the range, each overlapping the one before.
    fn march(&self, middle: &Post, other: Option<&Post>, end: f64) -> Result<Vec<Post>, Doubt> {
        let side = (end - middle.at).signum();
        let (mut edge, mut reach_ratio) = (middle.reach, FIRST_REACH);
        let (mut posts, mut before, mut last) = (Vec::new(), other.cloned(), middle.clone());
        for _ in 0..MOST_POSTS {
            if edge >= (end - middle.at) * side {
                return Ok(posts);
            }
            let distance = edge / (1.0 - COUNTED_REACH * reach_ratio);
            let at = middle.at + side * distance;
            let margin = margin_at(&last, (middle.at, at), reach_ratio);
            let post = self.post(at, extrapolate(&last, before.as_ref(), at, margin))?;
            reach_ratio = (post.reach / distance).min(1.0);
            if distance - post.reach <= edge {
                edge = edge.max(distance + post.reach);
                posts.push(post.clone());
            }
            before = Some(std::mem::replace(&mut last, post));
        }
        Err(Doubt::Open)
    }

    /// Places a post at a height; fails if its margin is not positive.
    fn post(&self, at: f64, start: DualPoint) -> Result<Post, Doubt> {
        let work = self.heights.work;
        let mut programme = self.heights.programme(at);
        if let Some(lever) = self.lever {
            programme = programme.with_lever(&work.reach, lever);
        }
        let mut programme = programme.margin(&work.reach, self.target);
        programme.stage = Stage::Cover {
            height_mm: work.to_mm(at),
        };
        let enough = if start.tau > 0.0 {
            CONTENT_RATIO * start.tau
        } else {
            f64::INFINITY
        };
        let slack = Slack {
            share: MARGIN_SLACK,
            enough,
        };
        let climb = work.climb_to_bound(&programme, start, slack);
        if matches!(climb.end, End::Infeasible(_) | End::Cancelled) {
            return Err(Doubt::Open);
        }
        let margin = work.prudence.map_or(climb.best.bound, |prudence| {
            prudence.claim(climb.best.bound)
        });
        if margin <= 0.0 {
            return Err(self.doubt_about(&climb.best));
        }
        let weight = self.heights.weight(&climb.best.point).max(0.0);
        let reach = ((1.0 - self.level_ratio) * margin / weight).sqrt();
        let point = DualPoint {
            tau: margin,
            ..climb.best.point
        };
        let stake = Stake::of(&programme, &point);
        Ok(Post {
            at,
            margin,
            reach,
            point,
            stake,
        })
    }

    /// Returns the reason for a margin that is not positive: an interior below the target, or an
    /// open question.
    fn doubt_about(&self, best: &Visit) -> Doubt {
        let is_below =
            best.value < 0.0 && best.residual() <= self.heights.work.settings.accepted_residual;
        if is_below {
            Doubt::Refuted(best.center_height())
        } else {
            Doubt::Open
        }
    }
}

/// Predicts the margin at a place from the post before. It grows with the square of the distance
/// from the middle.
fn margin_at(last: &Post, (middle, at): (f64, f64), reach_ratio: f64) -> f64 {
    let distance = at - middle;
    if last.at == middle {
        return (reach_ratio * distance).powi(2).max(last.margin);
    }
    last.margin * (distance / (last.at - middle)).powi(2)
}

/// Extrapolates the dual point along the line through the last two posts.
fn extrapolate(last: &Post, before: Option<&Post>, at: f64, margin: f64) -> DualPoint {
    let mut point = DualPoint {
        tau: margin,
        ..last.point.clone()
    };
    if let Some(before) = before {
        let ahead = ((at - last.at) / (last.at - before.at)).clamp(-FARTHEST_AHEAD, FARTHEST_AHEAD);
        point.y += (&last.point.y - &before.point.y) * ahead;
        point.lambda += (&last.point.lambda - &before.point.lambda) * ahead;
        let length = point.y.norm();
        if length > 1.0 {
            point.y /= length;
        }
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::goal::Objective;
    use crate::hollow::dual::work::Work;
    use crate::hollow::{Settings, worlds};

    #[test]
    fn a_true_claim_is_proved_and_a_false_one_is_refuted() {
        for objective in [
            Objective::CriticalSpeed,
            Objective::Dominance,
            Objective::SpinIt {
                gamma_c: 0.0,
                gamma_i: 1.0,
            },
        ] {
            let world = worlds::egg_on_its_side(objective);
            let (settings, watch, problem) =
                (Settings::default(), Watch::silent(), world.problem());
            let work = Work::new(&problem, &settings, &watch);
            let heights = Heights::new(&work, objective).unwrap();
            let bottom = heights.find_bottom_from(heights.range[1]).unwrap();
            let best = bottom.sample.climb.best.value;
            for (worse, expected) in [
                (-1e-1, true),
                (-1e-3, true),
                (-1e-6, true),
                (1e-3, false),
                (1e-1, false),
            ] {
                let cover = Cover::of_all(&heights, best + worse * best.abs());
                let proof = cover.prove(&bottom);
                assert_eq!(proof.is_ok(), expected, "{objective:?} {worse}: {proof:?}");
            }
        }
    }
}
