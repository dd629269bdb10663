//! One step of the ascent: a damped quadratic model of the dual, and its step control.

use nalgebra::{DMatrix, DVector};

use super::programme::{DualPoint, Programme};
use super::visit::Visit;

/// Damping below the least has no effect. Above the greatest, steps are shorter than rounding.
const LEAST_DAMPING: f64 = 1e-12;
const GREATEST_DAMPING: f64 = 1e9;
/// Factors by which the damping falls after a good prediction and grows after a bad one.
const EASE: f64 = 0.1;
const TIGHTEN: f64 = 8.0;
/// Least share of the promised gain for a step to be accepted. Above the second share the damping
/// falls.
const LEAST_GAIN_RATIO: f64 = 0.05;
const GOOD_GAIN_RATIO: f64 = 0.5;
/// Least mean curvature that the damping scales with; below it a quadric cuts practically nothing.
const LEAST_CURVATURE: f64 = 1e-4;
/// Gain below which rounding decides. Such a step is accepted if it comes nearer to the optimum.
const ROUNDING_GAIN: f64 = 1e-13;
/// Share of D below which the promised gain of y and λ counts as none, so that τ has to move.
/// Dinkelbach's method always may move it. A larger share moves τ while D is far from its maximum.
const SETTLED_RATIO: f64 = 0.03;

/// The step control.
pub(crate) struct StepControl {
    damping: f64,
    /// True if τ moves with the step; it rests while the model predicts badly.
    moves_ratio: bool,
}

impl StepControl {
    pub fn first(programme: &Programme, damping: f64) -> Self {
        Self {
            damping,
            moves_ratio: programme.is_ratio(),
        }
    }

    /// Returns true if steps have become shorter than rounding.
    pub fn is_exhausted(&self) -> bool {
        self.damping > GREATEST_DAMPING
    }

    /// Returns true if D is nearly maximal at a fixed τ, so that τ has to move.
    pub fn must_move_ratio(&self, here: &Visit, step: &Step, programme: &Programme) -> bool {
        programme.is_ratio() && !self.moves_ratio && step.gain() <= SETTLED_RATIO * here.dual.abs()
    }

    /// Returns true if the step to `there` is accepted; adapts the damping to the quality of the
    /// prediction.
    pub fn judge(&mut self, here: &Visit, there: &Visit, step: &Step, is_ratio: bool) -> bool {
        let promised = step.gain();
        let gained = there.dual - step.standing;
        let gain_ratio = if promised > ROUNDING_GAIN {
            gained / promised
        } else if there.error() < here.error() {
            1.0
        } else {
            0.0
        };
        if gain_ratio < LEAST_GAIN_RATIO {
            self.damping *= TIGHTEN;
            self.moves_ratio = false;
            return false;
        }
        if gain_ratio > GOOD_GAIN_RATIO {
            self.damping = (self.damping * EASE).max(LEAST_DAMPING);
        }
        self.moves_ratio = is_ratio;
        true
    }
}

/// A step, and the model's prediction for it.
pub(crate) struct Step {
    pub to: DualPoint,
    /// D predicted at `to`.
    promised: f64,
    /// D predicted at the old y and λ, with τ moved.
    standing: f64,
}

impl Step {
    /// Returns the predicted gain over leaving y and λ unchanged.
    pub fn gain(&self) -> f64 {
        self.promised - self.standing
    }

    /// Maximises D + r·d − ½ dᵀ(H + μI)d over the step d = (dy, dλ) with y + dy ∈ Y.
    pub fn from(here: &Visit, programme: &Programme, control: &StepControl) -> Self {
        let jacobian = programme.jacobian();
        let w = &here.extreme.w;
        let ratio_step = if control.moves_ratio {
            here.dual / here.denominator
        } else {
            0.0
        };
        let bend = w * programme.denominator * ratio_step;
        let mut slope = &jacobian * here.extreme.s;
        slope
            .rows_mut(programme.directions.nrows(), programme.rhs.len())
            .copy_from(&here.misses);
        let model = Model {
            slope: slope + &jacobian * bend,
            curvature: &jacobian * w * jacobian.transpose(),
        };
        let (y, lambda) = model.maximiser(&here.point, programme, control.damping);

        let (dy, dlambda) = (&y - &here.point.y, &lambda - &here.point.lambda);
        let step = DVector::from_iterator(
            dy.len() + dlambda.len(),
            dy.iter().chain(dlambda.iter()).copied(),
        );
        let fall =
            ratio_step * here.denominator + 0.5 * ratio_step * programme.denominator.dot(&bend);
        let standing = here.dual - fall;
        let promised = standing + model.gain(&step);
        Self {
            to: DualPoint {
                y,
                lambda,
                tau: here.point.tau + ratio_step,
            },
            promised,
            standing,
        }
    }
}

/// The quadratic model of D over (y, λ) about the current point, at the τ of the step.
struct Model {
    slope: DVector<f64>,
    curvature: DMatrix<f64>,
}

impl Model {
    /// Returns the gain of a step.
    fn gain(&self, step: &DVector<f64>) -> f64 {
        self.slope.dot(step) - 0.5 * step.dot(&(&self.curvature * step))
    }

    /// Returns the y and λ that maximise the damped model. Eliminates λ, minimises over the set of
    /// y, then substitutes back.
    fn maximiser(
        &self,
        from: &DualPoint,
        programme: &Programme,
        damping: f64,
    ) -> (DVector<f64>, DVector<f64>) {
        let (k, m) = (programme.directions.nrows(), programme.rhs.len());
        let n = k + m;
        let mean = (self.curvature.trace() / n as f64).max(LEAST_CURVATURE);
        let damped = &self.curvature + DMatrix::identity(n, n) * (mean * damping);
        let (yy, yl, ll) = (
            damped.view((0, 0), (k, k)),
            damped.view((0, k), (k, m)),
            damped.view((k, k), (m, m)),
        );
        let (slope_y, slope_l) = (self.slope.rows(0, k), self.slope.rows(k, m).into_owned());
        let Some(inner) = ll.into_owned().cholesky() else {
            return (from.y.clone(), &from.lambda + slope_l / mean);
        };
        let schur = yy - yl * inner.solve(&yl.transpose());
        let reduced = slope_y - yl * inner.solve(&slope_l);
        let y = programme
            .set
            .minimise(&schur, &(reduced + &schur * &from.y), &from.y);
        let follows = inner.solve(&(slope_l - yl.tr_mul(&(&y - &from.y))));
        (y, &from.lambda + follows)
    }
}
