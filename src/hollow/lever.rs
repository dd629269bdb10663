//! Spin-It's functional where it weighs the lever: at each height also the best lever has to be found.

use super::heights::{Heights, Start};
use super::programme::{DualPoint, LEVER_ROW, Programme, index};
use super::valley::{Place, Sample, Valley};
use crate::goal::Objective;

/// How exact the ends of the range of levers are.
const RANGE_TOLERANCE: f64 = 1e-3;

/// γ_c and γ_I of a functional that weighs the lever; none where only the inertia counts and the lever is free.
pub(super) fn weighed(objective: Objective) -> Option<[f64; 2]> {
    match objective {
        Objective::SpinIt { gamma_c, gamma_i } if gamma_c > 0.0 => Some([gamma_c, gamma_i]),
        _ => None,
    }
}

/// γ_c (s_z/s_z of the solid)² + γ_I τ² with the tensor linear at one height, as a function of the lever s_z.
///
/// The sum of the two squares is not quasi-convex, but with the lever fixed the first is a constant and the second is.
pub(super) struct Levers<'a> {
    pub heights: &'a Heights<'a>,
    /// γ_c and γ_I
    pub gammas: [f64; 2],
    pub height: f64,
}

impl Levers<'_> {
    /// The least over the lever, and its slope by the height. It lies between the least lever of all and that of the
    /// interior whose inertia alone is best, beyond which both terms grow.
    pub fn best(&self, near: Start, tolerance: f64) -> Option<Sample> {
        let work = self.heights.work;
        let least = work.climb_near(&Programme::top_least_lever(), None, RANGE_TOLERANCE)?;
        let free = work.climb_near(&self.heights.programme(self.height), None, RANGE_TOLERANCE)?;
        let range = [least.best.bound, free.best.extreme.s[index::Z]];
        let start = near.map(|(point, _)| point.clone());
        let place = near.and_then(|(_, lever)| lever).unwrap_or(0.5 * (range[0] + range[1]));
        let bottom = Valley::from(place, range).bottom(|Place { at, near, .. }| {
            let near = near.map(|sample| &sample.climb.best.point).or(start.as_ref());
            self.sample(at, near, tolerance)
        })?;
        let [_, gamma_i] = self.gammas;
        let best = &bottom.sample.climb.best;
        let chain = 2.0 * gamma_i * best.value;
        let [slope, bend] = self.heights.slopes(self.height, best).map(|slope| chain * slope);
        let lever = Some(bottom.sample.at);
        Some(Sample { at: self.height, slope, bend, lever, ..bottom.sample })
    }

    fn sample(&self, lever: f64, near: Option<&DualPoint>, tolerance: f64) -> Option<Sample> {
        let work = self.heights.work;
        let programme = self.heights.programme(self.height).with_lever(&work.reach, lever);
        let climb = work.climb_near(&programme, near, tolerance)?;
        let [gamma_c, gamma_i] = self.gammas;
        let solid = work.reach.scale.moments_to_units(&work.goal.solid)[index::Z];
        let (part, best) = (lever / solid, &climb.best);
        let value = gamma_c * part * part + gamma_i * best.value * best.value;
        // By the envelope theorem the least ratio falls by the row's multiplier.
        let falling = 2.0 * gamma_i * best.value * best.point.lambda[LEVER_ROW] / best.denominator;
        let slope = 2.0 * gamma_c * part / solid - falling;
        Some(Sample { at: lever, value, slope, bend: 0.0, climb, lever: Some(lever) })
    }
}
