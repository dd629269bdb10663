//! The search over heights: samples of a top's objective, and the bottom of a valley.

use super::heights::Heights;
use super::lever::Levers;
use super::valley::{Bottom, Place, Sample, Start, Valley};
use super::weighed::Weighed;
use crate::hollow::dual::answer::Answer;
use crate::hollow::dual::ascent::Climb;
use crate::hollow::solution::Tangent;

impl Heights<'_> {
    /// Turns an ascent into the bottom of a valley whose place and curvature are known.
    pub fn bottom_of(&self, height: Tangent, lever: Option<Tangent>, climb: Climb) -> Bottom {
        Bottom {
            sample: self.sample_of(height.at, lever, climb),
            curvature: height.curvature,
        }
    }

    /// Returns true if no other height promises a gain, and no other lever if that is weighed.
    pub fn is_level(&self, bottom: &Bottom) -> bool {
        let Sample {
            slope,
            lever,
            climb,
            ..
        } = &bottom.sample;
        let of_lever = Weighed::of(self.objective, self.work)
            .zip(*lever)
            .is_none_or(|(weighed, lever)| {
                bottom.is_level(weighed.slope(lever.at, &climb.best), lever.curvature)
            });
        of_lever && bottom.is_level(*slope, bottom.curvature)
    }

    /// Finds the bottom of the valley that a height lies in; `None` if nothing could be solved.
    pub fn find_bottom_from(&self, height: f64) -> Option<Bottom> {
        self.find_bottom(Valley::from(height, self.range), None)
    }

    /// Finds the bottom of a valley, starting from a nearby answer.
    pub fn find_bottom(&self, valley: Valley, known: Option<Start>) -> Option<Bottom> {
        valley.within(self.work.tolerance).find_bottom(
            |Place {
                 at,
                 near,
                 tolerance,
             }| { self.sample(at, near.map(Sample::start).or(known), tolerance) },
        )
    }

    /// Samples the objective and its slope; `None` if cancelled or if no interior meets the
    /// constraints.
    pub fn sample(&self, height: f64, near: Option<Start>, tolerance: f64) -> Option<Sample> {
        if let Some(weighed) = Weighed::of(self.objective, self.work) {
            return Levers {
                heights: self,
                weighed,
                height,
            }
            .best(near, tolerance);
        }
        let climb = self.work.climb_near(
            &self.programme(height),
            near.map(|start| start.point),
            tolerance,
        )?;
        Some(self.sample_of(height, None, climb))
    }

    /// Returns the answer of a run that found nothing: an ascent at the middle height.
    pub fn report_failure(&self) -> Answer {
        let programme = self.programme(0.5 * (self.range[0] + self.range[1]));
        let start = programme.cold_start(&self.work.reach);
        Answer::new(self.objective, self.work.climb(&programme, start, 0.0))
    }
}
