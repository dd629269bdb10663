//! Spin-It's functional where it weighs the lever: at each height also the best lever has to be
//! found.

use super::heights::Heights;
use super::valley::Start;
use super::valley::{Place, Sample, Valley};
use super::weighed::Weighed;
use crate::hollow::dual::programme::DualPoint;
use crate::hollow::dual::units::index;
use crate::hollow::solution::Tangent;

/// How exactly the lever that the search begins at is found.
const ROUGH_TOLERANCE: f64 = 1e-2;

/// The longest step of a lever, as a part of it: far larger, and it leaves what interiors can have.
const STEP_RATIO: f64 = 0.1;

/// k s_z² + γ τ² with the tensor linear at one height, as a function of the lever s_z.
///
/// The sum of the two squares is not quasi-convex, but with the lever fixed the first is a constant
/// and the second is.
pub(crate) struct Levers<'a> {
    pub heights: &'a Heights<'a>,
    pub weighed: Weighed,
    pub height: f64,
}

impl Levers<'_> {
    /// The least over the lever, and its slope by the height.
    pub fn best(&self, near: Option<Start>, tolerance: f64) -> Option<Sample> {
        let (start, hint) = match near {
            Some(Start {
                point,
                lever: Some(hint),
            }) => (Some(point.clone()), hint),
            _ => (None, self.unweighed()?),
        };
        let valley = Valley::from_tangent(hint, [0.0, self.greatest()])
            .in_steps_of(STEP_RATIO)
            .within(tolerance);
        let bottom = valley.bottom(|place: Place| {
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

    /// The lever of the interior whose inertia alone is best: the best one is less.
    fn unweighed(&self) -> Option<Tangent> {
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

    /// No interior has a greater lever.
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
