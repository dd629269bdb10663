//! The proof over every height and lever, for Spin-It's functional with a weighed lever.

use super::cover::{Cover, Doubt};
use super::heights::Heights;
use super::posts::{Post, Stake};
use super::valley::Bottom;
use super::weighed::Weighed;
use crate::hollow::dual::programme::DualPoint;
use crate::hollow::dual::table::LEVER_ROW;
use crate::hollow::dual::units::index;

/// Half the angle of the first side, over the square root of the claim's relative distance from the
/// value.
const FIRST_ANGLE_RATIO: f64 = 0.25;
/// Share of a post's margin that has to remain at the end of its reach, for the sides that meet
/// there. A smaller share takes more sides, a larger one more posts.
const LEVEL_RATIO: f64 = 0.5;
/// Factor by which an angle that was too wide shrinks.
const SHRINKAGE: f64 = 0.5;
/// Widest angle of a side, rad.
const WIDEST: f64 = 0.4;
/// Narrowest angle of a side, rad, at which the attempt ends.
const NARROWEST: f64 = 1e-7;
/// Limit on the sides in one direction.
const MOST_SIDES: usize = 80;

/// The claim that no interior of any height and lever has k s_z² + γ ρ² < V, with ρ the inertia
/// ratio.
///
/// (s_z, ρ) lies outside this ellipse if it lies above a polygon drawn around it. Let (σ₁, t₁) and
/// (σ₂, t₂) be the ends of one of its sides, σ₁ < σ₂. At each end there are the posts of a
/// [`Cover`] with the row s_z = σᵢ and its multiplier aᵢ. For *every* interior whose centre lies at
/// a height h within their reach they prove
///
/// ```text
/// N − tᵢ I_zz ≥ mᵢ s₁ + aᵢ (σᵢ − s_z).
/// ```
///
/// An interior with s_z = (1 − x)σ₁ + xσ₂ has s₁ = s_z/h. By the same mixture of both inequalities
/// it is above the side if
///
/// ```text
/// (1 − x)m₁ + xm₂ ≥ x(1 − x)(σ₂ − σ₁)(a₁ − a₂)h/s_z.
/// ```
///
/// This holds for all x if √m₁ + √m₂ ≥ √((σ₂ − σ₁)(a₁ − a₂)h/σ₁). The loss of the mixture is
/// quadratic in the side's length. The margin m grows with the square of the distance from the best
/// lever. So the number of sides, too, is about the logarithm of the precision.
///
/// Put |t′| = kσ/(γt) at a corner (σ, t). Beyond it, t changes along the ellipse by less than that
/// per unit of lever below σ, and by more above it. So the posts of a corner cover all smaller
/// levers if a is at least |t′| times the greatest I_zz. They cover all greater levers if a is at
/// most |t′| times the least I_zz, plus m/h.
pub(crate) struct Frontier<'a> {
    pub heights: &'a Heights<'a>,
    pub weighed: Weighed,
    /// Claimed value V.
    pub target: f64,
}

/// A corner of the polygon, and the posts on its line.
#[derive(Clone)]
struct Corner {
    lever: f64,
    target: f64,
    posts: Vec<Post>,
}

/// The state of a walk along the polygon.
#[derive(Clone, Copy)]
struct Walk {
    /// Direction: 1 towards smaller levers, −1 towards greater.
    side: f64,
    /// Point of contact of the last side with the ellipse, as an angle from the axis of levers.
    touch: f64,
    /// Angle from there to the last corner; negative before it.
    offset: f64,
}

