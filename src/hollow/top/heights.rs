//! A top's objective as a function of the height at which its tensor is made linear.

use super::valley::Sample;
use super::weighed::Weighed;
use crate::goal::Objective;
use crate::hollow::dual::ascent::{Climb, End};
use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::visit::{Slack, Visit};
use crate::hollow::dual::work::Work;
use crate::hollow::solution::Tangent;

/// Relative accuracy of the ends of the range of heights. A finer one costs passes and saves the
/// proof none, as its posts cross an unreachable stretch in one or two.
const RANGE_SLACK: Slack = Slack {
    share: 0.2,
    enough: f64::INFINITY,
};
/// Least height of a centre, as a part of the greatest. A top whose centre lies in its contact
/// needs no spin at all.
const LEAST_HEIGHT_RATIO: f64 = 1e-4;

/// The objective T(ℓ) of a top: the least ratio over all interiors, with the tensor linear at ℓ.
///
/// With h the height of an interior's centre, s_z²/s₁ = 2ℓs_z − ℓ²s₁ + s₁(h − ℓ)². So the linear
/// tensor is never too small, and exact at h = ℓ. The minimum of T over ℓ is therefore the optimum
/// over all interiors of any height, without a row that fixes the height. T is smooth: its slope is
/// that of s₁(h − ℓ)².
#[derive(Clone, Copy)]
pub(crate) struct Heights<'a> {
    pub work: &'a Work<'a>,
    pub objective: Objective,
    /// Bounds on the height of the centre of every interior that meets the constraints.
    pub range: [f64; 2],
}

impl<'a> Heights<'a> {
    /// Returns the objective over the possible heights.
    ///
    /// Fails with the ascent that proves that no interior meets the constraints.
    pub fn new(work: &'a Work<'a>, objective: Objective) -> Result<Self, Box<Climb>> {
        Ok(Self {
            work,
            objective,
            range: Self::range(work)?,
        })
    }

    /// Returns outer bounds on the height of the centre of any interior that meets the constraints.
    ///
    /// Fails with the ascent that proves that no interior meets them.
    pub fn range(work: &Work) -> Result<[f64; 2], Box<Climb>> {
        let end = |sense: f64| {
            let programme = Programme::top_height(&work.reach, sense);
            let climb =
                work.climb_to_bound(&programme, programme.cold_start(&work.reach), RANGE_SLACK);
            match climb.end {
                End::Infeasible(_) | End::Cancelled => Err(Box::new(climb)),
                _ => Ok(sense * climb.best.bound),
            }
        };
        let (low, high) = (end(1.0)?, end(-1.0)?);
        Ok([low.max(LEAST_HEIGHT_RATIO * high), high])
    }

    /// Returns bounds on the height of the centre from a scout's multipliers, with one pass over
    /// all columns per end. `None` if those multipliers prove no range.
    pub fn range_from_scout(work: &Work, scout: &Work) -> Option<[f64; 2]> {
        let ends = Self::ends_from_scout(scout)?;
        Self::range_of(work, &ends)
    }

    /// Returns a scout's dual points of the least and the greatest height of the centre. `None` if
    /// it finds none.
    pub fn ends_from_scout(scout: &Work) -> Option<[DualPoint; 2]> {
        let end = |sense: f64| {
            let programme = Programme::top_height(&scout.reach, sense);
            let start = programme.cold_start(&scout.reach);
            let climb = scout.climb_to_bound(&programme, start, RANGE_SLACK);
            let is_found = !matches!(climb.end, End::Infeasible(_) | End::Cancelled);
            is_found.then_some(climb.best.point)
        };
        Some([end(1.0)?, end(-1.0)?])
    }

    /// Returns the range of heights that two dual points prove on all columns; `None` if they prove
    /// none.
    pub fn range_of(work: &Work, ends: &[DualPoint; 2]) -> Option<[f64; 2]> {
        let end = |sense: f64, point: &DualPoint| {
            sense * work.bound_at(&Programme::top_height(&work.reach, sense), point)
        };
        let (low, high) = (end(1.0, &ends[0]), end(-1.0, &ends[1]));
        let low = low.max(LEAST_HEIGHT_RATIO * high);
        (low < high).then_some([low, high])
    }

