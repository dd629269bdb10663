//! Filled voids: another material replaces what is emptied of the print.
//!
//! A filled grain weighs ρ_fill instead of ρ. So the moments are s = s_fixed − κ ∫β m with the
//! relief κ = 1 − ρ_fill/ρ. This is the convex set for air (κ = 1), scaled by κ, and reflected if
//! the filling is the heavier material (κ < 0).
//!
//! Dividing all moments by |κ| gives the problem of [`crate::hollow::solve`]. Ratios and equations
//! without a constant do not change. The mass of a floating object is divided like the rest. If κ <
//! 0, the solver starts with the body filled everywhere, and its void is the region not to fill. So
//! the filled void is where its quadric is negative.
//!
//! Source: the second material of Spin-It (Bächer et al. 2014, §6), which they leave to the same
//! equations.

use crate::base::watch::Watch;
use crate::field::DensityRange;
use crate::geom::Quadric;
use crate::goal::Goal;
use crate::hollow::{Problem, Settings, Solution, refine, solve};
use crate::interior::{Columns, moments_where_positive};
use crate::mass::Moments;

/// The contents of the voids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fill {
    density_ratio: f64,
    /// The density over that of the print of what is neither filled nor wall.
    rest_ratio: f64,
}

/// Least difference of the densities, as a share of the print's. With a smaller one the effect
/// would take voids of any size.
const LEAST_RELIEF: f64 = 0.02;

impl Fill {
    /// Air.
    pub const AIR: Self = Self {
        density_ratio: 0.0,
        rest_ratio: 1.0,
    };

    /// Returns a filling `density_ratio` times as dense as the print. `None` if that is negative,
    /// not finite, or within two per cent of the print's own density.
    pub fn new(density_ratio: f64) -> Option<Self> {
        let is_filling = density_ratio.is_finite() && density_ratio >= 0.0;
        (is_filling && (density_ratio - 1.0).abs() >= LEAST_RELIEF).then_some(Self {
            density_ratio,
            ..Self::AIR
        })
    }

    /// Returns the filling of a print whose interior has the least density of a range in its voids,
    /// and the greatest elsewhere.
    pub fn between(range: DensityRange) -> Self {
        Self {
            density_ratio: range.low(),
            rest_ratio: range.high(),
        }
    }

    /// Returns the density over that of the print.
    pub fn density_ratio(&self) -> f64 {
        self.density_ratio
    }

    /// Returns true if the filling is heavier than what is around it.
    pub fn is_heavier(&self) -> bool {
        self.density_ratio > self.rest_ratio
    }

    /// Returns the weight saved by filling a grain, as a share of a printed one; negative for a
    /// heavier filling.
    fn relief(&self) -> f64 {
        self.rest_ratio - self.density_ratio
    }

    /// Returns the moments that the interior, with these at full density, lacks where it is not
    /// filled.
    fn lost(&self, all: Moments) -> Moments {
        all * (1.0 - self.rest_ratio)
    }

    /// Returns the moments of a body with the void { quadric > 0 } filled; `fixed` are its moments
    /// without a void.
    pub fn filled(&self, fixed: Moments, columns: &Columns, quadric: &Quadric) -> Moments {
        fixed
            - self.lost(columns.moments())
            - moments_where_positive(columns, quadric) * self.relief()
    }

    /// Finds the best filled void: by [`solve`], or by [`refine`] from a known solution.
    ///
    /// The solution is in the print's own moments. Its void is where the quadric is positive, as
    /// with air. The certificate is for this filling.
    #[must_use]
    pub fn solve(&self, problem: &Problem, known: Option<&Solution>, watch: &Watch) -> Solution {
        let settings = Settings::default();
        let solver = |problem: &Problem| match known.filter(|known| known.is_usable()) {
            Some(known) => refine(problem, &settings, known, watch),
            None => solve(problem, &settings, watch),
        };
        self.solve_by(problem, problem.columns.moments(), solver)
    }

    /// Finds the best filled void by a solver of empty ones, which is asked for the scaled problem.
    ///
    /// `all` are the moments of all columns in the goal's frame. The columns themselves may have
    /// another, if the solver takes them so.
    #[must_use]
    pub fn solve_by(
        &self,
        problem: &Problem,
        all: Moments,
        solver: impl FnOnce(&Problem) -> Solution,
    ) -> Solution {
        let weight = self.relief().abs();
        let goal = scaled(problem.goal, 1.0 / weight);
        let whole = if self.is_heavier() {
            all * weight
        } else {
            Moments::default()
        };
        let solution = solver(&Problem {
            goal: &goal,
            fixed: (problem.fixed - self.lost(all) + whole) * (1.0 / weight),
            columns: problem.columns,
        });
        solution.stretched(weight, self.is_heavier())
    }
}