impl Frontier<'_> {
    /// Finds the posts that prove the claim, starting at the best height and lever.
    pub fn prove(&self, bottom: &Bottom) -> Result<Vec<Post>, Doubt> {
        let sample = &bottom.sample;
        let lever = sample.lever.ok_or(Doubt::Open)?.at;
        let best = &sample.climb.best;
        let touch = (lever / self.greatest()).min(1.0).acos();
        let mut half = FIRST_ANGLE_RATIO * (1.0 - self.target / sample.value).max(0.0).sqrt();
        let stake = Stake {
            direction: best.quadric,
            least: 0.0,
        };
        let point = DualPoint {
            tau: 0.0,
            ..best.point.clone()
        };
        let start = Post {
            at: sample.at,
            margin: 0.0,
            reach: 0.0,
            point,
            stake,
        };
        for _ in 0..MOST_SIDES {
            let ends = [1.0, -1.0].map(|side| self.corner(self.at(touch, side * half), &start));
            let [low, high] = ends;
            let (low, high) = (low?, high?);
            if self.is_above(&low, &high) {
                let left = self.walk(
                    Walk {
                        side: 1.0,
                        touch,
                        offset: half,
                    },
                    (&high, &low),
                )?;
                let right = self.walk(
                    Walk {
                        side: -1.0,
                        touch,
                        offset: half,
                    },
                    (&low, &high),
                )?;
                return Ok([low.posts, high.posts, left, right].concat());
            }
            half *= SHRINKAGE;
        }
        Err(Doubt::Open)
    }

    /// Walks along tangents of the ellipse, from the second of two corners to an end of the
    /// possible levers. Returns the posts of the new corners.
    fn walk(&self, walk: Walk, (before, last): (&Corner, &Corner)) -> Result<Vec<Post>, Doubt> {
        let Walk {
            side,
            mut touch,
            mut offset,
        } = walk;
        let (mut before, mut last, mut posts) = (before.clone(), last.clone(), Vec::new());
        for _ in 0..MOST_SIDES {
            if self.is_end(&last, side) {
                return Ok(posts);
            }
            // A corner beyond its point of contact starts another tangent.
            if offset > 0.0 {
                touch += 2.0 * side * offset;
                offset = -offset;
            }
            let distance = (touch + side * offset - walk.touch).abs();
            let (next, stepped) = self.step(
                Walk {
                    side,
                    touch,
                    offset,
                },
                (&before, &last),
                distance,
            )?;
            posts.extend_from_slice(&next.posts);
            before = std::mem::replace(&mut last, next);
            offset += stepped;
        }
        Err(Doubt::Open)
    }

    /// Finds the next corner on the same tangent, as far as all interiors are above the side to it.
    /// Returns it with its angle.
    fn step(
        &self,
        walk: Walk,
        (before, last): (&Corner, &Corner),
        distance: f64,
    ) -> Result<(Corner, f64), Doubt> {
        let Walk {
            side,
            touch,
            offset,
        } = walk;
        let mut step = self.predict_angle((before, last), distance);
        let mut failed = Doubt::Open;
        while step > NARROWEST {
            let at = self.at(touch, side * (offset + step));
            let fits = |next: &Corner| {
                if side > 0.0 {
                    self.is_above(next, last)
                } else {
                    self.is_above(last, next)
                }
            };
            match self.corner(at, &extrapolate(before, last, at[0])) {
                Ok(next) if fits(&next) => return Ok((next, step)),
                Ok(_) => {}
                Err(doubt) => failed = doubt,
            }
            step *= SHRINKAGE;
        }
        Err(failed)
    }

    /// Predicts the angle at which the next side is just above, from the last margins and
    /// multipliers.
    fn predict_angle(&self, (before, last): (&Corner, &Corner), distance: f64) -> f64 {
        let bend = ((last.multiplier() - before.multiplier()) / (last.lever - before.lever)).abs();
        let loss = (bend * self.heights.range[1] / last.lever).sqrt() * self.greatest();
        let margin = last.level().sqrt();
        let angle = 2.0 * margin / (loss - margin / distance).max(margin / distance);
        angle.min(WIDEST)
    }

    /// Returns true if the claim holds for every interior beyond this corner.
    fn is_end(&self, last: &Corner, side: f64) -> bool {
        let Weighed {
            lever: k,
            inertia: gamma,
        } = self.weighed;
        let fall = k * last.lever / (gamma * last.target);
        let reach = &self.heights.work.reach;
        let [least, greatest] =
            [&reach.shell, &reach.fullest].map(|s| fall * (s[index::XX] + s[index::YY]));
        let covers = |post: &Post| match side {
            1.0 => multiplier(post) >= greatest,
            _ => multiplier(post) <= least + level(post) / self.heights.range[1],
        };
        last.posts.iter().all(covers)
    }

    /// Returns the lever at the end of the ellipse: that of an interior without inertia.
    fn greatest(&self) -> f64 {
        (self.target / self.weighed.lever).sqrt()
    }

    /// Returns lever and ratio where the tangent at `touch` meets the tangent twice `half` further
    /// on.
    fn at(&self, touch: f64, half: f64) -> [f64; 2] {
        let angle = touch + half;
        let radius = self.target.sqrt() / half.cos();
        [
            radius * angle.cos() / self.weighed.lever.sqrt(),
            radius * angle.sin() / self.weighed.inertia.sqrt(),
        ]
    }

    fn corner(&self, [lever, target]: [f64; 2], start: &Post) -> Result<Corner, Doubt> {
        let cover = Cover {
            heights: self.heights,
            target,
            lever: Some(lever),
            level_ratio: LEVEL_RATIO,
        };
        Ok(Corner {
            lever,
            target,
            posts: cover.posts(start.at, start.point.clone())?,
        })
    }

    /// Returns true if every interior with a lever between two corners is above the side between
    /// them.
    fn is_above(&self, low: &Corner, high: &Corner) -> bool {
        low.posts.iter().all(|one| {
            let beside = |other: &&Post| (one.at - other.at).abs() <= one.reach + other.reach;
            high.posts
                .iter()
                .filter(beside)
                .all(|other| self.is_above_at([low.lever, high.lever], [one, other]))
        })
    }

    /// Returns true if this holds for the heights within the reach of two posts.
    fn is_above_at(&self, [low, high]: [f64; 2], [one, other]: [&Post; 2]) -> bool {
        let height = (one.at + one.reach)
            .min(other.at + other.reach)
            .min(self.heights.range[1]);
        let loss = (high - low) * (multiplier(one) - multiplier(other)) * height / low;
        (level(one).sqrt() + level(other).sqrt()).powi(2) >= loss
    }
}

