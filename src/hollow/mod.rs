//! The solver: which part of the interior to empty, and the proof that nothing else is better.
//!
//! # The question
//! A solid may lose material anywhere but in its wall. Which part should go, so that it spins as
//! slowly as possible without falling, or leans as far as possible without toppling? There seems to
//! be one yes or no for every grain of the interior. There are ten numbers.
//!
//! # Ten moments in
//! Mass, centre and inertia tensor of a body are functions of ten integrals, its moments
//!
//! ```text
//! s = ∫ m(x) dV,    m(x) = (1, x, y, z, xy, yz, xz, x², y², z²)        (Spin-It eq. 4)
//! ```
//!
//! and so is every goal here; the density cancels. The moments that some hollowing reaches form a
//! set K in ten dimensions. K is convex, since emptying is s_fixed − ∫ β m dV, linear in the
//! removed share β(x) ∈ [0, 1]. Shares between 0 and 1 cannot be printed, and they are not needed.
//! Every point of K is also reached by removing each grain wholly or not at all (Lyapunov).
//!
//! # Ten coefficients out
//! A linear function g·s is least over K if exactly those grains are removed that make it larger.
//! The grain at x contributes g·m(x), so the void is
//!
//! ```text
//! { x in the interior : q(x) > 0 },    q(x) = g·m(x)
//! ```
//!
//! the interior on one side of a single quadric surface. One pass over the interior's columns finds
//! this point of K, exactly in z, and its derivative W = −∂s/∂g
//! ([`crate::interior::moments_and_derivative`]). At any resolution the unknown is g: there is no
//! variable per voxel and no final rounding.
//!
//! # Every goal is a quasi-convex programme
//! A goal minimises a convex function of s over a positive linear one, subject to linear rows:
//!
//! ```text
//! minimise (n·s + max over y ∈ Y of yᵀJs) / (e·s)    over s ∈ K with As = b
//! ```
//!
//! | goal | rows | ratio |
//! |---|---|---|
//! | yo-yo, functional | s_x, s_y, s_xz, s_yz, s_z | ‖(I_xx, √2 I_xy, I_yy)‖ / I_zz (eq. 2, 5, 6) |
//! | yo-yo, dominance | the same | λ_max(I) / I_zz = I_b/I_c |
//! | top, critical speed | s_x, s_y, s_xz, s_yz | (λ_max(I′) − I_zz) / s_z = −g/ω² (eq. 1) |
//! | top, functional | the same, s_z if γ_c > 0 | ‖(I′_xx, √2 I′_xy, I′_yy)‖ / I_zz (eq. 3, 7) |
//! | stand, tilt | none | max over edges of (d s₁ − n·s_xy) / s_z = −tan(toppling angle) |
//! | stand, lowest centre | s_x, s_y | s_z / s₁ |
//! | float | s_x − x_b s₁, s_y − y_b s₁, s₁ = ρ_w V_b | s_z (no ratio; Wu et al. eq. 3 to 5) |
//! | balance, least removed | s_x, s_y, s_xz, s_yz | −s₁ (no ratio) |
//! | balance, least unbalance | none | ‖(U_A, U_B)‖ / s₁, the unbalances in the two end planes |
//!
//! Equation numbers are those of Spin-It unless stated otherwise. Its functional is the square of
//! the ratio. Here λ_max is that of the 2 × 2 tensor across the axis: half the trace plus the
//! length of a 2-vector. Y is the unit ball for the norms and the unit disc for λ_max. It is the
//! simplex for the largest over the edges of the support.
//!
//! # The one number that breaks convexity
//! A top's tensor is about its centre, I′ = I − s_z²/s₁ across the axis. The term s_z²/s₁ is
//! convex, so the objective is convex *less* convex. But let h = s_z/s₁ be the height of the
//! centre. Then for every number ℓ
//!
//! ```text
//! s_z²/s₁ = (2ℓ s_z − ℓ² s₁) + s₁ (h − ℓ)²
//! ```
//!
//! so the tensor linearised at ℓ is never too small, and exact at h = ℓ. Hence:
//!
//! * The least over ℓ of the quasi-convex programmes at ℓ *is* the optimum over all interiors of
//!   any height, without a row for the height. The search over that one number is smooth, and its
//!   slope is free (`heights`).
//! * Let κ be the share of s_z²/s₁ in the numerator. Suppose that every interior is above a target
//!   at ℓ by a margin of δ s₁. Then every interior with its centre within √(δ/κ) of ℓ is truly
//!   above it. About twelve such ℓ prove 1e-6 over all heights (`cover`).
//!
//! Spin-It's γ_c adds a second such number, the lever s_z. Its functional k s_z² + γρ² is no ratio,
//! but at a given lever it is. Along a polygon around the ellipse k s_z² + γρ² = V two levers prove
//! the bound for all between them (`frontier`).
//!
//! # The dual has at most ten variables
//! For weights y ∈ Y, multipliers λ and a trial ratio τ put g = n + Jᵀy − τe + Aᵀλ. Then
//!
//! ```text
//! D(y, λ, τ) = min over K of g·s − b·λ
//! ```
//!
//! is concave and costs one pass. D ≥ 0 proves that no interior has a ratio below τ. Its gradient
//! is (Js, As − b) and its curvature −[J; A] W [J; A]ᵀ, so Newton's method climbs it. Each step
//! maximises the quadratic model over Y and all λ, damped where the model predicts badly. It also
//! moves τ to where D vanishes (Dinkelbach). A cold start takes about ten passes. A start from
//! coarser columns takes about four, as g is equally good there.
//!
//! # Most passes need only a few of the columns
//! Every fourth column of every fourth row suffices to find the dual points worth a pass. The set K
//! of these columns, mapped so that it osculates the true one, is convex as well. All columns are
//! needed only for the answer and its proof. That is seven to fifteen passes for a top's search,
//! and one without W for each height in the proof (`mend`, `scout`).
//!
//! # What is proved
//! * **The quality of the answer.** The same g gives the interior and the bound, so a
//!   [`Certificate`] holds both; they meet within about 1e-9. A top's bound is also extended to
//!   every other height of its centre, and is then 5e-7 lower.
//! * **That the constraints cannot be met.** If D grows without bound along λ, the quadric (Aᵀλ)·m
//!   has a positive integral over every interior. For one that meets the rows it would be zero.
//! * **That no interior is stable, stands, is balanced or rights itself.** The bound itself is on
//!   the wrong side: I_b/I_c ≥ 1, an angle ≤ 0, a grade above the requested one, a metacentric
//!   height ≤ 0.
//!
//! Each is an answer, not an error: a [`Status`], with a sentence and remedies.
//!
//! # Files
//! In reading order:
//!
//! | file | holds |
//! |---|---|
//! | `dual/`: `reach` | K and its extreme points |
//! | `dual/`: `programme`, `table` | the table above |
//! | `dual/`: `set` | the ball and the simplex |
//! | `dual/`: `visit`, `step`, `ascent` | Newton's climb |
//! | `dual/`: `work` | the state of a run |
//! | `dual/`: `mend`, `scout` | the search on a few columns |
//! | `dual/`: `answer` | the way back to mm, with a status |
//! | `goals/`: `yoyo`, `stand`, `float`, `balance` | the programmes of each goal, one or two |
//! | `goals/`: `ballast` | the least of a denser material if hollowing is not enough |
//! | `goals/`: `fill` | filled voids |
//! | `goals/`: `two` | two densities instead of a void |
//! | `goals/`: `near`, `matching` | levels near a wished density, and those of a wanted body |
//! | `graded` | rows over a body of any density, in units |
//! | `newton` | Newton's method with bounds |
//! | `range` | the least and greatest density that can do it |
//! | `nearest`, `miss` | the density whose moments are nearest to wanted ones |
//! | `family/`, `field_miss` | the fields of a paper, fitted to rows, and how far they are off |
//! | `goals/`: `printed_field` | such a field in printed steps |
//! | `change`, `levels` | the least change of a wished density, smooth or in steps |
//! | `top/`: `heights`, `valley`, `lever`, `search` | the search over heights |
//! | `top/`: `posts`, `cover`, `frontier` | the proof over all heights |
//! | `top/`: `course` | the data of the plots |
//! | `proof` | the proof as numbers for a judge |
//! | `papers/` (feature `papers`) | Spin-It's octree and the rays and voxels of Wu et al. |
//!
//! Those of the papers solve the same [`Problem`], behind one trait with this solver.
//!
//! # Use
//! ```
//! # use equipoise::{base::watch::Watch, geom::Point, goal, hollow, interior::Columns};
//! # use equipoise::mesh::{Solid, TriMesh};
//! # let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -10.0 } else { 10.0 });
//! # let faces =
//! #     [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
//! # let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
//! # let mesh = TriMesh::new((0..8).map(|i| Point::from(corner(i))).collect(), triangles)?;
//! # let solid = Solid::new(mesh)?;
//! # let columns = Columns {
//! #     pitch_mm: [18.0, 18.0],
//! #     centers: vec![[0.0, 0.0]],
//! #     starts: vec![0, 1],
//! #     intervals: vec![[1.0, 19.0]],
//! # };
//! let placed = goal::place(&solid, 1.0, &goal::Request::new(goal::GoalKind::Stand))?;
//! let problem = hollow::Problem {
//!     goal: &placed.goal,
//!     fixed: placed.goal.solid,
//!     columns: &columns,
//! };
//! let solution = hollow::solve(&problem, &hollow::Settings::default(), &Watch::silent());
//! assert_eq!(solution.status, hollow::Status::Solved);
//! assert!(solution.certificate.gap_ratio.abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Sources: Bächer, Whiting, Bickel, Sorkine-Hornung, "Spin-It: Optimizing moment of inertia for
//! spinnable objects", ACM TOG 33(4), 2014. Prévost, Whiting, Lefebvre, Sorkine-Hornung, "Make It
//! Stand", ACM TOG 32(4), 2013. Wu, Kramer, Westermann, "Shape interior modeling and mass property
//! optimization using ray-reps", Computers & Graphics 58, 2016. Dinkelbach, "On nonlinear
//! fractional programming", Management Science 13, 1967.

