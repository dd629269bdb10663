//! The least ballast: how much of a denser material inside makes a goal possible that hollowing
//! alone does not meet.

use nalgebra::DMatrix;

use crate::base::watch::Watch;
use crate::geom::Quadric;
use crate::goal::{Afloat, Goal, GoalKind, Objective, Spindle, figures};
use crate::hollow::dual::ascent::{Climb, End};
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::reach::Heavy;
use crate::hollow::dual::units::Vector10;
use crate::hollow::dual::work::Work;
use crate::hollow::golden::golden_section;
use crate::hollow::problem::Problem;
use crate::hollow::problem::Settings;
use crate::hollow::solution::{Figure, Solution};
use crate::hollow::top::heights::Heights;

/// The price of as much ballast as the solid's volume. Far larger, multipliers outgrow what an
/// ascent starts with; far smaller, the cost is lost beside the tolerance of its value.
const PRICE: f64 = 0.1;
/// I_b/I_c that counts as stable: a per cent below the border, where the least speed would be
/// without bound.
const STABLE_RATIO: f64 = 0.99;
/// The toppling angle that counts as standing, rad: half a degree.
const STANDING_RAD: f64 = 0.0087;
/// How far below the metacentre a floating body's centre of mass has to lie, mm.
const RIGHTING_MM: f64 = 0.5;
/// The share of the unbalance that a rotor's grade permits which may be left.
const GRADE_SHARE: f64 = 0.9;
/// Heights of a top's centre that are looked at before the best is refined.
const HEIGHTS: usize = 9;
/// Rounds of golden section about the best height: six leave a ninth of the two looks around it.
const GOLDEN_ROUNDS: usize = 6;
/// Growth of the weight of a limit until it is kept, and how often it may grow.
const WEIGHT_GROWTH: f64 = 4.0;
const MOST_GROWTHS: usize = 14;
/// How nearly the least ballast is found: the proved bound is this near, as a part of it.
const PRECISION_RATIO: f64 = 5e-3;
/// Bisections of the weight's logarithm at most.
const MOST_BISECTIONS: usize = 12;
/// How exact the ascents are, with the price as the unit of their value.
const TOLERANCE: f64 = 1e-6;
/// The residual of the rows up to which an interior is one: a hundredth of the solid's radius of
/// gyration. Where the level sets stand upright, whole slabs of columns change hands at once and no
/// ascent does better; then only the bound is exact.
const ACCEPTED_RESIDUAL: f64 = 1e-2;

/// The least ballast, and where it goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ballast {
    /// Its volume, mm³.
    pub volume_mm3: f64,
    /// No ballast of less volume meets the goal, at the height of a top's centre that was found
    /// best, mm³; proved.
    pub bound_mm3: f64,
    /// The ballast is where this is positive; goal frame, mm.
    pub filled: Quadric,
    /// The void is where this is positive; goal frame, mm.
    pub emptied: Quadric,
}

/// The least volume of a material `density_ratio` times as dense as the printed one with which the
/// goal is possible, with a per cent to spare; none where even unlimited ballast inside does not
/// help, or for goals it is not known for.
///
/// With ballast at hand every grain of the interior may be emptied, kept or replaced, and the
/// reachable moments are again a convex set. Of the programme "least cost subject to the rows and
/// to a limit on the goal's ratio" the dual prices the limit with one weight; for given multipliers
/// a grain is emptied where the quadric q > 0 and replaced where q is so far below zero that the
/// gain pays, q < −price/(ratio − 1): two level sets of one quadric. So two passes find the extreme
/// interior and everything else is the ascent of [`crate::hollow::solve`].
pub fn least_ballast(
    problem: &Problem,
    density_ratio: f64,
    settings: &Settings,
    watch: &Watch,
) -> Option<Ballast> {
    let bench = |price| {
        Work::new(problem, settings, watch).with_heavy(Heavy {
            density_ratio,
            price,
        })
    };
    let shop = Shop {
        free: bench(0.0),
        priced: bench(PRICE),
    };
    let bought = match (problem.goal.kind, problem.goal.objective) {
        (GoalKind::Top, _) => shop.least_of_heights(),
        (GoalKind::Yoyo, _) => {
            shop.least(&|work| Programme::yoyo_dominance(&work.reach), STABLE_RATIO)
        }
        (GoalKind::Stand, Objective::LowestCenter) => shop.least(
            &|work| Programme::stand_lowest_center(&work.reach),
            f64::INFINITY,
        ),
        (GoalKind::Stand, _) => shop.least(
            &|work| Programme::stand_toppling(&work.reach, problem.goal),
            -STANDING_RAD.tan(),
        ),
        (GoalKind::Float, _) => shop.least_to_float(problem.goal.afloat?),
        (GoalKind::Balance, _) => shop.least_to_balance(&problem.goal.spindle?),
    }?;
    shop.ballast(&bought)
}