impl Corner {
    /// Returns the lever's multiplier at the middle post.
    fn multiplier(&self) -> f64 {
        multiplier(&self.posts[0])
    }

    /// Returns the margin left at the end of the middle post's reach.
    fn level(&self) -> f64 {
        level(&self.posts[0])
    }
}

fn multiplier(post: &Post) -> f64 {
    post.point.lambda[LEVER_ROW]
}

/// Returns the margin left at the end of a post's reach.
fn level(post: &Post) -> f64 {
    LEVEL_RATIO * post.margin
}

/// Extrapolates the middle post along the line through two corners' middle posts.
fn extrapolate(before: &Corner, last: &Corner, lever: f64) -> Post {
    let ahead = (lever - last.lever) / (last.lever - before.lever);
    let (one, other) = (&before.posts[0], &last.posts[0]);
    let mut point = other.point.clone();
    point.y += (&other.point.y - &one.point.y) * ahead;
    point.lambda += (&other.point.lambda - &one.point.lambda) * ahead;
    let length = point.y.norm();
    if length > 1.0 {
        point.y /= length;
    }
    // The square root of the margin grows linearly with the distance from the best lever.
    let root = other.margin.sqrt() + (other.margin.sqrt() - one.margin.sqrt()) * ahead;
    point.tau = root * root;
    Post {
        at: other.at + (other.at - one.at) * ahead,
        point,
        ..other.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::goal::Objective;
    use crate::hollow::dual::work::Work;
    use crate::hollow::{Settings, worlds};

    #[test]
    fn a_true_claim_is_proved_to_the_last_digits_and_a_false_one_is_not() {
        for (gamma_c, gamma_i) in [(1.0, 1.0), (0.3, 1.2)] {
            let objective = Objective::SpinIt { gamma_c, gamma_i };
            let world = worlds::egg_on_its_side(objective);
            let (settings, watch, problem) =
                (Settings::default(), Watch::silent(), world.problem());
            let work = Work::new(&problem, &settings, &watch);
            let heights = Heights::new(&work, objective).unwrap();
            let bottom = heights.find_bottom_from(heights.range[1]).unwrap();
            for (share, expected) in [
                (0.9, true),
                (1.0 - 1e-6, true),
                (1.0 + 1e-6, false),
                (1.1, false),
            ] {
                let target = share * bottom.sample.value;
                let weighed = Weighed::of(objective, &work).unwrap();
                let proof = Frontier {
                    heights: &heights,
                    weighed,
                    target,
                }
                .prove(&bottom);
                assert_eq!(proof.is_ok(), expected, "{gamma_c} {share}: {proof:?}");
            }
        }
    }

    #[test]
    fn the_corners_of_a_side_lie_on_the_tangent_of_the_ellipse() {
        let objective = Objective::SpinIt {
            gamma_c: 0.7,
            gamma_i: 1.3,
        };
        let world = worlds::rings(objective);
        let (settings, watch, problem) = (Settings::default(), Watch::silent(), world.problem());
        let work = Work::new(&problem, &settings, &watch);
        let heights = Heights {
            work: &work,
            objective,
            range: [0.1, 1.0],
        };
        let weighed = Weighed::of(objective, &work).unwrap();
        let frontier = Frontier {
            heights: &heights,
            weighed,
            target: 0.9,
        };
        let value = |[lever, ratio]: [f64; 2]| {
            weighed.lever * lever * lever + weighed.inertia * ratio * ratio
        };
        let [low, high] = [0.05, -0.08].map(|half| frontier.at(1.1, half));
        let along = |x: f64| [0, 1].map(|i| low[i] + x * (high[i] - low[i]));
        // Least at the point of contact, which divides the side in the ratio of the tangents of the
        // two angles.
        let touch = 0.05_f64.tan() / (0.05_f64.tan() + 0.08_f64.tan());
        assert!((value(along(touch)) - 0.9).abs() < 1e-12);
        assert!((0..=50).all(|i| value(along(f64::from(i) / 50.0)) >= 0.9 - 1e-12));
    }
}