mod change;
mod dual;
mod family;
mod field_miss;
mod goals;
mod golden;
mod graded;
mod levels;
mod log;
mod miss;
mod nearest;
mod newton;
#[cfg(any(test, feature = "papers"))]
pub mod papers;
mod problem;
mod proof;
mod range;
mod solution;
mod status;
#[cfg(test)]
mod testing;
mod top;
#[cfg(test)]
mod worlds;

use crate::base::watch::Watch;
use crate::goal::GoalKind;

pub use change::{Change, least_change};
pub use family::{Family, Region, Shape, SmoothFit, fit_smooth};
pub use field_miss::FieldMiss;
pub use goals::ballast::{Ballast, has_margin, least_ballast};
pub use goals::drawn_field::{DrawnBody, DrawnField, DrawnRegion};
pub use goals::fill::Fill;
pub use goals::near::{NearWished, TILT_MARGIN_RAD, rows};
pub use goals::printed_field::PrintField;
pub use goals::trade::Trade;
pub use goals::two::best_densities;
pub use golden::golden_section;
pub use graded::{Graded, Row, Sense, Separation};
pub use levels::{LevelChange, LevelCountError, PrintLevels, least_level_change};
pub use log::{LogRow, Pass, Stage};
pub use miss::MatchMiss;
pub use nearest::{Match, Nearest, match_moments};
#[cfg(any(test, feature = "papers"))]
pub use papers::{
    Accuracy, ByOctree, ByQuadric, ByRays, ByVoxels, Found, Method, MethodError, Outcome, Rounding,
};
pub use problem::{Problem, Settings};
pub use proof::{Proof, ProofPoint, prove};
pub use range::{Threshold, greatest_low, least_high};
pub use solution::{Certificate, Figure, Solution};
pub use status::{Obstacle, Status};
pub use top::course::{TopCourse, top_course};

