//! The constraints of the papers' methods: an augmented Lagrangian with repeated multiplier
//! updates.

use nalgebra::DVector;

use super::descent::{Function, Limits, descend};
use super::target::{Target, as_vector10};
use crate::base::watch::Watch;
use crate::geom::Quadric;
use crate::hollow::dual::units::Vector10;
use crate::interior::Choice;

/// First penalty, with f and As of order one. With a hundredth of it the first rounds stray far. A
/// hundred times more nearly hides f.
const FIRST_PENALTY: f64 = 10.0;
/// Least reduction of the residual per round; otherwise the penalty grows by the second factor.
const REDUCTION_RATIO: f64 = 0.25;
const PENALTY_GROWTH: f64 = 4.0;
/// Greatest penalty. Beyond it the rows' curvature hides that of f from L-BFGS. The multipliers
/// settle without it.
const GREATEST_PENALTY: f64 = 1e5;
/// Slope at which the first round ends, and the factor for each later one.
const FIRST_SLOPE: f64 = 1e-2;
const SLOPE_REDUCTION: f64 = 0.2;
/// Round limit; about eight are needed.
const ROUNDS: usize = 40;
/// Relative change of f between rounds below which it has settled.
const SETTLED_RATIO: f64 = 1e-7;

/// Accuracy and cost limits of the papers' optimiser.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Constraint residual at which it ends, in units of the solid's volume and radius of gyration.
    pub residual: f64,
    /// Slope at which it ends: the root mean square over the region of the move along one gradient
    /// step, with a gradient of order one. Much below 1e-5 the last fractional cells take most of
    /// the time.
    pub slope: f64,
    /// Limit on the evaluations of the moments and their derivative.
    pub evaluations: usize,
}

impl Default for Accuracy {
    fn default() -> Self {
        Self {
            residual: 1e-6,
            slope: 1e-4,
            evaluations: 20_000,
        }
    }
}

/// The start of an optimisation.
pub(super) struct Start {
    pub x: Vec<f64>,
    /// Multipliers and penalty of an earlier run on other cells.
    pub known: Option<(DVector<f64>, f64)>,
    /// Weight of the roughness: the mean of ½(xᵢ − xⱼ)² over the pairs of neighbours.
    pub smoothing: f64,
}

impl From<Vec<f64>> for Start {
    fn from(x: Vec<f64>) -> Self {
        Self {
            x,
            known: None,
            smoothing: 0.0,
        }
    }
}

/// The accuracy and the stop signal of the optimiser.
#[derive(Clone, Copy)]
pub(super) struct Effort<'a> {
    pub accuracy: &'a Accuracy,
    pub watch: &'a Watch,
}

/// The result of an optimisation.
pub(super) struct Optimum {
    pub x: Vec<f64>,
    /// Effect of material at each place, without unit; positive in the void.
    pub quadric: Quadric,
    pub multipliers: DVector<f64>,
    pub penalty: f64,
    pub evaluations: usize,
    pub has_converged: bool,
    pub is_cancelled: bool,
}

/// The function f + λ·As + ½ρ‖As‖² + smoothing·roughness of a choice's variables.
struct Lagrangian<'a> {
    target: &'a Target<'a>,
    choice: &'a dyn Choice,
    multipliers: DVector<f64>,
    penalty: f64,
    smoothing: f64,
}

impl Function for Lagrangian<'_> {
    fn weights(&self) -> &[f64] {
        self.choice.weights()
    }

    fn evaluate(&self, x: &[f64], slope: &mut [f64]) -> f64 {
        let s = self.target.remaining(&self.choice.moments(x));
        let (value, gradient) = self.target.at(&s);
        let misses = self.target.misses(&s);
        self.choice
            .derivative(x, &self.quadric(gradient, &misses), slope);
        // Emptying removes moments, so the quadric enters with the opposite sign.
        let volume_mm3 = self.target.scale().volume_mm3;
        slope.iter_mut().for_each(|slope| *slope /= -volume_mm3);
        let constraints =
            self.multipliers.dot(&misses) + 0.5 * self.penalty * misses.norm_squared();
        value + constraints + self.roughness(x, slope)
    }
}

impl Lagrangian<'_> {
    /// Returns g = ∇f + Aᵀ(λ + ρAs) over mm, without unit: the effect of a grain of material, over
    /// its volume.
    fn quadric(&self, gradient: Vector10, misses: &DVector<f64>) -> Quadric {
        let row_part = self
            .target
            .rows()
            .tr_mul(&(&self.multipliers + misses * self.penalty));
        let scale = self.target.scale();
        scale.quadric_to_mm(&((gradient + as_vector10(&row_part)) * scale.volume_mm3))
    }

    /// Returns the smoothing term; adds its derivative, the uniform Laplacian, to the slope.
    fn roughness(&self, x: &[f64], slope: &mut [f64]) -> f64 {
        let pairs = self.choice.neighbours();
        if self.smoothing == 0.0 || pairs.is_empty() {
            return 0.0;
        }
        let (factor, weights) = (self.smoothing / pairs.len() as f64, self.weights());
        let mut sum = 0.0;
        for [i, j] in pairs.iter().map(|pair| pair.map(|i| i as usize)) {
            let step = x[i] - x[j];
            sum += step * step;
            slope[i] += factor * step / weights[i];
            slope[j] -= factor * step / weights[j];
        }
        0.5 * factor * sum
    }
}

/// Minimises f over a choice subject to the constraints, to first-order optimality.
pub(super) fn minimise(
    target: &Target,
    choice: &dyn Choice,
    start: Start,
    effort: Effort,
) -> Optimum {
    let Effort { accuracy, watch } = effort;
    let (multipliers, penalty) = start
        .known
        .unwrap_or_else(|| (DVector::zeros(target.rows().nrows()), FIRST_PENALTY));
    let mut lagrangian = Lagrangian {
        target,
        choice,
        multipliers,
        penalty,
        smoothing: start.smoothing,
    };
    let (mut x, mut evaluations, mut slope) = (start.x, 0, FIRST_SLOPE);
    let (mut last_residual, mut last_value) = (f64::INFINITY, f64::INFINITY);
    let mut has_converged = false;
    for _ in 0..ROUNDS {
        let left = accuracy.evaluations.saturating_sub(evaluations);
        let limits = Limits {
            slope: slope.max(accuracy.slope),
            evaluations: left,
            watch,
        };
        let place = descend(&lagrangian, x, &limits);
        evaluations += place.evaluations;
        x = place.x;
        let s = target.remaining(&choice.moments(&x));
        let (misses, value) = (target.misses(&s), target.at(&s).0);
        let residual = misses.amax();
        let is_settled =
            slope <= accuracy.slope || (last_value - value).abs() <= SETTLED_RATIO * value.abs();
        has_converged = residual <= accuracy.residual && is_settled;
        if has_converged || evaluations >= accuracy.evaluations || watch.check().is_err() {
            break;
        }
        lagrangian.multipliers += misses * lagrangian.penalty;
        if residual > REDUCTION_RATIO * last_residual && residual > accuracy.residual {
            lagrangian.penalty = (lagrangian.penalty * PENALTY_GROWTH).min(GREATEST_PENALTY);
        }
        (last_residual, last_value) = (residual, value);
        slope *= SLOPE_REDUCTION;
    }
    let s = target.remaining(&choice.moments(&x));
    Optimum {
        quadric: lagrangian.quadric(target.at(&s).1, &target.misses(&s)),
        x,
        multipliers: lagrangian.multipliers,
        penalty: lagrangian.penalty,
        evaluations,
        has_converged,
        is_cancelled: watch.is_cancelled(),
    }
}
