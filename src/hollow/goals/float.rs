//! The floating object: the lowest centre of mass above the centre of buoyancy, at the mass that
//! the water carries.

use crate::goal::{FloatConditions, Objective};
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::ascent::End;
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::units::index;
use crate::hollow::dual::work::Work;
use crate::hollow::status::Status;

/// Proved offset of the centre of mass below which the constraints count as met, in the solver's
/// units: the accepted residual.
const TRIM_TOLERANCE: f64 = 1e-7;

/// Finds the interior of the right mass with its centre above that of buoyancy and as low as
/// possible.
///
/// Otherwise proves that at this waterline there is none, or that every one capsizes.
pub(crate) fn solve(work: &Work, objective: Objective, start: Option<&DualPoint>) -> Answer {
    let afloat = work.goal.afloat.unwrap_or_default();
    if let Some(answer) = prove_out_of_range(work, objective, &afloat) {
        return answer;
    }
    let programme = Programme::float_lowest_center(&work.reach, &afloat);
    let climb = work.ascend(&programme, start);
    if climb.end != End::Cancelled
        && !work.accepts(&climb)
        && let Some(proof) = prove_untrimmable(work, objective, &afloat)
    {
        return proof;
    }
    let greatest_gm_mm = afloat.metacenter_mm - work.to_mm(climb.best.bound);
    let answer = Answer::new(objective, climb);
    if greatest_gm_mm <= 0.0 {
        answer.with_verdict(Status::Capsizes { greatest_gm_mm })
    } else {
        answer
    }
}

/// Proves that the lightest interior is too heavy for the displaced water, or the solid too light;
/// `None` if neither holds.
fn prove_out_of_range(
    work: &Work,
    objective: Objective,
    afloat: &FloatConditions,
) -> Option<Answer> {
    let mass = afloat.material_mm3 / work.reach.scale.volume_mm3;
    let [lightest, heaviest] = [work.reach.shell, work.reach.fullest].map(|s| s[index::ONE]);
    let (sense, verdict) = match mass {
        mass if mass < lightest => (
            1.0,
            Status::Sinks {
                least_ratio: lightest / mass,
            },
        ),
        mass if mass > heaviest => (
            -1.0,
            Status::RidesHigh {
                greatest_ratio: heaviest / mass,
            },
        ),
        _ => return None,
    };
    let programme = Programme::extreme_mass(sense);
    let climb = work.climb(&programme, programme.cold_start(&work.reach), 0.0);
    Some(Answer::new(objective, climb).with_verdict(verdict))
}

