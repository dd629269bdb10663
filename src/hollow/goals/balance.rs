//! The rotor: the least removal that balances it, or the least unbalance of any interior.

use std::f64::consts::SQRT_2;

use crate::goal::{Objective, Spindle};
use crate::hollow::dual::answer::{Answer, grade_mm_s};
use crate::hollow::dual::ascent::{Climb, End};
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::work::Work;
use crate::hollow::status::Status;

/// Finds the balanced interior with the most material.
///
/// If none is balanced, finds the least unbalanced one, with the proof if none reaches the grade.
/// Both objectives share this order. Zero unbalance is the least, and among balanced interiors the
/// one with the most material is as good as any.
pub(crate) fn solve(work: &Work, objective: Objective, start: Option<&DualPoint>) -> Answer {
    let programme = Programme::balance_least_removed();
    let climb = work.ascend(&programme, start);
    let is_balanced = work.accepts(&climb) || objective == Objective::LeastRemoved;
    if is_balanced && !matches!(climb.end, End::Infeasible(_)) {
        return Answer::new(Objective::LeastRemoved, climb);
    }
    let Some(spindle) = &work.goal.spindle else {
        return minimise_unbalance(work, [-1.0, 1.0], start);
    };
    let answer = minimise_unbalance(work, ends(work, spindle), start);
    match prove_unbalanceable(work, spindle, &answer.climb) {
        Some(proof) => answer.with_verdict(proof),
        None => answer,
    }
}

/// Returns the two ends of a rotor's axis, in the solver's units.
pub(crate) fn ends(work: &Work, spindle: &Spindle) -> [f64; 2] {
    spindle.ends_mm.map(|end| end / work.to_mm(1.0))
}

fn minimise_unbalance(work: &Work, ends: [f64; 2], start: Option<&DualPoint>) -> Answer {
    let programme = Programme::balance_unbalance(&work.reach, ends);
    let climb = work.ascend(&programme, start);
    Answer::new(Objective::LeastUnbalance, climb)
}