use dual::answer::Conversion;
use dual::work::Work;
use goals::{balance, float, matching, stand, yoyo};

/// Finds the best interior, or the proof that none meets the goal, from a cold start.
///
/// At 100 columns a side a top takes seven to fifteen passes. Its proof over all heights takes a
/// dozen more without derivative, or about two hundred if the lever is weighed. Other goals take
/// five to ten passes. Cancelling `watch` ends the run after the current pass, with
/// [`Status::Cancelled`].
#[must_use]
pub fn solve(problem: &Problem, settings: &Settings, watch: &Watch) -> Solution {
    rayon::scope(|_| solve_for_goal(problem, Work::new(problem, settings, watch)))
}

/// Solves on columns given in model coordinates instead of the goal's.
///
/// One set of columns then serves every goal placed in the model. A pass costs the same. The cells
/// are exact in any frame, but not upright in the goal's.
#[must_use]
pub fn solve_on_model_columns(problem: &Problem, settings: &Settings, watch: &Watch) -> Solution {
    rayon::scope(|_| {
        solve_for_goal(
            problem,
            Work::new(problem, settings, watch).on_model_columns(),
        )
    })
}

fn solve_for_goal(problem: &Problem, work: Work) -> Solution {
    let objective = problem.goal.objective;
    let answer = match problem.goal.kind {
        GoalKind::Top => top::solve(&work, objective),
        GoalKind::Yoyo => yoyo::solve(&work, objective, None),
        GoalKind::Stand => stand::solve(&work, objective, None),
        GoalKind::Float => float::solve(&work, objective, None),
        GoalKind::Balance => balance::solve(&work, objective, None),
        GoalKind::Match => return matching::solve_void(problem),
    };
    answer.into_solution(work)
}