/// Proves that no interior of the right mass has its centre above that of buoyancy; `None` if there
/// is no proof.
fn prove_untrimmable(
    work: &Work,
    objective: Objective,
    afloat: &FloatConditions,
) -> Option<Answer> {
    let programme = Programme::float_offset(&work.reach, afloat);
    let climb = work.climb(&programme, programme.cold_start(&work.reach), 0.0);
    let (best, scale) = (&climb.best, &work.reach.scale);
    let mass = afloat.material_mm3 / scale.volume_mm3;
    let verdict = Status::CannotTrim {
        least_offset_mm: work.to_mm(best.bound),
        separator: scale.quadric_to_mm(&(best.quadric * scale.volume_mm3)),
        level_mm3: best.point.lambda[0] * mass * scale.volume_mm3,
    };
    (best.bound > TRIM_TOLERANCE).then(|| Answer::new(objective, climb).with_verdict(verdict))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::geom::Point;
    use crate::hollow::worlds::{self, World};
    use crate::hollow::{Figure, Settings, Solution, refine, solve as solved};
    use crate::interior::moments_where_positive;

    fn solution(world: &World) -> Solution {
        solved(&world.problem(), &Settings::default(), &Watch::silent())
    }

    #[test]
    fn a_tank_is_filled_from_the_bottom_to_the_mass_the_water_carries() {
        // The tank has an inner area of 16, a height of 10, and 40 of other mass centred at height
        // 9. With 120 in all it is filled to 5, and the centre lies at (40·9 + 80·2.5)/120.
        let world = worlds::tank(120.0, [0.0; 2]);
        let got = solution(&world);
        assert_eq!(
            (got.status, got.certificate.figure),
            (Status::Solved, Figure::MetacentricHeightMm)
        );
        assert!(got.certificate.gap_ratio.abs() <= 1e-6 && got.certificate.residual <= 1e-7);
        let gm = world.goal.afloat.unwrap().metacenter_mm - 560.0 / 120.0;
        assert!(
            (got.certificate.value / gm - 1.0).abs() < 1e-7,
            "{:?} {gm}",
            got.certificate
        );
        assert!((got.moments.volume() - 120.0).abs() < 1e-5);
    }

    #[test]
    fn the_centre_moves_above_the_centre_of_buoyancy_and_again_in_few_passes() {
        let mut world = worlds::tank(130.0, [0.3, -0.2]);
        let got = solution(&world);
        assert_eq!(got.status, Status::Solved, "{:?}", got.log);
        let center = got.moments.centroid();
        assert!((center.x - 0.3).abs() < 1e-6 && (center.y + 0.2).abs() < 1e-6);
        world.fixed.0[1] += 0.5;
        let again = refine(
            &world.problem(),
            &Settings::default(),
            &got,
            &Watch::silent(),
        );
        assert!(
            again.status == Status::Solved && again.passes <= 10,
            "{}",
            again.passes
        );
    }

    #[test]
    fn too_heavy_too_light_and_too_far_aside_are_each_proved() {
        let of = |mass, aside| solution(&worlds::tank(mass, aside)).status;
        // It weighs 40 empty and 200 full.
        let Status::Sinks { least_ratio } = of(32.0, [0.0; 2]) else {
            panic!("it must sink")
        };
        assert!((least_ratio - 1.25).abs() < 1e-12);
        let Status::RidesHigh { greatest_ratio } = of(250.0, [0.0; 2]) else {
            panic!("it must ride high")
        };
        assert!((greatest_ratio - 0.8).abs() < 1e-12);
        // 80 of 120 can move, by 2 mm at most, so the centre moves less than 4/3 mm.
        let Status::CannotTrim {
            least_offset_mm, ..
        } = of(120.0, [1.5, 0.0])
        else {
            panic!()
        };
        // With the 80 of the 16 × 10 on one side, their centre is at 1, and that of the whole at
        // 80/120. It is 0.8333 short.
        assert!(
            (least_offset_mm - (1.5 - 80.0 / 120.0)).abs() < 1e-4,
            "{least_offset_mm}"
        );
    }

    #[test]
    fn the_quadric_that_proves_a_centre_out_of_reach_separates() {
        let world = worlds::tank(120.0, [1.5, 0.4]);
        let Status::CannotTrim {
            separator,
            level_mm3,
            ..
        } = solution(&world).status
        else {
            panic!()
        };
        // Midpoint sums of a kinked function have an error of 1e-5 with 400 steps per column.
        let least = worlds::least_integral(&world, &separator, 400);
        assert!(least > level_mm3, "{least} {level_mm3}");
        for seed in 0..200 {
            let emptied = moments_where_positive(&world.columns, &worlds::some_quadric(seed, 4.0));
            let integral: f64 = (world.fixed - emptied)
                .0
                .iter()
                .zip(separator.0)
                .map(|(s, g)| s * g)
                .sum();
            assert!(integral >= least - 1e-3 * least.abs(), "{seed}");
        }
    }

    #[test]
    fn what_is_too_high_at_best_is_proved_to_capsize() {
        let mut world = worlds::tank(120.0, [0.0; 2]);
        world.goal.afloat = world.goal.afloat.map(|afloat| FloatConditions {
            metacenter_mm: 4.0,
            ..afloat
        });
        let got = solution(&world).status;
        let want = 4.0 - 560.0 / 120.0;
        let Status::Capsizes { greatest_gm_mm } = got else {
            panic!("{got:?}")
        };
        assert!((greatest_gm_mm - want).abs() < 1e-6, "{got:?}");
        assert!(got.is_impossible() && !got.remedies(&world.goal).is_empty());
        assert_eq!(
            world.goal.afloat.unwrap().buoyancy,
            Point::new(0.0, 0.0, 3.0)
        );
    }
}
