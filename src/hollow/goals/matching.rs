//! The match: ten rows, one for each moment of the body that is wanted.
//!
//! Let K be the set of all moments that densities between two bounds reach. Two densities across
//! one quadric reach only its rim. So a match is printed with several levels. Their nested regions
//! reach what lies inside of K, exactly and with the least change
//! ([`least_level_change`](crate::hollow::least_level_change)). The mean of what is wanted must be
//! one of the levels: a nearly uniform body between two levels would need a mixture of both.
//!
//! What lies outside of K is refused with the point of K nearest to it, and a bound of that
//! distance. No density is nearer, so its kit would only be the best of those that are wrong.

use super::found::{Found, solution};
use crate::field::DensityRange;
use crate::geom::Quadric;
use crate::goal::Goal;
use crate::hollow::graded::{Graded, Row, Separation};
use crate::hollow::miss::MatchMiss;
use crate::hollow::nearest::{moment_rows, nearest};
use crate::hollow::problem::Problem;
use crate::hollow::solution::{Certificate, Figure, Solution};
use crate::hollow::status::Status;
use crate::mass::Moments;

/// Distance from the wanted moments, in units of the body, up to which they count as met.
const MET: f64 = 1e-7;
/// The same for a solution whose last digits are not proved.
const NEARLY_MET: f64 = 1e-3;

/// Returns the ten rows of a match.
pub(super) fn rows(goal: &Goal) -> Vec<Row> {
    let wanted = goal.wanted.as_ref();
    wanted.map_or_else(Vec::new, |wanted| moment_rows(&wanted.moments))
}

/// Finds the void that gives a match its moments, or the proof that no density does.
///
/// One void reaches only the rim of K. Inside of it the status says that the rows are not met.
pub fn solve_void(problem: &Problem) -> Solution {
    let rows = rows(problem.goal);
    let graded = Graded {
        shell: problem.fixed - problem.columns.moments(),
        columns: problem.columns,
        rows: &rows,
    };
    let range = DensityRange::FULL;
    let found = nearest(&graded, range);
    let status = match (found.bound, found.distance) {
        (bound, _) if bound > MET => Status::CannotMatch {
            miss: MatchMiss::of(&graded, range),
            separator: found.quadric,
        },
        (_, residual) if residual <= MET => Status::Solved,
        (_, residual) if residual <= NEARLY_MET => Status::AlmostSolved,
        (_, residual) => Status::IterationLimit {
            gap_ratio: 0.0,
            residual,
        },
    };
    solution(
        problem,
        Found {
            status,
            quadric: found.quadric,
            certificate: certificate_of_a_void(found.distance),
            moments: found.moments,
            passes: 0,
            kept: None,
        },
    )
}

/// Returns the certificate of any void: it differs from half of solid print by half, everywhere.
fn certificate_of_a_void(residual: f64) -> Certificate {
    Certificate {
        figure: Figure::InfillChange,
        value: 0.5,
        bound: 0.5,
        gap_ratio: 0.0,
        residual,
        bound_over_heights: None,
    }
}

/// Returns the proof that no density of the range meets a match, where an ascent found none;
/// `None` for fewer rows than a match has, and if some density does.
pub(super) fn proof(graded: &Graded, range: DensityRange) -> Option<Separation> {
    if graded.rows.len() != Moments::COUNT {
        return None;
    }
    let found = nearest(graded, range);
    (found.bound > MET).then(|| Separation {
        weights: found.quadric.0.to_vec(),
        quadric: found.quadric,
    })
}

