//! The least ballast: how much of a denser material inside makes a goal possible that hollowing alone does not meet.

use nalgebra::DMatrix;

use super::ascent::{Climb, End};
use super::heights::Heights;
use super::problem::Problem;
use super::programme::{DualPoint, Programme};
use super::reach::{Heavy, Vector10};
use super::settings::Settings;
use super::work::Work;
use crate::geom::Quadric;
use crate::goal::{GoalKind, Objective};
use crate::progress::Progress;

/// The price of as much ballast as the solid's volume. Far larger, multipliers outgrow what an ascent starts with; far
/// smaller, the cost is lost beside the tolerance of its value.
const PRICE: f64 = 0.1;
/// I_b/I_c that counts as stable: a per cent below the border, where the least speed would be without bound.
const STABLE_RATIO: f64 = 0.99;
/// The toppling angle that counts as standing, rad: half a degree.
const STANDING_RAD: f64 = 0.0087;
/// Heights of a top's centre that are looked at before the best is refined.
const HEIGHTS: usize = 9;
/// Rounds of golden section about the best height, and the part of the range that each leaves, (√5 − 1)/2.
const GOLDEN_ROUNDS: usize = 6;
const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;
/// Growth of the weight of a limit until it is kept, and how often it may grow.
const WEIGHT_GROWTH: f64 = 4.0;
const MOST_GROWTHS: usize = 14;
/// How nearly the least ballast is found: the proved bound is this near, as a part of it.
const PRECISION_RATIO: f64 = 5e-3;
/// Bisections of the weight's logarithm at most.
const MOST_BISECTIONS: usize = 12;
/// How exact the ascents are, with the price as the unit of their value.
const TOLERANCE: f64 = 1e-6;
/// The residual of the rows up to which an interior is one: a ten-thousandth of the solid's radius of gyration, a small
/// part of what the ballast itself moves.
const ACCEPTED_RESIDUAL: f64 = 1e-4;

/// The least ballast, and where it goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ballast {
    /// Its volume, mm³.
    pub volume_mm3: f64,
    /// No ballast of less volume meets the goal, at the height of a top's centre that was found best, mm³; proved.
    pub bound_mm3: f64,
    /// The ballast is where this is positive; goal frame, mm.
    pub filled: Quadric,
    /// The void is where this is positive; goal frame, mm.
    pub emptied: Quadric,
}

/// The least volume of a material `density_ratio` times as dense as the printed one with which the goal is possible,
/// with a per cent to spare; none where even unlimited ballast inside does not help, or for goals it is not known for.
///
/// With ballast at hand every grain of the interior may be emptied, kept or replaced, and the reachable moments are again
/// a convex set. Of the programme "least cost subject to the rows and to a limit on the goal's ratio" the dual prices
/// the limit with one weight; for given multipliers a grain is emptied where the quadric q > 0 and replaced where q is
/// so far below zero that the gain pays, q < −price/(ratio − 1): two level sets of one quadric. So two passes find the
/// extreme interior and everything else is the ascent of [`super::solve`].
pub fn least_ballast(
    problem: &Problem,
    density_ratio: f64,
    settings: &Settings,
    progress: &Progress,
) -> Option<Ballast> {
    let bench = |price| Work::new(problem, settings, progress).with(Heavy { density_ratio, price });
    let shop = Shop { free: bench(0.0), priced: bench(PRICE) };
    let bought = match (problem.goal.kind, problem.goal.objective) {
        (GoalKind::Top, _) => shop.least_of_heights(),
        (GoalKind::Yoyo, _) => shop.least(&|work| Programme::yoyo_dominance(&work.reach), STABLE_RATIO),
        (GoalKind::Stand, Objective::LowestCenter) => {
            shop.least(&|work| Programme::stand_lowest_center(&work.reach), f64::INFINITY)
        }
        (GoalKind::Stand, _) => {
            shop.least(&|work| Programme::stand_toppling(&work.reach, problem.goal), -STANDING_RAD.tan())
        }
    }?;
    shop.ballast(&bought)
}

/// The interior with the least ballast that was found.
struct Bought {
    climb: Climb,
    /// Its cost.
    cost: f64,
    /// The least cost that is proved.
    bound: f64,
}

/// What a height of a top's centre costs.
#[derive(Default)]
struct Look {
    height: f64,
    bought: Option<Bought>,
}

impl Look {
    fn by_cost(&self, other: &Self) -> std::cmp::Ordering {
        let cost = |look: &Self| look.bought.as_ref().map_or(f64::INFINITY, |bought| bought.cost);
        cost(self).total_cmp(&cost(other))
    }
}

/// The same interior with ballast for nothing and at a price.
struct Shop<'a> {
    free: Work<'a>,
    priced: Work<'a>,
}

