//! Spin-It's functional where it weighs the lever: at each height also the best lever has to be found.

use super::heights::{Heights, Start};
use super::programme::{DualPoint, LEVER_ROW, Programme, index};
use super::solution::Tangent;
use super::valley::{Place, Sample, Valley};
use crate::goal::Objective;

/// How exactly the lever that the search begins at is found.
const ROUGH_TOLERANCE: f64 = 1e-2;

/// The longest step of a lever, as a part of it: far larger, and it leaves what interiors can have.
const STEP_RATIO: f64 = 0.1;

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
    /// The least over the lever, and its slope by the height.
    pub fn best(&self, near: Start, tolerance: f64) -> Option<Sample> {
        let (start, hint) = match near {
            Some((point, Some(hint))) => (Some(point.clone()), hint),
            _ => (None, self.unweighed()?),
        };
        let valley = Valley::from_tangent(hint, [0.0, self.greatest()]).in_steps_of(STEP_RATIO).within(tolerance);
        let bottom = valley.bottom(|place: Place| {
            let near = place.near.map(|sample| &sample.climb.best.point).or(start.as_ref());
            self.sample(place.at, near, tolerance.max(place.tolerance))
        })?;
        let [_, gamma_i] = self.gammas;
        let best = &bottom.sample.climb.best;
        let chain = 2.0 * gamma_i * best.value;
        let [slope, bend] = self.heights.slopes(self.height, best).map(|slope| chain * slope);
        let lever = Some(bottom.tangent());
        Some(Sample { at: self.height, slope, bend, lever, ..bottom.sample })
    }

    /// The lever of the interior whose inertia alone is best: the best one is less.
    fn unweighed(&self) -> Option<Tangent> {
        let free = self.heights.work.climb_near(&self.heights.programme(self.height), None, ROUGH_TOLERANCE)?;
        Some(Tangent { at: free.best.extreme.s[index::Z], curvature: 0.0 })
    }

    /// No interior has a greater lever.
    fn greatest(&self) -> f64 {
        self.heights.range[1] * self.heights.work.reach.fullest[index::ONE]
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
        let bend = 2.0 * gamma_c / (solid * solid);
        Some(Sample { at: lever, value, slope, bend, climb, lever: None })
    }
}