    /// Turns an ascent at a height, and at the best lever if that is weighed, into a sample.
    pub fn sample_of(&self, height: f64, lever: Option<Tangent>, climb: Climb) -> Sample {
        let (ratio, [slope, bend]) = (climb.best.value, self.slopes(height, &climb.best));
        let (value, chain) = match self.objective {
            Objective::SpinIt { gamma_i, .. } => (gamma_i * ratio * ratio, 2.0 * gamma_i * ratio),
            _ => (ratio, 1.0),
        };
        let weighed = Weighed::of(self.objective, self.work).zip(lever);
        let of_lever = weighed.map_or(0.0, |(weighed, lever)| weighed.lever * lever.at * lever.at);
        Sample {
            at: height,
            value: value + of_lever,
            slope: chain * slope,
            bend: chain * bend,
            climb,
            lever,
        }
    }

    /// Returns the derivative of the least ratio by ℓ, and an upper bound of the growth of that
    /// derivative.
    ///
    /// They are 2κs₁(ℓ − h)/(e·s), by the envelope theorem, and 2κs₁/(e·s). The change of the
    /// interior with ℓ only lowers the growth.
    pub fn slopes(&self, height: f64, best: &Visit) -> [f64; 2] {
        let bend = 2.0 * self.weight(&best.point) * best.mass() / best.denominator;
        [bend * (height - best.center_height()), bend]
    }

    /// Returns κ, the multiple of s_z²/s₁ in the numerator.
    ///
    /// It is one for λ_max, and the sum of two weights for y·(I_xx, √2 I_xy, I_yy).
    pub fn weight(&self, point: &DualPoint) -> f64 {
        match self.objective {
            Objective::SpinIt { .. } => point.y[0] + point.y[2],
            _ => 1.0,
        }
    }

    /// Returns the quasi-convex programme with the tensor linear at this height.
    pub fn programme(&self, height: f64) -> Programme {
        let reach = &self.work.reach;
        match self.objective {
            Objective::SpinIt { .. } => Programme::top_functional(reach, height),
            Objective::Dominance => Programme::top_dominance(reach, height),
            _ => Programme::top_critical_speed(reach, height, self.range),
        }
    }

    /// Returns the programme at this height, restricted to the given lever if there is one.
    pub fn programme_at(&self, height: f64, lever: Option<Tangent>) -> Programme {
        let programme = self.programme(height);
        lever.map_or(programme.clone(), |lever| {
            programme.with_lever(&self.work.reach, lever.at)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::hollow::{Settings, worlds};

    #[test]
    fn the_slope_by_the_height_is_that_of_finite_differences() {
        let spin_it = |gamma_c| Objective::SpinIt {
            gamma_c,
            gamma_i: 1.2,
        };
        for objective in [Objective::CriticalSpeed, spin_it(0.0), spin_it(0.8)] {
            let world = worlds::egg_on_its_side(objective);
            let (settings, watch, problem) =
                (Settings::default(), Watch::silent(), world.problem());
            let work = Work::new(&problem, &settings, &watch);
            let heights = Heights::new(&work, objective).unwrap();
            let [low, high] = heights.range;
            let (height, step) = (0.6 * low + 0.4 * high, 3e-3 * (high - low));
            let at = |height| heights.sample(height, None, 0.0).unwrap();
            let difference = (at(height + step).value - at(height - step).value) / (2.0 * step);
            // The bend of the slope costs about 5e-4 at this step (it is quadratic in the step).
            // Values exact to 1e-8 cost as much.
            let slope = at(height).slope;
            assert!(
                (slope / difference - 1.0).abs() < 2e-3,
                "{objective:?}: {slope} {difference}"
            );
        }
    }

    #[test]
    fn no_interior_that_is_balanced_has_its_centre_outside_the_range() {
        let world = worlds::rings(Objective::CriticalSpeed);
        let (settings, watch, problem) = (Settings::default(), Watch::silent(), world.problem());
        let work = Work::new(&problem, &settings, &watch);
        let [low, high] = Heights::range(&work)
            .unwrap()
            .map(|height| work.to_mm(height));
        worlds::each_choice(&world, &worlds::ring_groups(&world), |moments| {
            let height = moments.centroid().z;
            assert!(low <= height && height <= high);
        });
    }
}
