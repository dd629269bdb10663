//! Spin-It's functional with a weighed lever: the search for the best lever at each height.

use super::heights::Heights;
use super::valley::Start;
use super::valley::{Place, Sample, Valley};
use super::weighed::Weighed;
use crate::hollow::dual::programme::DualPoint;
use crate::hollow::dual::units::index;
use crate::hollow::solution::Tangent;

/// Tolerance of the ascent that gives the first lever.
const ROUGH_TOLERANCE: f64 = 1e-2;

/// Longest step of a lever, as a part of it. Far longer steps leave the range of possible levers.
const STEP_RATIO: f64 = 0.1;

/// The function k s_z² + γ τ² of the lever s_z, with the tensor linear at one height.
///
/// The sum of two squares is not quasi-convex. With the lever fixed, the first square is a constant
/// and the second is quasi-convex.
pub(crate) struct Levers<'a> {
    pub heights: &'a Heights<'a>,
    pub weighed: Weighed,
    pub height: f64,
}

impl Levers<'_> {
    /// Minimises over the lever; the sample has the slope by the height.
    pub fn best(&self, near: Option<Start>, tolerance: f64) -> Option<Sample> {
        let (start, hint) = match near {
            Some(Start {
                point,
                lever: Some(hint),
            }) => (Some(point.clone()), hint),
            _ => (None, self.lever_without_weight()?),
        };
        let valley = Valley::from_tangent(hint, [0.0, self.greatest()])
            .in_steps_of(STEP_RATIO)
            .within(tolerance);
        let bottom = valley.find_bottom(|place: Place| {
            let near = place
                .near
                .map(|sample| &sample.climb.best.point)
                .or(start.as_ref());
            self.sample(place.at, near, tolerance.max(place.tolerance))
        })?;
        Some(
            self.heights
                .sample_of(self.height, Some(bottom.tangent()), bottom.sample.climb),
        )
    }

    /// Returns the lever of the interior with the best inertia alone; the best lever is smaller.
    fn lever_without_weight(&self) -> Option<Tangent> {
        let free = self.heights.work.climb_near(
            &self.heights.programme(self.height),
            None,
            ROUGH_TOLERANCE,
        )?;
        Some(Tangent {
            at: free.best.extreme.s[index::Z],
            curvature: 0.0,
        })
    }

    /// Returns an upper bound of the lever of any interior.
    fn greatest(&self) -> f64 {
        self.heights.range[1] * self.heights.work.reach.fullest[index::ONE]
    }

    fn sample(&self, lever: f64, near: Option<&DualPoint>, tolerance: f64) -> Option<Sample> {
        let work = self.heights.work;
        let programme = self
            .heights
            .programme(self.height)
            .with_lever(&work.reach, lever);
        let climb = work.climb_near(&programme, near, tolerance)?;
        let (
            Weighed {
                lever: k,
                inertia: gamma,
            },
            best,
        ) = (self.weighed, &climb.best);
        let value = k * lever * lever + gamma * best.value * best.value;
        let slope = self.weighed.slope(lever, best);
        Some(Sample {
            at: lever,
            value,
            slope,
            bend: 2.0 * k,
            climb,
            lever: None,
        })
    }
}