/// Solves from a known solution of the same goal on coarser columns, or with slightly different
/// fixed moments.
///
/// Takes three to seven passes. The certificate is for these columns and moments, without a top's
/// bound over all heights ([`bound_over_heights`] proves that). If `known` does not help, it solves
/// from a cold start.
#[must_use]
pub fn refine(problem: &Problem, settings: &Settings, known: &Solution, watch: &Watch) -> Solution {
    rayon::scope(|_| refine_known(problem, settings, known, watch))
}

/// Proves a bound on a top whatever the height of its centre, on columns for which a solution is
/// known.
///
/// Returns it in the figure of the known certificate; it is within 1e-6 of the value, relative.
/// `None` for other goals, for fewer than 1200 columns ([`solve`] proves it there), or if the proof
/// fails.
///
/// Costs one pass, and one without derivative per post: a dozen, or two hundred if Spin-It's
/// functional weighs the lever.
#[must_use]
pub fn bound_over_heights(
    problem: &Problem,
    settings: &Settings,
    known: &Solution,
    watch: &Watch,
) -> Option<f64> {
    if problem.goal.kind != GoalKind::Top || !known.is_usable() {
        return None;
    }
    rayon::scope(|_| {
        let work = Work::new(problem, settings, watch);
        let ratio = top::prove_bound_near(&work, known.objective, &known.warm)?.bound;
        let moments = work.reach.scale.moments_to_units(&known.moments);
        let conversion = Conversion {
            work: &work,
            objective: known.objective,
            figure: known.certificate.figure,
        };
        Some(conversion.figure_of(&moments, ratio))
    })
}

