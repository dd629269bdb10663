//! A top's centre at one height after another: the range, the coarse look, the descent into each valley.

use super::answer::Answer;
use super::ascent::{Climb, End};
use super::mass;
use super::programme::{DualPoint, Programme};
use super::valley::{Bottom, Sample, Valley};
use super::work::Work;
use crate::goal::Objective;

/// How exact the coarse look over all heights is. Ten times less, and the slopes point the wrong way near a bottom; ten
/// times more costs a pass a height.
const LOOK_TOLERANCE: f64 = 3e-3;
/// How exact the ends of the range of heights are; their outer bounds are used.
const RANGE_TOLERANCE: f64 = 1e-3;

/// A dual point to start from, and the mass it belongs to.
pub(super) type Start<'a> = Option<(&'a DualPoint, Option<f64>)>;

/// A top's objective as a function of the height of its centre.
#[derive(Clone, Copy)]
pub(super) struct Heights<'a> {
    pub work: &'a Work<'a>,
    pub objective: Objective,
}

impl Heights<'_> {
    /// The heights the centre of an interior that meets the constraints can have: outer bounds, so that none is
    /// missed. Fails with the ascent that proves that no interior meets them.
    pub fn range(work: &Work) -> Result<[f64; 2], Box<Climb>> {
        let end = |sense: f64| {
            let programme = Programme::top_height(&work.reach, sense);
            let climb = work.climb(&programme, programme.cold_start(&work.reach), RANGE_TOLERANCE);
            match climb.end {
                End::Infeasible(_) | End::Cancelled => Err(Box::new(climb)),
                _ => Ok(sense * climb.best.bound),
            }
        };
        Ok([end(1.0)?.max(0.0), end(-1.0)?])
    }

    /// The lowest of all valleys over the range; none where no height could be solved.
    pub fn lowest(&self, [low, high]: [f64; 2]) -> Option<Bottom> {
        let samples = self.look_over([low, high]);
        let bottoms = Valley::all_between(low, high, &samples).into_iter().filter_map(|valley| {
            valley.bottom(|height, near| self.sample(height, near.map(Sample::start), 0.0))
        });
        bottoms.min_by(|a, b| a.sample.value.total_cmp(&b.sample.value))
    }

    /// A coarse look at heights spread evenly over the range, ascending.
    fn look_over(&self, [low, high]: [f64; 2]) -> Vec<Sample> {
        let count = self.work.settings.heights.max(2);
        let mut samples: Vec<Sample> = Vec::with_capacity(count);
        for i in 0..count {
            let height = low + (high - low) * (i as f64 + 0.5) / count as f64;
            let near = samples.last().map(Sample::start);
            samples.extend(self.sample(height, near, LOOK_TOLERANCE));
        }
        samples
    }

    /// The objective and its slope at a height; none where the run was stopped or the height cannot be had.
    pub fn sample(&self, height: f64, near: Start, tolerance: f64) -> Option<Sample> {
        if let Some(gammas) = mass::weighed(self.objective) {
            return mass::Masses { work: self.work, gammas, height }.best(near, tolerance);
        }
        let climb = self.work.climb_near(&self.programme(height), near.map(|(point, _)| point), tolerance)?;
        let (ratio, slope) = (climb.best.value, climb.best.height_slope());
        let (value, slope) = match self.objective {
            Objective::SpinIt { gamma_i, .. } => (gamma_i * ratio * ratio, 2.0 * gamma_i * ratio * slope),
            _ => (ratio, slope),
        };
        Some(Sample { at: height, value, slope, climb, mass: None })
    }

    /// The quasi-convex programme with the centre at this height.
    pub fn programme(&self, height: f64) -> Programme {
        let reach = &self.work.reach;
        match self.objective {
            Objective::SpinIt { .. } => Programme::top_functional(reach, height),
            Objective::Dominance => Programme::top_dominance(reach, height),
            _ => Programme::top_critical_speed(reach, height),
        }
    }

    /// What a run that found no height shows: how far it came at the middle one.
    pub fn given_up(&self, [low, high]: [f64; 2]) -> Answer {
        let programme = self.programme(0.5 * (low + high));
        let start = programme.cold_start(&self.work.reach);
        Answer::new(self.objective, self.work.climb(&programme, start, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Settings, worlds};
    use super::*;
    use crate::progress::Progress;

    #[test]
    fn the_slope_by_the_height_is_that_of_finite_differences() {
        let spin_it = |gamma_c| Objective::SpinIt { gamma_c, gamma_i: 1.2 };
        for objective in [Objective::CriticalSpeed, spin_it(0.0), spin_it(0.8)] {
            let world = worlds::egg_on_its_side(objective);
            let (settings, progress, problem) = (Settings::default(), Progress::silent(), world.problem());
            let work = Work::new(&problem, &settings, &progress);
            let heights = Heights { work: &work, objective };
            let [low, high] = Heights::range(&work).unwrap();
            let (height, step) = (0.6 * low + 0.4 * high, 3e-3 * (high - low));
            let at = |height| heights.sample(height, None, 0.0).unwrap();
            let difference = (at(height + step).value - at(height - step).value) / (2.0 * step);
            // The bend of the slope costs about 5e-4 at this step (it is quadratic in it), and values exact to 1e-8 as much.
            let slope = at(height).slope;
            assert!((slope / difference - 1.0).abs() < 2e-3, "{objective:?}: {slope} {difference}");
        }
    }

    #[test]
    fn no_interior_that_is_balanced_has_its_centre_outside_the_range() {
        let world = worlds::rings(Objective::CriticalSpeed);
        let (settings, progress, problem) = (Settings::default(), Progress::silent(), world.problem());
        let work = Work::new(&problem, &settings, &progress);
        let [low, high] = Heights::range(&work).unwrap().map(|height| work.to_mm(height));
        worlds::each_choice(&world, &worlds::ring_groups(&world), |moments| {
            let height = moments.centroid().z;
            assert!(low <= height && height <= high);
        });
    }
}
