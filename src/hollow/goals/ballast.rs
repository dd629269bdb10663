//! The least ballast: the least volume of a denser material inside that makes an otherwise
//! impossible goal possible.

use nalgebra::DMatrix;

use crate::base::watch::Watch;
use crate::geom::Quadric;
use crate::goal::{FloatConditions, Goal, GoalKind, Objective, Spindle, compute_figures};
use crate::hollow::dual::ascent::{Climb, End};
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::reach::Heavy;
use crate::hollow::dual::set::DualSet;
use crate::hollow::dual::units::Vector10;
use crate::hollow::dual::work::Work;
use crate::hollow::golden::golden_section;
use crate::hollow::problem::Problem;
use crate::hollow::problem::Settings;
use crate::hollow::solution::{Figure, Solution};
use crate::hollow::top::heights::Heights;

/// Price of the solid's volume of ballast. With a far larger price the multipliers outgrow the
/// start of an ascent. With a far smaller one the cost is lost in the tolerance of the value.
const PRICE: f64 = 0.1;
/// I_b/I_c that counts as stable. It is one per cent below the limit, where the least speed grows
/// without bound.
const STABLE_RATIO: f64 = 0.99;
/// Toppling angle that counts as standing, rad: half a degree.
const STANDING_RAD: f64 = 0.0087;
/// Least depth of a floating body's centre of mass below the metacentre, mm.
const RIGHTING_MM: f64 = 0.5;
/// Share of the permitted unbalance of a rotor's grade that may be left.
const GRADE_SHARE: f64 = 0.9;
/// Number of heights of a top's centre sampled before the best is refined.
const HEIGHTS: usize = 9;
/// Rounds of golden section about the best height; six leave a ninth of the interval of two samples
/// around it.
const GOLDEN_ROUNDS: usize = 6;
/// Growth of the limit's weight until the limit is met, and the greatest number of growths.
const WEIGHT_GROWTH: f64 = 4.0;
const MOST_GROWTHS: usize = 14;
/// Relative distance of the proved bound at which the search ends.
const PRECISION_RATIO: f64 = 5e-3;
/// Limit on the bisections of the weight's interval.
const MOST_BISECTIONS: usize = 12;
/// Tolerance of the ascents, with the price as the unit of their value.
const TOLERANCE: f64 = 1e-6;
/// Accepted residual of the rows: a hundredth of the solid's radius of gyration.
///
/// If the level sets are vertical, whole slabs of columns change at once, and no ascent does
/// better. Then only the bound is exact.
const ACCEPTED_RESIDUAL: f64 = 1e-2;

/// The least ballast, and its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ballast {
    /// Volume, mm³.
    pub volume_mm3: f64,
    /// Proved lower bound of the volume, mm³. For a top it holds at the best height of the centre
    /// that was found.
    pub bound_mm3: f64,
    /// Quadric that is positive in the ballast; goal frame, mm.
    pub filled: Quadric,
    /// Quadric that is positive in the void; goal frame, mm.
    pub emptied: Quadric,
}

/// Finds the least volume of a denser material that makes the goal possible, with a per cent to
/// spare.
///
/// `density_ratio` is its density over that of the printed material. Returns `None` if even
/// unlimited ballast inside does not help, or if the goal lacks the data for it.
///
/// With ballast every grain of the interior may be emptied, kept or replaced, and the reachable
/// moments are again a convex set. The programme is "least cost subject to the rows and to a limit
/// on the goal's ratio". Its dual prices the limit with one weight. For given multipliers a grain
/// is emptied if the quadric q > 0. It is replaced if q < −price/(ratio − 1), so far below zero
/// that the gain pays. These are two level sets of one quadric. So two passes find the extreme
/// interior, and the rest is the ascent of [`crate::hollow::solve`].
pub fn least_ballast(
    problem: &Problem,
    density_ratio: f64,
    settings: &Settings,
    watch: &Watch,
) -> Option<Ballast> {
    let work_at = |price| {
        Work::new(problem, settings, watch).with_heavy(Heavy {
            density_ratio,
            price,
        })
    };
    let search = BallastSearch {
        free: work_at(0.0),
        priced: work_at(PRICE),
    };
    let candidate = match (problem.goal.kind, problem.goal.objective) {
        (GoalKind::Top, _) => search.least_over_heights(),
        (GoalKind::Yoyo, _) => {
            search.minimise(&|work| Programme::yoyo_dominance(&work.reach), STABLE_RATIO)
        }
        (GoalKind::Stand, Objective::LowestCenter) => search.minimise(
            &|work| Programme::stand_lowest_center(&work.reach),
            f64::INFINITY,
        ),
        (GoalKind::Stand, _) => search.minimise(
            &|work| Programme::stand_toppling(&work.reach, problem.goal),
            -STANDING_RAD.tan(),
        ),
        (GoalKind::Float, _) => search.least_to_float(problem.goal.afloat?),
        (GoalKind::Balance, _) => search.least_to_balance(&problem.goal.spindle?),
        (GoalKind::Match, _) => None,
    }?;
    search.ballast(&candidate)
}