impl Shop<'_> {
    fn ballast(&self, bought: &Bought) -> Option<Ballast> {
        let (reach, quadric) = (&self.priced.reach, &bought.climb.best.quadric);
        let volume_mm3 = |cost: f64| cost / PRICE * reach.scale.volume_mm3;
        Some(Ballast {
            volume_mm3: volume_mm3(bought.cost),
            bound_mm3: volume_mm3(bought.bound),
            filled: reach.filled_by(quadric)?,
            emptied: reach.scale.quadric_to_mm(quadric),
        })
    }

    /// The least over all heights of a top's centre: a look at several, then golden section about the best.
    fn least_of_heights(&self) -> Option<Bought> {
        let [low, high] = Heights::range(&self.free).ok()?;
        let at = |height: f64| {
            let bought = self.least(&|work| Programme::top_dominance(&work.reach, height), STABLE_RATIO);
            Look { height, bought }
        };
        let width = (high - low) / HEIGHTS as f64;
        let looks = (0..HEIGHTS).map(|i| at(low + (i as f64 + 0.5) * width));
        let best = looks.min_by(Look::by_cost)?;
        let (mut a, mut b) = (best.height - width, best.height + width);
        let golden = |from: f64, to: f64| at(from + GOLDEN_RATIO * (to - from));
        let (mut left, mut right) = (golden(b, a), golden(a, b));
        for _ in 0..GOLDEN_ROUNDS {
            if Look::by_cost(&left, &right).is_lt() {
                b = right.height;
                right = std::mem::replace(&mut left, Look::default());
                left = golden(b, a);
            } else {
                a = left.height;
                left = std::mem::replace(&mut right, Look::default());
                right = golden(a, b);
            }
        }
        [best, left, right].into_iter().min_by(Look::by_cost)?.bought
    }

    /// The least ballast with which the rows of a programme are met and its ratio is at most `limit`.
    fn least(&self, programme: &dyn Fn(&Work) -> Programme, limit: f64) -> Option<Bought> {
        let wish = programme(&self.free);
        let best = self.free.climb_near(&wish, None, TOLERANCE)?;
        if best.best.bound > limit {
            return None;
        }
        let wish = programme(&self.priced);
        // Where the rows need no ballast, this ascent has its peak in the kink at no multipliers at all and finds nothing.
        let rows_alone = self.bought(&wish, 0.0, limit);
        let kept = rows_alone.filter(|bought| is_kept(&wish, limit, &bought.climb));
        kept.or_else(|| self.with_least_weight(&wish, limit))
    }

    /// The limit's weight, as small as keeps it.
    fn with_least_weight(&self, wish: &Programme, limit: f64) -> Option<Bought> {
        let mut light = 0.0;
        let mut heavy = PRICE;
        let mut kept = None;
        for _ in 0..MOST_GROWTHS {
            let bought = self.bought(wish, heavy, limit)?;
            if is_kept(wish, limit, &bought.climb) {
                kept = Some(bought);
                break;
            }
            (light, heavy) = (heavy, heavy * WEIGHT_GROWTH);
        }
        let mut kept = kept?;
        for _ in 0..MOST_BISECTIONS {
            if kept.cost - kept.bound <= PRECISION_RATIO * kept.cost {
                break;
            }
            let middle = 0.5 * (light + heavy);
            let bought = self.bought(wish, middle, limit)?;
            let bound = kept.bound.max(bought.bound);
            if is_kept(wish, limit, &bought.climb) {
                (heavy, kept) = (middle, bought);
            } else {
                light = middle;
            }
            kept.bound = bound;
        }
        Some(kept)
    }

    /// The interior of the least cost when the excess over the limit costs `weight` besides; none where the ascent fails.
    fn bought(&self, wish: &Programme, weight: f64, limit: f64) -> Option<Bought> {
        let programme = priced(wish, weight, limit);
        let start = programme.cold_start(&self.priced.reach);
        let climb = self.priced.climb(&programme, DualPoint { tau: 0.0, ..start }, TOLERANCE);
        let is_met = climb.best.residual() <= ACCEPTED_RESIDUAL;
        let (cost, bound) = (climb.best.extreme.cost, climb.best.bound);
        (is_met && climb.end != End::Cancelled).then_some(Bought { climb, cost, bound })
    }
}

/// Minimise the cost plus the weighted excess n·s + max yᵀJs − limit·e·s, subject to the rows.
fn priced(wish: &Programme, weight: f64, limit: f64) -> Programme {
    let has_limit = weight > 0.0;
    let numerator =
        if has_limit { (wish.numerator - wish.denominator * limit) * weight } else { Vector10::zeros() };
    let directions =
        if has_limit { &wish.directions * weight } else { DMatrix::zeros(0, Vector10::zeros().len()) };
    let set = if has_limit { wish.set } else { super::set::DualSet::Ball };
    Programme {
        numerator,
        directions,
        set,
        denominator: Vector10::zeros(),
        denominator_floor: 0.0,
        denominator_ceiling: 0.0,
        ..wish.clone()
    }
}

/// Whether an interior's ratio is at most the limit.
fn is_kept(wish: &Programme, limit: f64, climb: &Climb) -> bool {
    let s = &climb.best.extreme.s;
    limit == f64::INFINITY || wish.numerator_at(s) <= limit * wish.denominator_at(s)
}
