//! The weights of lever and inertia in Spin-It's functional.

use crate::goal::Objective;
use crate::hollow::dual::table::LEVER_ROW;
use crate::hollow::dual::units::index;
use crate::hollow::dual::visit::Visit;
use crate::hollow::dual::work::Work;

/// Spin-It's functional k s_z² + γ ρ² with a weighed lever, in the solver's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Weighed {
    /// k: γ_c over the square of the solid's lever.
    pub lever: f64,
    /// γ: γ_I, the weight of the squared inertia ratio.
    pub inertia: f64,
}

impl Weighed {
    /// Returns the weights; `None` if only the inertia counts.
    pub fn of(objective: Objective, work: &Work) -> Option<Self> {
        let solid = work.reach.scale.moments_to_units(&work.goal.solid)[index::Z];
        match objective {
            Objective::SpinIt { gamma_c, gamma_i } if gamma_c > 0.0 => Some(Self {
                lever: gamma_c / (solid * solid),
                inertia: gamma_i,
            }),
            _ => None,
        }
    }

    /// Returns the derivative of the least functional by the lever. By the envelope theorem the
    /// least ratio falls by the row's multiplier.
    pub fn slope(&self, lever: f64, best: &Visit) -> f64 {
        let falling =
            2.0 * self.inertia * best.value * best.point.lambda[LEVER_ROW] / best.denominator;
        2.0 * self.lever * lever - falling
    }
}
