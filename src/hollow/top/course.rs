//! The course of a solution, for plots: value and bound pass by pass, and a top's speed by height.

use super::heights::Heights;
use super::valley::Start;
use crate::base::watch::Watch;
use crate::goal::{GoalKind, Objective};
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::work::Work;
use crate::hollow::goals::trade::Trade;
use crate::hollow::log::Pass;
use crate::hollow::problem::Problem;
use crate::hollow::problem::Settings;
use crate::hollow::solution::{Figure, Solution};

/// Number of heights in the curve of a top's speed. Fewer show corners; each costs an ascent.
const HEIGHTS: usize = 33;
/// Relative accuracy of the speed at a height: a thousandth of the resolution of a plot.
const TOLERANCE: f64 = 1e-5;

/// A top's best speed by the height of its centre, and the ascent to the optimum.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TopCourse {
    /// Value and bound pass by pass from a cold start, at the height of the solution, rpm.
    pub passes: Vec<Pass>,
    /// Heights in ascending order, mm, each with the least critical speed of any interior balanced
    /// there, rpm. Only heights with a stable interior; the minimum is the optimum.
    pub speeds: Vec<[f64; 2]>,
    /// Prints near a wished density: how much of it must change to keep how much of the figure.
    pub trade: Trade,
}

/// Computes the course of a top solved for its critical speed on these columns; empty for anything
/// else.
///
/// Costs about forty ascents, so coarse columns are advisable. If `watch` is stopped, heights are
/// missing.
pub fn top_course(
    problem: &Problem,
    settings: &Settings,
    known: &Solution,
    watch: &Watch,
) -> TopCourse {
    let is_of_speed = known.certificate.figure == Figure::CriticalSpeedRpm;
    let (GoalKind::Top, true, Some(best)) = (problem.goal.kind, is_of_speed, known.warm.height)
    else {
        return TopCourse::default();
    };
    let work = Work::new(problem, settings, watch);
    let Ok(heights) = Heights::new(&work, Objective::CriticalSpeed) else {
        return TopCourse::default();
    };
    let programme = heights.programme(best.at);
    let climb = work.climb(&programme, programme.cold_start(&work.reach), 0.0);
    let passes =
        Answer::new(Objective::CriticalSpeed, climb).course(&work, Figure::CriticalSpeedRpm);
    TopCourse {
        passes,
        speeds: sample_speeds(&heights),
        trade: Trade::default(),
    }
}

/// Returns the least speed at evenly spaced heights over the possible range.
fn sample_speeds(heights: &Heights) -> Vec<[f64; 2]> {
    let [low, high] = heights.range;
    let mut speeds = Vec::with_capacity(HEIGHTS);
    let mut near = None;
    for index in 0..HEIGHTS {
        let height = low + (high - low) * (index as f64 + 0.5) / HEIGHTS as f64;
        let Some(sample) = heights.sample(
            height,
            near.as_ref().map(|point| Start { point, lever: None }),
            TOLERANCE,
        ) else {
            continue;
        };
        near = Some(sample.climb.best.point.clone());
        let answer = Answer::new(heights.objective, sample.climb);
        let rpm = answer.in_figure(heights.work, Figure::CriticalSpeedRpm, sample.value);
        if rpm.is_finite() {
            speeds.push([heights.work.to_mm(height), rpm]);
        }
    }
    speeds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hollow::{solve, worlds};

    #[test]
    fn the_optimum_is_the_minimum_of_the_curve_and_the_end_of_the_ascent() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let (problem, settings) = (world.problem(), Settings::default());
        let known = solve(&problem, &settings, &Watch::silent());
        let course = top_course(&problem, &settings, &known, &Watch::silent());
        let (value, bound) = (known.certificate.value, known.certificate.bound);
        assert!(
            course.speeds.len() > HEIGHTS / 2 && course.speeds.is_sorted_by(|a, b| a[0] < b[0])
        );
        let least = course
            .speeds
            .iter()
            .map(|speed| speed[1])
            .fold(f64::INFINITY, f64::min);
        // No height is better than the bound. One of 33 is within half a step of the best, where
        // the curve is flat.
        assert!(
            least >= bound * (1.0 - TOLERANCE) && least < 1.05 * value,
            "{least} {value}"
        );
        let last = course.passes.last().unwrap();
        assert!(
            (last.value / value - 1.0).abs() < 1e-6 && course.passes.len() > 2,
            "{:?}",
            course.passes
        );
    }

    #[test]
    fn what_is_no_top_has_no_heights_but_its_passes_end_at_its_certificate() {
        let world = worlds::egg(Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        });
        let (problem, settings) = (world.problem(), Settings::default());
        let known = solve(&problem, &settings, &Watch::silent());
        assert_eq!(
            top_course(&problem, &settings, &known, &Watch::silent()),
            TopCourse::default()
        );
        let last = known.course.last().unwrap();
        assert_eq!(
            (last.value, last.bound),
            (known.certificate.value, known.certificate.bound)
        );
        // No bound lies above the optimum by more than rounding.
        assert!(
            known
                .course
                .iter()
                .all(|pass| pass.bound <= known.certificate.value * (1.0 + 1e-9))
        );
    }
}