/// Proves that no interior reaches the grade; `None` if there is no proof.
///
/// With τ at the value that the grade permits, Jᵀy − τ e₁ is positive over all of K.
fn prove_unbalanceable(work: &Work, spindle: &Spindle, climb: &Climb) -> Option<Status> {
    let least_grade_mm_s = grade_mm_s(spindle, work.to_mm(climb.best.bound));
    if least_grade_mm_s <= spindle.rotor.grade_mm_s {
        return None;
    }
    let allowed = spindle.rotor.permissible_mm() / (SQRT_2 * work.to_mm(1.0));
    let mut quadric = climb.best.quadric;
    quadric[0] += climb.best.point.tau - allowed;
    let least = quadric.dot(&work.reach.least(&quadric));
    let separator = work.reach.scale.quadric_to_mm(&quadric);
    (least > 0.0).then_some(Status::CannotBalance {
        least_grade_mm_s,
        separator,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::hollow::worlds::{self, World};
    use crate::hollow::{Figure, Settings, Solution, refine, solve as solved};
    use crate::mass::Moments;

    fn solution(world: &World) -> Solution {
        solved(&world.problem(), &Settings::default(), &Watch::silent())
    }

    /// Returns ‖(U_A, U_B)‖/M in mm, from the definition.
    fn unbalance_mm(moments: &Moments, [a, b]: [f64; 2]) -> f64 {
        let [mass, x, y, _, _, yz, xz, ..] = moments.0;
        let planes = [x * b - xz, y * b - yz, xz - x * a, yz - y * a].map(|u| u / (b - a));
        planes.iter().map(|u| u * u).sum::<f64>().sqrt() / mass
    }

    #[test]
    fn a_pure_couple_is_taken_away_by_the_two_corners_that_lie_farthest() {
        // The void is { xz > k } in a box of half sizes A = 4, B = 2, H = 3. Its s_xz is 4B ((A²H²
        // − k²)/4 − k²/2 ln(AH/k)), its volume 4B (AH − k − k ln(AH/k)). A column an eighth wide
        // sees x at its middle, with errors of p²/x² ≈ 1e-3.
        let (k, edge) = (4.0_f64, 12.0_f64);
        let couple = 8.0 * ((edge * edge - k * k) / 4.0 - 0.5 * k * k * (edge / k).ln());
        let removed = 8.0 * (edge - k - k * (edge / k).ln());
        let world = worlds::coupled_rotor(couple);
        let got = solution(&world);
        assert_eq!(
            (got.status, got.certificate.figure),
            (Status::Solved, Figure::VolumeMm3)
        );
        assert!(got.certificate.gap_ratio.abs() <= 1e-6 && got.certificate.residual <= 1e-7);
        let found = world.fixed.volume() - got.certificate.value;
        assert!((found / removed - 1.0).abs() < 2e-3, "{found} {removed}");
        assert!(unbalance_mm(&got.moments, [-3.0, 3.0]) < 1e-6);
    }

    #[test]
    fn where_it_can_be_balanced_the_least_unbalance_is_none() {
        let mut world = worlds::coupled_rotor(60.0);
        world.goal.objective = Objective::LeastUnbalance;
        let got = solution(&world);
        assert_eq!(
            (got.status, got.objective),
            (Status::Solved, Objective::LeastRemoved)
        );
        assert!(unbalance_mm(&got.moments, [-3.0, 3.0]) < 1e-6);
    }

    #[test]
    fn what_is_balanced_already_keeps_everything() {
        let world = worlds::coupled_rotor(0.0);
        let got = solution(&world);
        assert_eq!(got.status, Status::Solved);
        assert!((got.moments.volume() / world.fixed.volume() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn none_of_65536_ways_to_empty_blocks_is_less_unbalanced_than_the_bound() {
        let world = worlds::blocks_on_an_axis();
        let spindle = world.goal.spindle.unwrap();
        let got = solution(&world);
        let mut best = f64::INFINITY;
        worlds::each_choice(&world, &worlds::single_blocks(16), |moments| {
            best = best.min(unbalance_mm(moments, spindle.ends_mm));
        });
        let solid = unbalance_mm(&world.fixed, spindle.ends_mm);
        let bound_mm = got.certificate.bound / (SQRT_2 * spindle.rotor.omega_rad_s());
        assert!(best >= bound_mm - 1e-12, "{best} {bound_mm}");
        assert!(best < solid, "the blocks can improve on {solid}");
    }

    /// Returns the leaning egg as a rotor with its axis this far from its middle.
    fn egg_aside(aside_mm: f64) -> World {
        let mut world = worlds::egg(Objective::Dominance).turning(6.0);
        let shift = crate::geom::Vector::new(-aside_mm, 0.0, 0.0);
        world.fixed = world.fixed.translated(&shift);
        world
            .columns
            .centers
            .iter_mut()
            .for_each(|center| center[0] += shift.x);
        world.goal = crate::goal::Goal {
            kind: crate::goal::GoalKind::Balance,
            objective: Objective::LeastRemoved,
            solid: world.fixed,
            ..world.goal
        };
        world
    }

    #[test]
    fn an_axis_out_of_reach_is_refused_with_a_quadric_that_separates() {
        let world = egg_aside(6.0);
        let got = solution(&world);
        let Status::CannotBalance {
            least_grade_mm_s,
            separator,
        } = got.status
        else {
            panic!("{:?}", got.status)
        };
        assert!(least_grade_mm_s > 2.5 && got.status.is_impossible());
        // Midpoint sums of a kinked function have an error of 1e-4 with 200 steps per column.
        let least = worlds::least_integral(&world, &separator, 200);
        assert!(least > 0.0, "{least}");
        let spindle = world.goal.spindle.unwrap();
        for seed in 0..200 {
            let emptied = crate::interior::moments_where_positive(
                &world.columns,
                &worlds::some_quadric(seed, 12.0),
            );
            let reached_mm = unbalance_mm(&(world.fixed - emptied), spindle.ends_mm);
            assert!(
                grade_mm_s(&spindle, reached_mm) >= least_grade_mm_s * (1.0 - 1e-9),
                "{seed}"
            );
        }
    }

    #[test]
    fn a_leaning_egg_is_balanced_by_what_it_loses_and_again_in_few_passes() {
        let mut world = egg_aside(0.5);
        let known = solution(&world);
        assert_eq!(known.status, Status::Solved);
        assert!(
            unbalance_mm(&world.fixed, [-6.0, 6.0]) > 0.3,
            "it has something to lose"
        );
        assert!(unbalance_mm(&known.moments, [-6.0, 6.0]) < 1e-6);
        world.fixed += Moments(Moments::monomials(5.0, 4.0, 3.0)) * (1e-4 * world.fixed.volume());
        let again = refine(
            &world.problem(),
            &Settings::default(),
            &known,
            &Watch::silent(),
        );
        assert!(
            again.status == Status::Solved && again.passes <= 8,
            "{}",
            again.passes
        );
    }
}