/// Returns the goal with every moment and mass scaled.
pub(super) fn scaled(goal: &Goal, factor: f64) -> Goal {
    let mut goal = goal.clone();
    goal.solid = goal.solid * factor;
    if let Some(afloat) = &mut goal.afloat {
        afloat.material_mm3 *= factor;
    }
    if let Some(wanted) = &mut goal.wanted {
        wanted.moments = wanted.moments * factor;
    }
    goal
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::{Objective, compute_figures};
    use crate::hollow::worlds::{self, World};

    fn solve_filled(world: &World, density_ratio: f64) -> Solution {
        let fill = Fill::new(density_ratio).unwrap();
        fill.solve(&world.problem(), None, &Watch::silent())
    }

    #[test]
    fn a_filling_of_nothing_is_a_void() {
        let world = worlds::egg(Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        });
        let air = solve(&world.problem(), &Settings::default(), &Watch::silent());
        assert_eq!(solve_filled(&world, 0.0), air);
        assert_eq!(
            Fill::AIR
                .solve(&world.problem(), Some(&air), &Watch::silent())
                .status,
            air.status
        );
    }

    #[test]
    fn the_moments_of_a_filled_body_are_those_of_its_void_and_its_filling() {
        for density_ratio in [0.4, 3.0] {
            let world = worlds::egg(Objective::SpinIt {
                gamma_c: 0.0,
                gamma_i: 1.0,
            });
            let solution = solve_filled(&world, density_ratio);
            assert!(solution.is_usable(), "{:?}", solution.status);
            let fill = Fill::new(density_ratio).unwrap();
            let moments = fill.filled(world.fixed, &world.columns, &solution.quadric);
            for (got, want) in solution.moments.0.iter().zip(moments.0) {
                assert!(
                    (got - want).abs() <= 1e-9 * world.fixed.0[0],
                    "{density_ratio}: {got} {want}"
                );
            }
        }
    }

    #[test]
    fn of_all_65536_ways_to_fill_sixteen_blocks_none_stands_better_than_the_bound() {
        for density_ratio in [0.5, 4.0] {
            let world = worlds::blocks_on_a_slope();
            let solution = solve_filled(&world, density_ratio);
            assert!(solution.is_usable() && solution.certificate.gap_ratio.abs() < 1e-6);
            let relief = 1.0 - density_ratio;
            let (mut best, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
            worlds::each_choice(&world, &worlds::single_blocks(16), |emptied| {
                // The removed moments of a choice, times the relief.
                let moments = world.fixed + (*emptied - world.fixed) * relief;
                let angle = compute_figures(&world.goal, &moments)
                    .toppling_angle_rad
                    .unwrap();
                (best, least) = (f64::max(best, angle), f64::min(least, angle));
            });
            assert!(
                best <= solution.certificate.bound + 1e-12,
                "{density_ratio}"
            );
            // Whole blocks come close to the best plane, which may cut them.
            assert!(
                best > least + 0.8 * (solution.certificate.value - least),
                "{best} {least}"
            );
        }
    }

    #[test]
    fn between_two_densities_it_is_the_best_of_them() {
        let world = worlds::blocks_on_a_slope();
        for (low, high) in [(0.15, 1.0), (0.1, 0.7)] {
            let range = DensityRange::new(low, high).unwrap();
            let fill = Fill::between(range);
            let solution = fill.solve(&world.problem(), None, &Watch::silent());
            let best =
                crate::hollow::best_densities(&world.problem(), range, None, &Watch::silent());
            assert!((solution.certificate.value - best.certificate.value).abs() < 1e-12);
            let moments = fill.filled(world.fixed, &world.columns, &solution.quadric);
            for (got, want) in moments.0.iter().zip(solution.moments.0) {
                assert!(
                    (got - want).abs() <= 1e-9 * world.fixed.0[0],
                    "{got} {want}"
                );
            }
        }
    }

    #[test]
    fn a_filling_like_the_print_is_none() {
        assert!(
            [1.0, 1.01, -0.1, f64::NAN, f64::INFINITY]
                .iter()
                .all(|&ratio| Fill::new(ratio).is_none())
        );
        assert!(
            [0.0, 0.5, 1.5, 7.0]
                .iter()
                .all(|&ratio| Fill::new(ratio).is_some())
        );
    }
}
