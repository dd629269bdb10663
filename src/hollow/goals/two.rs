//! Two densities at their best: every goal's optimum over all densities of a range.
//!
//! The moments are s = s_fixed − (1 − high) ∫m − (high − low) ∫β m. That is the set of a hollowed
//! body, scaled, with another fixed part. Its corners have one of the two densities everywhere,
//! across one quadric. So a density that varies smoothly never does better.

use super::fill::scaled;
use crate::base::watch::Watch;
use crate::field::DensityRange;
use crate::hollow::{Problem, Settings, Solution, refine, solve};

/// Finds the best density of a range for a goal: by [`solve`], or by [`refine`] from a known
/// solution.
///
/// The density is the lower one where the solution's quadric is positive, and the upper one
/// elsewhere. `problem.fixed` are the moments of the body at density 1. Moments, value and bound
/// are those of the body with the densities.
#[must_use]
pub fn best_densities(
    problem: &Problem,
    range: DensityRange,
    known: Option<&Solution>,
    watch: &Watch,
) -> Solution {
    let span = range.span();
    let goal = scaled(problem.goal, 1.0 / span);
    let lost = problem.columns.moments() * (1.0 - range.high());
    let problem = Problem {
        goal: &goal,
        fixed: (problem.fixed - lost) * (1.0 / span),
        columns: problem.columns,
    };
    let settings = Settings::default();
    let solution = match known.filter(|known| known.is_usable()) {
        Some(known) => refine(&problem, &settings, known, watch),
        None => solve(&problem, &settings, watch),
    };
    solution.stretched(span, false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::goal::{Objective, compute_figures};
    use crate::hollow::worlds;
    use crate::mass::Moments;

    fn range(low: f64, high: f64) -> DensityRange {
        DensityRange::new(low, high).unwrap()
    }

    #[test]
    fn the_whole_range_is_hollowing() {
        let world = worlds::egg(Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        });
        let hollow = solve(&world.problem(), &Settings::default(), &Watch::silent());
        let two = best_densities(&world.problem(), range(0.0, 1.0), None, &Watch::silent());
        assert!((two.certificate.value - hollow.certificate.value).abs() < 1e-9);
    }

    #[test]
    fn of_all_65536_ways_to_print_sixteen_blocks_none_stands_better_than_two_densities() {
        for (low, high) in [(0.15, 1.0), (0.1, 0.7)] {
            let world = worlds::blocks_on_a_slope();
            let solution =
                best_densities(&world.problem(), range(low, high), None, &Watch::silent());
            assert!(solution.is_usable() && solution.certificate.gap_ratio.abs() < 1e-6);
            let lost = world.columns.moments() * (1.0 - high);
            let mut best = f64::NEG_INFINITY;
            worlds::each_choice(&world, &worlds::single_blocks(16), |emptied| {
                let moments = world.fixed - lost + (*emptied - world.fixed) * (high - low);
                let figures = compute_figures(&world.goal, &moments);
                best = f64::max(best, figures.toppling_angle_rad.unwrap());
            });
            assert!(best <= solution.certificate.bound + 1e-12, "{low}..{high}");
            assert!(best > 0.8 * solution.certificate.value, "{best}");
        }
    }

    #[test]
    fn of_a_thousand_smooth_fields_none_stands_better_than_two_densities() {
        let (low, high) = (0.15, 0.9);
        let world = worlds::blocks_on_a_slope();
        let solution = best_densities(&world.problem(), range(low, high), None, &Watch::silent());
        let mut random = Random::new(17);
        let mut best = f64::NEG_INFINITY;
        for _ in 0..1000 {
            let quadric: [f64; 10] = std::array::from_fn(|_| random.between(-1.0, 1.0));
            let swing = random.between(0.1, 3.0);
            let density = |x: f64, y: f64, z: f64| {
                let monomials = Moments::monomials(0.3 * x, 0.3 * y, 0.3 * z);
                let value: f64 = quadric.iter().zip(monomials).map(|(q, m)| q * m).sum();
                0.5 * (low + high) + 0.5 * (high - low) * (swing * value).sin()
            };
            let lost = lost_moments(&world, density);
            let figures = compute_figures(&world.goal, &(world.fixed - lost));
            best = f64::max(
                best,
                figures.toppling_angle_rad.unwrap_or(f64::NEG_INFINITY),
            );
        }
        assert!(best <= solution.certificate.bound + 1e-12);
    }

    /// Returns ∫ (1 − d) m over the columns, with the density constant over thin slices of cells.
    fn lost_moments(world: &worlds::World, density: impl Fn(f64, f64, f64) -> f64) -> Moments {
        const SLICES: u32 = 8;
        let columns = &world.columns;
        let area_mm2 = columns.pitch_mm[0] * columns.pitch_mm[1];
        let mut sum = Moments::default();
        for index in 0..columns.len() {
            let [x, y] = columns.centers[index];
            for &[bottom, top] in columns.intervals_of(index) {
                let height = (top - bottom) / f64::from(SLICES);
                for slice in 0..SLICES {
                    let z = bottom + (f64::from(slice) + 0.5) * height;
                    let mut moments = Moments(Moments::monomials(x, y, z));
                    moments.0[7] += columns.pitch_mm[0].powi(2) / 12.0;
                    moments.0[8] += columns.pitch_mm[1].powi(2) / 12.0;
                    moments.0[9] += height * height / 12.0;
                    sum += moments * (area_mm2 * height * (1.0 - density(x, y, z)));
                }
            }
        }
        sum
    }
}