/// Returns the status of a match that no density of the range meets.
pub(super) fn refused(graded: &Graded, range: DensityRange, separator: Quadric) -> Status {
    Status::CannotMatch {
        miss: MatchMiss::of(graded, range),
        separator,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::goal::{GoalKind, Objective, Wanted};
    use crate::hollow::goals::near::NearWished;
    use crate::hollow::levels::PrintLevels;
    use crate::hollow::testing::leaning_block;
    use crate::hollow::worlds::{self, World};
    use crate::interior::moments_where_positive;

    /// Splits the block in two, aslant.
    const SLANTED: Quadric = Quadric([-0.5, 0.4, 0.1, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);

    fn range() -> DensityRange {
        DensityRange::new(0.15, 1.0).unwrap()
    }

    /// Returns a leaning block beside a fixed mass, as a match with these moments.
    fn world(wanted: impl Fn(&World) -> Moments) -> World {
        let mut world = worlds::blocks_on_a_slope();
        world.columns = leaning_block(0.5);
        let beside = Moments(Moments::monomials(0.3, -0.2, 0.5)) * 60.0;
        world.fixed = world.columns.moments() + beside;
        let moments = wanted(&world);
        world.goal.kind = GoalKind::Match;
        world.goal.objective = Objective::LeastChange;
        world.goal.solid = world.fixed;
        world.goal.wanted = Some(Wanted {
            moments,
            density_g_mm3: 1e-3,
        });
        world
    }

    fn solve(world: &World) -> Solution {
        let near = NearWished {
            wished: 0.575,
            levels: PrintLevels::even(range(), 4).unwrap(),
            least_angle_rad: 0.0,
            keep: None,
        };
        near.solve(&world.problem(), None, &Watch::silent())
    }

    /// Returns the moments with the density 0.8 where a slanted quadric is positive, and 0.4
    /// elsewhere.
    fn in_two_parts(world: &World) -> Moments {
        let all = world.columns.moments();
        let above = moments_where_positive(&world.columns, &SLANTED);
        world.fixed - all + above * 0.8 + (all - above) * 0.4
    }

    #[test]
    fn what_some_density_has_is_met_in_all_ten_moments_by_levels() {
        let world = world(in_two_parts);
        let solution = solve(&world);
        assert!(solution.is_usable(), "{:?}", solution.status);
        let wanted = world.goal.wanted.unwrap().moments;
        let scale = wanted.0[7..]
            .iter()
            .fold(0.0_f64, |most, it| most.max(it.abs()));
        for (reached, wanted) in solution.moments.0.iter().zip(wanted.0) {
            assert!(
                (reached - wanted).abs() < 1e-5 * scale,
                "{reached} {wanted}"
            );
        }
        let proof = solution.certificate;
        assert!(
            proof.value > 0.0 && proof.value >= proof.bound - 1e-6,
            "{proof:?}"
        );
    }

    #[test]
    fn a_mass_above_that_of_the_solid_is_refused_with_both_and_the_nearest() {
        let world = world(|world| world.fixed * 1.25);
        let solution = solve(&world);
        let Status::CannotMatch { miss, separator } = solution.status else {
            unreachable!("{:?}", solution.status)
        };
        assert!(solution.status.is_impossible() && miss.least_miss > 0.0);
        assert!((miss.volumes_mm3[1] - world.fixed.volume()).abs() < 1e-9);
        let said = solution.status.explain(&world.goal);
        let grams = |volume: f64| format!("{:.2} g", volume * 1e-3);
        for mass in [1.25 * world.fixed.volume(), world.fixed.volume()] {
            assert!(said.contains(&grams(mass)), "{said}");
        }
        // The proof holds for uniform densities, as for all others.
        let dot = |moments: &Moments| {
            let pairs = separator.0.iter().zip(moments.0);
            pairs.map(|(c, moment)| c * moment).sum::<f64>()
        };
        let shell = world.fixed - world.columns.moments();
        let wanted = dot(&world.goal.wanted.unwrap().moments);
        for density in [0.15, 0.5, 1.0] {
            let moments = shell + world.columns.moments() * density;
            assert!(dot(&moments) > wanted, "{density}");
        }
    }

    #[test]
    fn a_mass_below_the_lightest_and_a_centre_out_of_reach_are_told_apart() {
        let light = world(|world| world.fixed * 0.1);
        let said = solve(&light).status.explain(&light.goal);
        assert!(said.contains("at its lightest"), "{said}");
        let aside = world(|world| {
            let half = world.fixed - world.columns.moments() * 0.5;
            half.translated(&crate::geom::Vector::new(3.0, 0.0, 0.0))
        });
        let said = solve(&aside).status.explain(&aside.goal);
        assert!(said.contains("together"), "{said}");
    }

    #[test]
    fn one_void_has_the_moments_of_a_void_and_of_no_other_body() {
        let emptied = world(|world| world.fixed - moments_where_positive(&world.columns, &SLANTED));
        let status = solve_void(&emptied.problem()).status;
        assert!(!status.is_impossible(), "{status:?}");
        let inside = world(in_two_parts);
        let status = solve_void(&inside.problem()).status;
        assert!(
            matches!(status, Status::IterationLimit { .. }),
            "{status:?}"
        );
        let heavy = world(|world| world.fixed * 2.0);
        assert!(solve_void(&heavy.problem()).status.is_impossible());
    }
}