fn refine_known(
    problem: &Problem,
    settings: &Settings,
    known: &Solution,
    watch: &Watch,
) -> Solution {
    if !known.is_usable() {
        return solve(problem, settings, watch);
    }
    let work = Work::new(problem, settings, watch).for_warm_start();
    let (objective, start) = (known.objective, Some(&known.warm.point));
    let answer = match problem.goal.kind {
        GoalKind::Top => top::refine(&work, objective, &known.warm),
        GoalKind::Yoyo => Some(yoyo::solve(&work, objective, start)),
        GoalKind::Stand => Some(stand::solve(&work, objective, start)),
        GoalKind::Float => Some(float::solve(&work, objective, start)),
        // A goal that could not be balanced on coarser columns may be on these.
        GoalKind::Balance => Some(balance::solve(&work, problem.goal.objective, start)),
        GoalKind::Match => None,
    };
    answer.map_or_else(
        || solve(problem, settings, watch),
        |answer| answer.into_solution(work),
    )
}

#[cfg(test)]
mod tests {
    use super::worlds::{self, World};
    use super::*;
    use crate::geom::Quadric;
    use crate::goal::{Objective, compute_figures};
    use crate::interior::moments_where_positive;
    use crate::mass::Moments;

    fn solve_well(world: &World) -> Solution {
        let solution = solve(&world.problem(), &Settings::default(), &Watch::silent());
        assert_eq!(solution.status, Status::Solved, "{:?}", solution.log);
        assert!(
            solution.certificate.gap_ratio.abs() <= 1e-6 && solution.certificate.residual <= 1e-7
        );
        solution
    }