/// Whether a solution is possible with as much to spare as [`least_ballast`] asks for: at the very
/// border of the possible a top has no least speed, and what stands falls over when breathed at.
pub fn has_spare(goal: &Goal, solution: &Solution) -> bool {
    let value = solution.certificate.value;
    let is_enough = match (goal.kind, solution.certificate.figure) {
        (GoalKind::Top | GoalKind::Yoyo, _) => {
            figures(goal, &solution.moments).dominance_ratio <= STABLE_RATIO
        }
        (_, Figure::TopplingAngleRad) => value >= STANDING_RAD,
        (_, Figure::MetacentricHeightMm) => value >= RIGHTING_MM,
        (_, Figure::BalanceGradeMmS) => goal
            .spindle
            .is_none_or(|spindle| value <= GRADE_SHARE * spindle.rotor.grade_mm_s),
        _ => true,
    };
    solution.is_usable() && is_enough
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
struct Look {
    height: f64,
    bought: Option<Bought>,
}

impl Look {
    fn by_cost(&self, other: &Self) -> std::cmp::Ordering {
        let cost = |look: &Self| {
            look.bought
                .as_ref()
                .map_or(f64::INFINITY, |bought| bought.cost)
        };
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
            filled: reach.heavy_quadric(quadric)?,
            emptied: reach.scale.quadric_to_mm(quadric),
        })
    }

    /// The least over all heights of a top's centre: a look at several, then golden section about
    /// the best.
    fn least_of_heights(&self) -> Option<Bought> {
        let [low, high] = Heights::range(&self.free).ok()?;
        let at = |height: f64| {
            let bought = self.least(
                &|work| Programme::top_dominance(&work.reach, height),
                STABLE_RATIO,
            );
            Look { height, bought }
        };
        let width = (high - low) / HEIGHTS as f64;
        let looks = (0..HEIGHTS).map(|i| at(low + (i as f64 + 0.5) * width));
        let best = looks.min_by(Look::by_cost)?;
        let range = [best.height - width, best.height + width];
        let is_better = |left: &Look, right: &Look| Look::by_cost(left, right).is_lt();
        let [left, right] = golden_section(range, GOLDEN_ROUNDS, at, is_better);
        [best, left, right]
            .into_iter()
            .min_by(Look::by_cost)?
            .bought
    }

    /// The least with which it has the right mass and its centre under the metacentre.
    fn least_to_float(&self, afloat: Afloat) -> Option<Bought> {
        let limit = (afloat.metacenter_mm - RIGHTING_MM) / self.free.to_mm(1.0);
        self.least(
            &|work| Programme::float_lowest_center(&work.reach, &afloat),
            limit,
        )
    }

    /// The least with which a rotor reaches its grade.
    fn least_to_balance(&self, spindle: &Spindle) -> Option<Bought> {
        let length_mm = self.free.to_mm(1.0);
        let ends = spindle.ends_mm.map(|end| end / length_mm);
        let limit =
            GRADE_SHARE * spindle.rotor.permissible_mm() / (std::f64::consts::SQRT_2 * length_mm);
        self.least(
            &|work| Programme::balance_unbalance(&work.reach, ends),
            limit,
        )
    }

    /// The least ballast with which the rows of a programme are met and its ratio is at most
    /// `limit`.
    fn least(&self, programme: &dyn Fn(&Work) -> Programme, limit: f64) -> Option<Bought> {
        let wish = programme(&self.free);
        let best = self.free.climb_near(&wish, None, TOLERANCE)?;
        if best.best.bound > limit {
            return None;
        }
        let wish = programme(&self.priced);
        // Where the rows need no ballast, this ascent has its peak in the kink at no multipliers at
        // all and finds nothing.
        let rows_alone = self.bought(&wish, 0.0, limit);
        let kept = rows_alone.filter(|bought| is_kept(&wish, limit, &bought.climb));
        kept.or_else(|| self.with_least_weight(&wish, limit))
    }

    /// The limit's weight, as small as keeps it.
    fn with_least_weight(&self, wish: &Programme, limit: f64) -> Option<Bought> {
        let keeping = |weight: f64| {
            let bought = self.bought(wish, weight, limit);
            bought.map(|bought| (is_kept(wish, limit, &bought.climb), bought))
        };
        let weights = std::iter::successors(Some(PRICE), |weight| Some(weight * WEIGHT_GROWTH));
        let first = weights
            .take(MOST_GROWTHS)
            .find_map(|weight| match keeping(weight)? {
                (true, bought) => Some((weight, bought)),
                (false, _) => None,
            });
        let (mut heavy, mut kept) = first?;
        let mut light = if heavy > PRICE {
            heavy / WEIGHT_GROWTH
        } else {
            0.0
        };
        for _ in 0..MOST_BISECTIONS {
            if kept.cost - kept.bound <= PRECISION_RATIO * kept.cost {
                break;
            }
            let middle = 0.5 * (light + heavy);
            let Some((is_kept, bought)) = keeping(middle) else {
                break;
            };
            let bound = kept.bound.max(bought.bound);
            if is_kept {
                (heavy, kept) = (middle, bought);
            } else {
                light = middle;
            }
            kept.bound = bound;
        }
        Some(kept)
    }

    /// The interior of the least cost when the excess over the limit costs `weight` besides; none
    /// where the ascent fails.
    fn bought(&self, wish: &Programme, weight: f64, limit: f64) -> Option<Bought> {
        let programme = priced(wish, weight, limit);
        let start = programme.cold_start(&self.priced.reach);
        let climb = self
            .priced
            .climb(&programme, DualPoint { tau: 0.0, ..start }, TOLERANCE);
        let is_met = climb.best.residual() <= ACCEPTED_RESIDUAL;
        // Without a ratio the limit is a constant, which the ascent knows nothing of.
        let constant = if wish.is_ratio() || weight == 0.0 {
            0.0
        } else {
            weight * limit
        };
        let (cost, bound) = (climb.best.extreme.cost, climb.best.bound - constant);
        (is_met && climb.end != End::Cancelled).then_some(Bought { climb, cost, bound })
    }
}

