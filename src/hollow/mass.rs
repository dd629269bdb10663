//! Spin-It's functional where it weighs the lever: at each height also the best mass has to be found.

use super::ascent::Visit;
use super::heights::Start;
use super::programme::{DualPoint, MASS_ROW, Programme, index};
use super::valley::{Sample, Valley};
use super::work::Work;
use crate::goal::Objective;

/// How exact the ends of the range of masses are.
const RANGE_TOLERANCE: f64 = 1e-3;

/// γ_c and γ_I of a functional that weighs the lever; none where only the inertia counts and the mass is free.
pub(super) fn weighed(objective: Objective) -> Option<[f64; 2]> {
    match objective {
        Objective::SpinIt { gamma_c, gamma_i } if gamma_c > 0.0 => Some([gamma_c, gamma_i]),
        _ => None,
    }
}

/// γ_c (s_z/s_z of the solid)² + γ_I τ² at one height, as a function of the mass.
///
/// The sum of the two squares is not quasi-convex, but with the mass fixed the first is a constant and the second is.
pub(super) struct Masses<'a> {
    pub work: &'a Work<'a>,
    /// γ_c and γ_I
    pub gammas: [f64; 2],
    pub height: f64,
}

impl Masses<'_> {
    /// The least over the mass, and its slope by the height. It lies between the lightest interior and the one whose
    /// inertia alone is best, beyond which both terms grow.
    pub fn best(&self, near: Start, tolerance: f64) -> Option<Sample> {
        let lightest = self.work.climb_near(
            &Programme::top_lightest(&self.work.reach, self.height),
            None,
            RANGE_TOLERANCE,
        )?;
        let free = self.work.climb_near(
            &Programme::top_functional(&self.work.reach, self.height),
            None,
            tolerance,
        )?;
        let start = near.map(|(point, _)| point.clone());
        let valley = Valley::unknown(lightest.best.bound, free.best.extreme.s[index::ONE]);
        let bottom = valley.bottom(|mass, known| {
            let near = known.map(|sample| &sample.climb.best.point).or(start.as_ref());
            self.sample(mass, near, tolerance)
        })?;
        let mass = bottom.sample.at;
        let slope = self.slopes(mass, &bottom.sample.climb.best)[0];
        Some(Sample { at: self.height, slope, mass: Some(mass), ..bottom.sample })
    }

    fn sample(&self, mass: f64, near: Option<&DualPoint>, tolerance: f64) -> Option<Sample> {
        let programme =
            Programme::top_functional(&self.work.reach, self.height).with_mass(&self.work.reach, mass);
        let climb = self.work.climb_near(&programme, near, tolerance)?;
        let [gamma_c, gamma_i] = self.gammas;
        let lever = self.height * mass / self.solid_lever();
        let value = gamma_c * lever * lever + gamma_i * climb.best.value * climb.best.value;
        let slope = self.slopes(mass, &climb.best)[1];
        Some(Sample { at: mass, value, slope, climb, mass: Some(mass) })
    }

    /// The derivatives by the height and by the mass, by the envelope theorem.
    fn slopes(&self, mass: f64, best: &Visit) -> [f64; 2] {
        let [gamma_c, gamma_i] = self.gammas;
        let lowering = 2.0 * gamma_c * self.height * mass / self.solid_lever().powi(2);
        let chain = 2.0 * gamma_i * best.value;
        let by_mass = -best.point.lambda[MASS_ROW] / best.denominator;
        [lowering * mass + chain * best.height_slope(), lowering * self.height + chain * by_mass]
    }

    /// s_z of the whole solid.
    fn solid_lever(&self) -> f64 {
        self.work.reach.scale.moments_to_units(&self.work.goal.solid)[index::Z]
    }
}