/// Returns true if a solution has the margin that [`least_ballast`] asks for.
///
/// At the limit of the possible a top has no least speed, and a standing object falls at a touch.
pub fn has_margin(goal: &Goal, solution: &Solution) -> bool {
    let value = solution.certificate.value;
    let is_enough = match (goal.kind, solution.certificate.figure) {
        (GoalKind::Top | GoalKind::Yoyo, _) => {
            compute_figures(goal, &solution.moments).dominance_ratio <= STABLE_RATIO
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

/// The cheapest interior found.
struct Candidate {
    climb: Climb,
    /// Price of its ballast.
    cost: f64,
    /// Proved lower bound of the price.
    bound: f64,
}

/// The cheapest interior at one height of a top's centre.
struct Sample {
    height: f64,
    candidate: Option<Candidate>,
}

impl Sample {
    fn by_cost(&self, other: &Self) -> std::cmp::Ordering {
        let cost = |sample: &Self| {
            sample
                .candidate
                .as_ref()
                .map_or(f64::INFINITY, |candidate| candidate.cost)
        };
        cost(self).total_cmp(&cost(other))
    }
}

/// The search for the least ballast, on the same interior with free and with priced ballast.
struct BallastSearch<'a> {
    free: Work<'a>,
    priced: Work<'a>,
}

impl BallastSearch<'_> {
    fn ballast(&self, candidate: &Candidate) -> Option<Ballast> {
        let (reach, quadric) = (&self.priced.reach, &candidate.climb.best.quadric);
        let volume_mm3 = |cost: f64| cost / PRICE * reach.scale.volume_mm3;
        Some(Ballast {
            volume_mm3: volume_mm3(candidate.cost),
            bound_mm3: volume_mm3(candidate.bound),
            filled: reach.heavy_quadric(quadric)?,
            emptied: reach.scale.quadric_to_mm(quadric),
        })
    }

    /// Minimises over the heights of a top's centre: several samples, then golden section about the
    /// best.
    fn least_over_heights(&self) -> Option<Candidate> {
        let [low, high] = Heights::range(&self.free).ok()?;
        let at = |height: f64| {
            let candidate = self.minimise(
                &|work| Programme::top_dominance(&work.reach, height),
                STABLE_RATIO,
            );
            Sample { height, candidate }
        };
        let width = (high - low) / HEIGHTS as f64;
        let samples = (0..HEIGHTS).map(|i| at(low + (i as f64 + 0.5) * width));
        let best = samples.min_by(Sample::by_cost)?;
        let range = [best.height - width, best.height + width];
        let is_better = |left: &Sample, right: &Sample| Sample::by_cost(left, right).is_lt();
        let [left, right] = golden_section(range, GOLDEN_ROUNDS, at, is_better);
        [best, left, right]
            .into_iter()
            .min_by(Sample::by_cost)?
            .candidate
    }

    /// Minimises the ballast that gives the right mass and a centre below the metacentre.
    fn least_to_float(&self, afloat: FloatConditions) -> Option<Candidate> {
        let limit = (afloat.metacenter_mm - RIGHTING_MM) / self.free.to_mm(1.0);
        self.minimise(
            &|work| Programme::float_lowest_center(&work.reach, &afloat),
            limit,
        )
    }

    /// Minimises the ballast with which a rotor reaches its grade.
    fn least_to_balance(&self, spindle: &Spindle) -> Option<Candidate> {
        let length_mm = self.free.to_mm(1.0);
        let ends = spindle.ends_mm.map(|end| end / length_mm);
        let limit =
            GRADE_SHARE * spindle.rotor.permissible_mm() / (std::f64::consts::SQRT_2 * length_mm);
        self.minimise(
            &|work| Programme::balance_unbalance(&work.reach, ends),
            limit,
        )
    }

    /// Minimises the ballast with which the rows of a programme are met and its ratio is at most
    /// `limit`.
    fn minimise(&self, programme_of: &dyn Fn(&Work) -> Programme, limit: f64) -> Option<Candidate> {
        let programme = programme_of(&self.free);
        let best = self.free.climb_near(&programme, None, TOLERANCE)?;
        if best.best.bound > limit {
            return None;
        }
        let programme = programme_of(&self.priced);
        // If the rows need no ballast, this ascent ends in the kink at multipliers of zero and
        // finds nothing.
        let rows_alone = self.minimise_cost(&programme, 0.0, limit);
        let feasible =
            rows_alone.filter(|candidate| meets_limit(&programme, limit, &candidate.climb));
        feasible.or_else(|| self.with_least_weight(&programme, limit))
    }

    /// Searches for the smallest weight of the limit with which the limit is met.
    fn with_least_weight(&self, programme: &Programme, limit: f64) -> Option<Candidate> {
        let try_weight = |weight: f64| {
            let candidate = self.minimise_cost(programme, weight, limit);
            candidate.map(|candidate| (meets_limit(programme, limit, &candidate.climb), candidate))
        };
        let weights = std::iter::successors(Some(PRICE), |weight| Some(weight * WEIGHT_GROWTH));
        let first = weights
            .take(MOST_GROWTHS)
            .find_map(|weight| match try_weight(weight)? {
                (true, candidate) => Some((weight, candidate)),
                (false, _) => None,
            });
        let (mut heavy, mut feasible) = first?;
        let mut light = if heavy > PRICE {
            heavy / WEIGHT_GROWTH
        } else {
            0.0
        };
        for _ in 0..MOST_BISECTIONS {
            if feasible.cost - feasible.bound <= PRECISION_RATIO * feasible.cost {
                break;
            }
            let middle = 0.5 * (light + heavy);
            let Some((meets_limit, candidate)) = try_weight(middle) else {
                break;
            };
            let bound = feasible.bound.max(candidate.bound);
            if meets_limit {
                (heavy, feasible) = (middle, candidate);
            } else {
                light = middle;
            }
            feasible.bound = bound;
        }
        Some(feasible)
    }

    /// Minimises the cost of the ballast plus `weight` times the excess over the limit; `None` if
    /// the ascent fails.
    fn minimise_cost(&self, programme: &Programme, weight: f64, limit: f64) -> Option<Candidate> {
        let cost_programme = priced_programme(programme, weight, limit);
        let start = cost_programme.cold_start(&self.priced.reach);
        let climb = self
            .priced
            .climb(&cost_programme, DualPoint { tau: 0.0, ..start }, TOLERANCE);
        let is_met = climb.best.residual() <= ACCEPTED_RESIDUAL;
        // Without a ratio the limit is a constant, which the ascent leaves out.
        let constant = if programme.is_ratio() || weight == 0.0 {
            0.0
        } else {
            weight * limit
        };
        let (cost, bound) = (climb.best.extreme.cost, climb.best.bound - constant);
        (is_met && climb.end != End::Cancelled).then_some(Candidate { climb, cost, bound })
    }
}

/// Returns the programme of the cost plus the weighted excess n·s + max yᵀJs − limit·e·s, subject
/// to the rows.
fn priced_programme(programme: &Programme, weight: f64, limit: f64) -> Programme {
    let has_limit = weight > 0.0;
    let numerator = if has_limit {
        (programme.numerator - programme.denominator * limit) * weight
    } else {
        Vector10::zeros()
    };
    let directions = if has_limit {
        &programme.directions * weight
    } else {
        DMatrix::zeros(0, Vector10::zeros().len())
    };
    let set = if has_limit {
        programme.set
    } else {
        DualSet::Ball
    };
    Programme {
        numerator,
        directions,
        set,
        denominator: Vector10::zeros(),
        denominator_floor: 0.0,
        denominator_ceiling: 0.0,
        ..programme.clone()
    }
}

/// Returns true if an interior's ratio is at most the limit.
fn meets_limit(programme: &Programme, limit: f64, climb: &Climb) -> bool {
    let s = &climb.best.extreme.s;
    limit == f64::INFINITY || programme.numerator_at(s) <= limit * programme.denominator_at(s)
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
        // The beam has the cross-section A from −a to a, and beside it a mass with the first moment
        // F about the middle. Emptied at x > 0 it gives A a²/2 towards −x. Steel from −a to −t adds
        // (κ − 1) A (a² − t²)/2.
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
            let figures = compute_figures(&world.goal, moments);
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