/// Minimise the cost plus the weighted excess n·s + max yᵀJs − limit·e·s, subject to the rows.
fn priced(wish: &Programme, weight: f64, limit: f64) -> Programme {
    let has_limit = weight > 0.0;
    let numerator = if has_limit {
        (wish.numerator - wish.denominator * limit) * weight
    } else {
        Vector10::zeros()
    };
    let directions = if has_limit {
        &wish.directions * weight
    } else {
        DMatrix::zeros(0, Vector10::zeros().len())
    };
    let set = if has_limit {
        wish.set
    } else {
        crate::hollow::dual::set::DualSet::Ball
    };
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hollow::worlds;
    use crate::interior::moments_where_positive;

    fn ballast(world: &worlds::World, density_ratio: f64) -> Option<Ballast> {
        least_ballast(
            &world.problem(),
            density_ratio,
            &Settings::default(),
            &Watch::silent(),
        )
    }

    #[test]
    fn a_beam_is_balanced_by_steel_at_its_far_end() {
        // A beam of cross-section A from −a to a, and beside it a mass whose first moment about the
        // middle is F: emptied at x > 0 it gives A a²/2 towards −x, and steel from −a to −t a
        // further (κ − 1) A (a² − t²)/2.
        let (half, area, first, density_ratio) = (8.0, 4.0, 700.0, 6.0);
        let world = worlds::beam(first);
        let t2 =
            half * half - (first - area * half * half / 2.0) / ((density_ratio - 1.0) * area / 2.0);
        let volume = area * (half - f64::sqrt(t2));
        let found = ballast(&world, density_ratio).unwrap();
        // Columns are a quarter of a millimetre wide; steel fills whole slabs of them, 1 mm³ each.
        assert!(
            (found.volume_mm3 - volume).abs() < 1.0,
            "{} {volume}",
            found.volume_mm3
        );
        assert!(
            found.bound_mm3 <= found.volume_mm3 + 1e-9 && found.bound_mm3 > found.volume_mm3 - 1.0
        );
        let filled = moments_where_positive(&world.columns, &found.filled);
        assert!(filled.centroid().x < -0.5 * half);
    }

    #[test]
    fn where_all_of_it_is_not_enough_there_is_no_least() {
        // All steel at x < 0 and nothing at x > 0 gives κ A a²/2 = 768.
        assert!(ballast(&worlds::beam(760.0), 6.0).is_some());
        assert_eq!(ballast(&worlds::beam(776.0), 6.0), None);
    }

    #[test]
    fn no_choice_of_blocks_stands_with_less_than_the_bound() {
        let world = worlds::blocks_far_aside();
        let (density_ratio, block_mm3) = (4.0, 8.0);
        let found = ballast(&world, density_ratio).unwrap();
        let mut least = f64::INFINITY;
        worlds::each_mixture(&world, density_ratio, |moments, blocks| {
            let figures = figures(&world.goal, moments);
            if figures
                .toppling_angle_rad
                .is_some_and(|angle| angle >= STANDING_RAD)
            {
                least = least.min(f64::from(blocks) * block_mm3);
            }
        });
        assert!(least.is_finite() && found.bound_mm3 > 0.0);
        assert!(
            found.bound_mm3 <= least + 1e-9,
            "{} {least}",
            found.bound_mm3
        );
        assert!(
            least <= found.volume_mm3 + block_mm3,
            "{} {least}",
            found.volume_mm3
        );
    }

    #[test]
    fn a_stump_is_made_a_top_by_steel_around_its_middle() {
        let world = worlds::stump(14.0);
        let hollowed =
            crate::hollow::solve(&world.problem(), &Settings::default(), &Watch::silent());
        assert!(hollowed.status.is_impossible());
        let found = ballast(&world, 7.0).unwrap();
        let filled = moments_where_positive(&world.columns, &found.filled);
        let rest = world.columns.outside(&found.filled);
        let fixed = world.fixed + filled * 6.0;
        let problem = Problem {
            goal: &world.goal,
            fixed,
            columns: &rest,
        };
        let solution = crate::hollow::solve(&problem, &Settings::default(), &Watch::silent());
        assert!(solution.is_usable(), "{:?}", solution.status);
        assert!(found.bound_mm3 > 0.98 * found.volume_mm3);
    }
}
