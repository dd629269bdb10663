//! The constraints of the papers' methods: an augmented Lagrangian, minimised again and again with
//! better multipliers.

use nalgebra::DVector;

use super::descent::{Function, Limits, descend};
use super::target::{Target, as_vector10};
use crate::base::watch::Watch;
use crate::geom::Quadric;
use crate::hollow::dual::units::Vector10;
use crate::interior::Choice;

/// The first penalty, where f and As are of order one. A hundred times less, and the first rounds
/// stray far; a hundred times more, and f hardly shows beside it.
const FIRST_PENALTY: f64 = 10.0;
/// A round that does not bring the residual below this part of the one before raises the penalty by
/// this factor.
const ENOUGH_RATIO: f64 = 0.25;
const STIFFEN: f64 = 4.0;
/// No penalty is greater: beyond, the rows' curvature hides f's from L-BFGS, and the multipliers
/// settle without it.
const GREATEST_PENALTY: f64 = 1e5;
/// The slope to which the first round goes, and how much exacter each one after it is.
const FIRST_SLOPE: f64 = 1e-2;
const SHARPEN: f64 = 0.2;
/// Rounds at most; about eight are needed.
const ROUNDS: usize = 40;
/// A change of f between rounds, as a part of it, below which it is settled.
const SETTLED_RATIO: f64 = 1e-7;

/// How exact the optimiser of the papers' methods shall be, and what it may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// The residual of the constraints at which it ends, in units of the solid's volume and radius
    /// of gyration.
    pub residual: f64,
    /// The slope at which it ends: the root mean square over the region of how far a step along the
    /// gradient moves, where the gradient is of order one. Much below 1e-5 the last fractional
    /// cells take most of the time.
    pub slope: f64,
    /// Evaluations of the moments and their derivative in all.
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

/// Where to start from.
pub(super) struct Start {
    pub x: Vec<f64>,
    /// Multipliers and penalty of an earlier run on other cells.
    pub known: Option<(DVector<f64>, f64)>,
    /// The weight of the roughness ½Σ(xᵢ − xⱼ)² over the pairs of neighbours, as a mean over the
    /// pairs.
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

/// The accuracy asked of the optimiser, and the caller's stop signal.
#[derive(Clone, Copy)]
pub(super) struct Effort<'a> {
    pub accuracy: &'a Accuracy,
    pub watch: &'a Watch<'a>,
}

/// Where the rounds came to.
pub(super) struct Optimum {
    pub x: Vec<f64>,
    /// What material adds at each place, without unit; the void is where this is positive.
    pub quadric: Quadric,
    pub multipliers: DVector<f64>,
    pub penalty: f64,
    pub evaluations: usize,
    pub has_converged: bool,
    pub is_cancelled: bool,
}

/// f + λ·As + ½ρ‖As‖² + smoothing·roughness, of a choice's numbers.
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
        let s = self.target.left(&self.choice.moments(x));
        let (value, gradient) = self.target.at(&s);
        let misses = self.target.misses(&s);
        self.choice
            .derivative(x, &self.quadric(gradient, &misses), slope);
        // Emptying takes moments away, so the quadric enters with the opposite sign.
        let volume_mm3 = self.target.scale().volume_mm3;
        slope.iter_mut().for_each(|slope| *slope /= -volume_mm3);
        let constraints =
            self.multipliers.dot(&misses) + 0.5 * self.penalty * misses.norm_squared();
        value + constraints + self.roughness(x, slope)
    }
}

impl Lagrangian<'_> {
    /// g = ∇f + Aᵀ(λ + ρAs) over mm, without unit: what a grain of material adds to the whole, over
    /// its volume.
    fn quadric(&self, gradient: Vector10, misses: &DVector<f64>) -> Quadric {
        let pull = self
            .target
            .rows()
            .tr_mul(&(&self.multipliers + misses * self.penalty));
        let scale = self.target.scale();
        scale.quadric_to_mm(&((gradient + as_vector10(&pull)) * scale.volume_mm3))
    }

    /// The smoothing's part; its derivative, the uniform Laplacian, is added to the slope.
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

/// The least of f over a choice subject to the constraints, as far as first-order conditions tell.
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
        let s = target.left(&choice.moments(&x));
        let (misses, value) = (target.misses(&s), target.at(&s).0);
        let residual = misses.amax();
        let is_settled =
            slope <= accuracy.slope || (last_value - value).abs() <= SETTLED_RATIO * value.abs();
        has_converged = residual <= accuracy.residual && is_settled;
        if has_converged || evaluations >= accuracy.evaluations || watch.is_cancelled() {
            break;
        }
        lagrangian.multipliers += misses * lagrangian.penalty;
        if residual > ENOUGH_RATIO * last_residual && residual > accuracy.residual {
            lagrangian.penalty = (lagrangian.penalty * STIFFEN).min(GREATEST_PENALTY);
        }
        (last_residual, last_value) = (residual, value);
        slope *= SHARPEN;
    }
    let s = target.left(&choice.moments(&x));
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
