//! One step of the ascent: the damped quadratic model of the dual, and how far it is trusted.

use nalgebra::{DMatrix, DVector};

use super::programme::{DualPoint, Programme};
use super::visit::Visit;

/// Damping below this part is none; above the greatest the steps are shorter than rounding.
const LEAST_DAMPING: f64 = 1e-12;
const GREATEST_DAMPING: f64 = 1e9;
/// How the damping follows the model's fortune.
const EASE: f64 = 0.1;
const TIGHTEN: f64 = 8.0;
/// A step is taken when it gains at least this part of what the model promised; above the second
/// the damping eases.
const LEAST_GAIN_RATIO: f64 = 0.05;
const GOOD_GAIN_RATIO: f64 = 0.5;
/// Curvature below which a quadric counts as cutting nothing: the damping then stands on this.
const LEAST_CURVATURE: f64 = 1e-4;
/// Gains below this are rounding: a step that promises no more is judged by whether it comes nearer
/// to the optimum.
const ROUNDING_GAIN: f64 = 1e-13;
/// When no y and λ promise to raise D by more than this part of it, it is τ that has to move, as
/// Dinkelbach's method always may; larger, and τ moves on a D that is far from its maximum.
const SETTLED_RATIO: f64 = 0.03;
/// How boldly the next step goes.
pub(crate) struct Stride {
    damping: f64,
    /// Whether τ moves with the step; it rests while the model is too poor to predict what moving
    /// it does.
    moves_ratio: bool,
}

impl Stride {
    pub fn first(programme: &Programme, damping: f64) -> Self {
        Self {
            damping,
            moves_ratio: programme.is_ratio(),
        }
    }

    /// Whether steps have become shorter than rounding.
    pub fn is_exhausted(&self) -> bool {
        self.damping > GREATEST_DAMPING
    }

    /// Whether D is all but maximal at a resting τ, so that τ has to move whatever the model says
    /// of it.
    pub fn leaves_only_the_ratio(&self, here: &Visit, step: &Step, programme: &Programme) -> bool {
        programme.is_ratio() && !self.moves_ratio && step.gain() <= SETTLED_RATIO * here.dual.abs()
    }

    /// Whether `there` is to be taken; adapts the damping to how well the model foresaw it.
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

/// A step, and what the model says of it.
pub(crate) struct Step {
    pub to: DualPoint,
    /// The model's D at `to`.
    promised: f64,
    /// The model's D at the old y and λ, with τ moved.
    standing: f64,
}

impl Step {
    /// What the model promises the step to gain over standing still.
    pub fn gain(&self) -> f64 {
        self.promised - self.standing
    }

    /// Maximises D + r·d − ½ dᵀ(H + μI)d over the step d = (dy, dλ) with y + dy ∈ Y.
    pub fn from(here: &Visit, programme: &Programme, stride: &Stride) -> Self {
        let turning = programme.turning();
        let w = &here.extreme.w;
        let ratio_step = if stride.moves_ratio {
            here.dual / here.denominator
        } else {
            0.0
        };
        let eased = w * programme.denominator * ratio_step;
        let mut slope = &turning * here.extreme.s;
        slope
            .rows_mut(programme.directions.nrows(), programme.rhs.len())
            .copy_from(&here.misses);
        let model = Model {
            slope: slope + &turning * eased,
            curvature: &turning * w * turning.transpose(),
        };
        let (y, lambda) = model.maximiser(&here.point, programme, stride.damping);

        let (dy, dl) = (&y - &here.point.y, &lambda - &here.point.lambda);
        let step = DVector::from_iterator(dy.len() + dl.len(), dy.iter().chain(dl.iter()).copied());
        let fall =
            ratio_step * here.denominator + 0.5 * ratio_step * programme.denominator.dot(&eased);
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

/// D as a quadratic over (y, λ) about the present point, at the τ of the step.
struct Model {
    slope: DVector<f64>,
    curvature: DMatrix<f64>,
}

impl Model {
    /// What the model gains over a step.
    fn gain(&self, step: &DVector<f64>) -> f64 {
        self.slope.dot(step) - 0.5 * step.dot(&(&self.curvature * step))
    }

    /// The y and λ of the damped model's maximum: λ is eliminated, y is found on its set, λ
    /// follows.
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