    #[test]
    fn the_moments_of_a_solution_are_those_of_its_quadric() {
        let world = worlds::egg(Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        });
        let solution = solve_well(&world);
        let emptied = moments_where_positive(&world.columns, &solution.quadric);
        for (got, want) in solution.moments.0.iter().zip((world.fixed - emptied).0) {
            assert!(
                (got - want).abs() <= 1e-9 * world.fixed.0[0],
                "{got} {want}"
            );
        }
    }

    #[test]
    fn a_bottle_has_its_lowest_centre_when_filled_up_to_it() {
        // A light bottle has the mass m₀ centred at h₀, and the inner area A. Filled to t its
        // centre is at (m₀h₀ + At²/2)/(m₀ + At). That is least if t equals that height: t = (√(m₀²
        // + 2Am₀h₀) − m₀)/A.
        let world = worlds::bottle();
        let (m0, h0, area) = (40.0, 9.0, 16.0);
        let filled = (f64::sqrt(m0 * m0 + 2.0 * area * m0 * h0) - m0) / area;
        let solution = solve_well(&world);
        assert!((solution.certificate.value / filled - 1.0).abs() < 1e-9);
        let level = -solution.quadric.0[0] / solution.quadric.0[3];
        assert!((level / filled - 1.0).abs() < 1e-6);
    }

    #[test]
    fn none_of_65536_ways_to_empty_blocks_stands_better_than_the_bound() {
        let world = worlds::blocks_on_a_slope();
        let solution = solve_well(&world);
        let mut best = f64::NEG_INFINITY;
        worlds::each_choice(&world, &worlds::single_blocks(16), |moments| {
            best = best.max(
                compute_figures(&world.goal, moments)
                    .toppling_angle_rad
                    .unwrap(),
            );
        });
        assert!(best <= solution.certificate.bound + 1e-12);
        // Sixteen whole blocks come close to the best plane, which may cut them; the solid is far
        // off.
        let solid = compute_figures(&world.goal, &world.fixed)
            .toppling_angle_rad
            .unwrap();
        assert!(
            best > solid + 0.8 * (solution.certificate.value - solid),
            "{best} {solid}"
        );
    }

    #[test]
    fn of_all_balanced_ways_to_empty_mirrored_blocks_none_beats_a_yoyo() {
        for objective in [
            Objective::SpinIt {
                gamma_c: 0.0,
                gamma_i: 1.0,
            },
            Objective::Dominance,
        ] {
            let world = worlds::mirrored_blocks(objective);
            let solution = solve_well(&world);
            let mut best = f64::INFINITY;
            worlds::each_choice(&world, &worlds::mirrored_groups(), |moments| {
                let figures = compute_figures(&world.goal, moments);
                let value = if objective == Objective::Dominance {
                    Some(figures.dominance_ratio)
                } else {
                    figures.spin_it
                };
                best = best.min(value.unwrap());
            });
            assert!(
                best >= solution.certificate.bound - 1e-12,
                "{best} {:?}",
                solution.certificate
            );
        }
    }

    #[test]
    fn of_all_round_ways_to_empty_a_disc_none_is_a_better_top_whatever_its_height() {
        let spin_it = |gamma_c| Objective::SpinIt {
            gamma_c,
            gamma_i: 1.3,
        };
        for objective in [Objective::CriticalSpeed, spin_it(0.0), spin_it(0.9)] {
            let world = worlds::rings(objective);
            let solution = solve_well(&world);
            let mut best = f64::INFINITY;
            worlds::each_choice(&world, &worlds::ring_groups(&world), |moments| {
                let figures = compute_figures(&world.goal, moments);
                let value = match objective {
                    Objective::CriticalSpeed => figures.critical_speed_rpm,
                    _ => figures.spin_it,
                };
                best = best.min(value.unwrap_or(f64::INFINITY));
            });
            let (value, bound) = (
                solution.certificate.value,
                solution.certificate.bound_over_heights.unwrap(),
            );
            assert!(
                bound <= value && bound >= (1.0 - 1e-6) * value - 1e-12,
                "{objective:?} {bound} {value}"
            );
            assert!(
                best >= bound && best < 1.2 * bound,
                "{objective:?} {best} {bound}"
            );
        }
    }

    #[test]
    fn a_solution_keeps_what_its_rows_promise() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let figures = compute_figures(&world.goal, &solve_well(&world).moments);
        assert!(
            figures.off_axis_mm < 1e-6 && figures.axis_tilt_rad < 1e-6,
            "{figures:?}"
        );
        assert!(figures.critical_speed_rpm.is_some());
    }

    #[test]
    fn the_figures_of_a_solution_are_its_certificates_value() {
        for gamma_c in [0.0, 0.7] {
            let world = worlds::rings(Objective::SpinIt {
                gamma_c,
                gamma_i: 1.3,
            });
            let solution = solve_well(&world);
            let value = compute_figures(&world.goal, &solution.moments)
                .spin_it
                .unwrap();
            assert!(
                (value / solution.certificate.value - 1.0).abs() < 1e-7,
                "{gamma_c}"
            );
        }
    }

    #[test]
    fn weighing_the_lever_gives_a_lower_lighter_top() {
        let of = |gamma_c| {
            let world = worlds::rings(Objective::SpinIt {
                gamma_c,
                gamma_i: 1.0,
            });
            solve_well(&world).moments
        };
        let (free, weighed) = (of(0.0), of(1.0));
        assert!(weighed.0[3] < 0.9 * free.0[3]);
    }

    /// Returns the number of passes of the search, without the proof over all heights.
    fn passes_of_search(solution: &Solution) -> usize {
        let is_of_search = |row: &&LogRow| !matches!(row.stage, Stage::Cover { .. });
        solution
            .log
            .iter()
            .filter(is_of_search)
            .map(|row| row.passes)
            .sum()
    }

    #[test]
    fn finer_columns_take_few_passes_from_a_coarse_answer() {
        let coarse = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let fine = worlds::egg_on_its_side_at(Objective::CriticalSpeed, 0.25);
        let known = solve_well(&coarse);
        let refined = refine(
            &fine.problem(),
            &Settings::default(),
            &known,
            &Watch::silent(),
        );
        assert_eq!(refined.status, Status::Solved);
        assert!(passes_of_search(&refined) <= 8, "{:?}", refined.log);
        let fresh = solve_well(&fine);
        assert!((refined.certificate.value / fresh.certificate.value - 1.0).abs() < 1e-7);
    }

    #[test]
    fn a_refined_top_is_proved_best_over_all_heights_on_its_own_columns() {
        for objective in [
            Objective::CriticalSpeed,
            Objective::SpinIt {
                gamma_c: 0.7,
                gamma_i: 1.0,
            },
        ] {
            let coarse = worlds::egg_on_its_side(objective);
            let fine = worlds::egg_on_its_side_at(objective, 0.25);
            let (problem, settings) = (fine.problem(), Settings::default());
            let refined = refine(&problem, &settings, &solve_well(&coarse), &Watch::silent());
            assert_eq!(refined.certificate.bound_over_heights, None);
            let bound =
                bound_over_heights(&problem, &settings, &refined, &Watch::silent()).unwrap();
            let value = refined.certificate.value;
            assert!(
                bound <= value && bound >= (1.0 - 1.1e-6) * value,
                "{objective:?}: {bound} {value}"
            );
        }
    }

    #[test]
    fn a_correction_of_the_fixed_moments_is_met_in_few_passes() {
        let mut world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let known = solve_well(&world);
        let pin = Moments(Moments::monomials(9.0, 4.0, 6.0)) * (2e-4 * world.fixed.0[0]);
        world.fixed += pin;
        let corrected = refine(
            &world.problem(),
            &Settings::default(),
            &known,
            &Watch::silent(),
        );
        assert!(
            corrected.status == Status::Solved && passes_of_search(&corrected) <= 6,
            "{:?}",
            corrected.log
        );
        assert!(compute_figures(&world.goal, &corrected.moments).off_axis_mm < 1e-6);
    }

    #[test]
    fn a_spin_point_out_of_reach_is_refused_with_a_quadric_that_separates() {
        let mut world = worlds::egg(Objective::Dominance);
        let shift = crate::geom::Vector::new(-6.0, 0.0, 0.0);
        world.fixed = world.fixed.translated(&shift);
        world
            .columns
            .centers
            .iter_mut()
            .for_each(|center| center[0] += shift.x);
        world.goal.solid = world.fixed;
        let solution = solve(&world.problem(), &Settings::default(), &Watch::silent());
        let Status::ConstraintsInfeasible {
            obstacle: Obstacle::Center,
            least_miss,
            separator,
        } = solution.status
        else {
            panic!("{:?}", solution.status)
        };
        assert!(least_miss > 0.0);
        for seed in 0..200 {
            let quadric = worlds::some_quadric(seed, 12.0);
            let moments = world.fixed - moments_where_positive(&world.columns, &quadric);
            let integral: f64 = moments.0.iter().zip(separator.0).map(|(s, g)| s * g).sum();
            assert!(
                integral >= least_miss * (1.0 - 1e-9),
                "{seed}: {integral} < {least_miss}"
            );
        }
        assert!(solution.status.explain(&world.goal).contains("spin point"));
    }

    #[test]
    fn a_tower_is_proved_unstable_at_every_height() {
        let solution = solve(
            &worlds::tower().problem(),
            &Settings::default(),
            &Watch::silent(),
        );
        let Status::UnstableForEveryInterior {
            least_ratio,
            proved: true,
        } = solution.status
        else {
            panic!("{:?}", solution.status)
        };
        assert!(least_ratio > 1.0);
    }

    #[test]
    fn a_long_yoyo_is_proved_not_dominant() {
        let world = worlds::long_egg();
        let solution = solve(&world.problem(), &Settings::default(), &Watch::silent());
        assert!(
            matches!(solution.status, Status::NotDominant { least_ratio } if least_ratio > 1.0)
        );
        assert!(!solution.status.remedies(&world.goal).is_empty());
    }

    #[test]
    fn blocks_far_beside_their_support_cannot_stand() {
        let mut world = worlds::blocks_on_a_slope();
        world
            .goal
            .support
            .iter_mut()
            .for_each(|corner| corner[0] -= 20.0);
        let solution = solve(&world.problem(), &Settings::default(), &Watch::silent());
        let Status::CannotStand { greatest_angle_rad } = solution.status else {
            panic!("{:?}", solution.status)
        };
        assert!(greatest_angle_rad < 0.0);
    }

    #[test]
    fn with_nothing_to_empty_a_balanced_solid_is_its_own_answer() {
        let mut world = worlds::rings(Objective::CriticalSpeed);
        world.columns = crate::interior::Columns {
            starts: vec![0],
            ..Default::default()
        };
        let solution = solve_well(&world);
        let solid = compute_figures(&world.goal, &world.fixed)
            .critical_speed_rpm
            .unwrap();
        assert!((solution.certificate.value / solid - 1.0).abs() < 1e-9);
    }

    #[test]
    fn columns_of_the_model_and_of_the_goal_give_the_same_answer() {
        // The same points in a frame that is moved and turned by a quarter, so that cells stay
        // cells.
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let quarter = crate::geom::Matrix::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let frame = crate::geom::Frame {
            origin: crate::geom::Point::new(3.0, -7.0, 11.0),
            axes: quarter,
        };
        let mut goal = world.goal.clone();
        goal.frame = frame;
        let mut columns = world.columns.clone();
        for center in &mut columns.centers {
            let placed = frame.to_model(&crate::geom::Point::new(center[0], center[1], 0.0));
            *center = [placed.x, placed.y];
        }
        columns
            .intervals
            .iter_mut()
            .flatten()
            .for_each(|end| *end += frame.origin.z);
        let problem = Problem {
            goal: &goal,
            columns: &columns,
            ..world.problem()
        };
        let turned = solve_on_model_columns(&problem, &Settings::default(), &Watch::silent());
        let straight = solve_well(&world);
        assert_eq!(turned.status, Status::Solved);
        assert!((turned.certificate.value / straight.certificate.value - 1.0).abs() < 1e-7);
        assert!(
            turned
                .moments
                .0
                .iter()
                .zip(straight.moments.0)
                .all(|(a, b)| (a - b).abs() < 1e-5 * b.abs().max(1.0))
        );
    }

    #[test]
    fn a_cancelled_run_says_so() {
        let watch = Watch::silent();
        watch.cancel();
        for world in [
            worlds::rings(Objective::CriticalSpeed),
            worlds::egg(Objective::Dominance),
            worlds::bottle(),
        ] {
            assert_eq!(
                solve(&world.problem(), &Settings::default(), &watch).status,
                Status::Cancelled
            );
        }
    }

    #[test]
    fn one_thread_and_three_give_the_same_bits() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| solve(&world.problem(), &Settings::default(), &Watch::silent()))
        };
        let (one, three): (Solution, Solution) = (with(1), with(3));
        assert_eq!(
            one.quadric.0.map(f64::to_bits),
            three.quadric.0.map(f64::to_bits)
        );
        assert_eq!(one.log, three.log);
    }

    #[test]
    fn no_random_quadric_that_is_balanced_beats_the_yoyo() {
        // Mirrored copies of any quadric's void are balanced; their union is one more choice of
        // what to empty.
        let world = worlds::mirrored_blocks(Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        });
        let bound = solve_well(&world).certificate.bound;
        for seed in 0..300 {
            let Quadric([c, _, _, _, _, _, _, xx, yy, zz]) = worlds::some_quadric(seed, 6.0);
            let even = Quadric([c, 0., 0., 0., 0., 0., 0., xx, yy, zz]);
            let moments = world.fixed - moments_where_positive(&world.columns, &even);
            assert!(
                compute_figures(&world.goal, &moments).spin_it.unwrap() >= bound - 1e-12,
                "{seed}"
            );
        }
    }
}
