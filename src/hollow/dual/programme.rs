//! Every goal as a quasi-convex programme over the ten moments: minimise a convex function over a
//! positive one.

use nalgebra::{DMatrix, DVector};

use super::reach::Reach;
use super::set::DualSet;
use super::units::Vector10;
use crate::hollow::log::Stage;

/// Minimise (n·s + max_{y∈Y} yᵀJs) / (e·s) over the s ∈ K with As = b; e·s > 0 on all of K (THEORY
/// §3).
#[derive(Debug, Clone)]
pub(crate) struct Programme {
    /// What it is for.
    pub stage: Stage,
    /// n
    pub numerator: Vector10,
    /// J, k × 10
    pub directions: DMatrix<f64>,
    /// Y
    pub set: DualSet,
    /// e
    pub denominator: Vector10,
    /// A positive lower bound of e·s over the s that meet the rows.
    pub denominator_floor: f64,
    /// An upper bound of it.
    pub denominator_ceiling: f64,
    /// A, m × 10
    pub rows: DMatrix<f64>,
    /// b
    pub rhs: DVector<f64>,
}

/// A point of the dual: the weights y, a multiplier for each row, and the ratio on trial.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DualPoint {
    pub y: DVector<f64>,
    pub lambda: DVector<f64>,
    pub tau: f64,
}

impl Programme {
    /// A programme over the ball whose rows all vanish, for the goal itself; its denominator is not
    /// yet bounded.
    pub fn new(
        numerator: Vector10,
        directions: DMatrix<f64>,
        denominator: Vector10,
        rows: DMatrix<f64>,
    ) -> Self {
        let stage = Stage::Goal;
        let rhs = DVector::zeros(rows.nrows());
        let (denominator_floor, denominator_ceiling) = (0.0, 0.0);
        let set = DualSet::Ball;
        Self {
            stage,
            numerator,
            directions,
            set,
            denominator,
            denominator_floor,
            denominator_ceiling,
            rows,
            rhs,
        }
    }

    /// For a denominator that grows with every bit of material: bounded by the shell and by the
    /// fullest interior.
    pub fn bounded(mut self, reach: &Reach) -> Self {
        self.denominator_floor = self.denominator.dot(&reach.shell);
        self.denominator_ceiling = self.denominator.dot(&reach.fullest);
        self
    }

    /// How far from met the rows are for the best interior: min ‖As‖. Positive is the proof that
    /// none meets them.
    pub fn feasibility(&self) -> Self {
        let rows = DMatrix::zeros(0, 10);
        Self::new(
            Vector10::zeros(),
            self.rows.clone(),
            Vector10::zeros(),
            rows,
        )
    }

    /// The convex numerator at s.
    pub fn numerator_at(&self, s: &Vector10) -> f64 {
        self.numerator.dot(s) + self.set.support(&(&self.directions * s))
    }

    /// The quadric g = n + Jᵀy − τe + Aᵀλ whose extreme interior the dual point names.
    pub fn quadric(&self, point: &DualPoint) -> Vector10 {
        let turning = self.directions.tr_mul(&point.y) + self.rows.tr_mul(&point.lambda);
        self.numerator - self.denominator * point.tau
            + Vector10::from_column_slice(turning.as_slice())
    }

    /// The denominator at s, kept from below its floor; one where there is none.
    pub fn denominator_at(&self, s: &Vector10) -> f64 {
        if self.is_ratio() {
            self.denominator.dot(s).max(self.denominator_floor)
        } else {
            1.0
        }
    }

    /// Whether there is a denominator; without one the value is the numerator alone.
    pub fn is_ratio(&self) -> bool {
        self.denominator_floor > 0.0
    }

    /// Whether every right-hand side is zero.
    pub fn is_homogeneous(&self) -> bool {
        self.rhs.iter().all(|&b| b == 0.0)
    }

    /// J over A: how g turns with (y, λ).
    pub fn turning(&self) -> DMatrix<f64> {
        let k = self.directions.nrows();
        DMatrix::from_fn(k + self.rows.nrows(), 10, |i, j| {
            if i < k {
                self.directions[(i, j)]
            } else {
                self.rows[(i - k, j)]
            }
        })
    }

    /// The greatest ratio that the dual value D at trial ratio τ proves to be a lower bound: along
    /// τ, D falls by no less than the floor and no more than the ceiling of the denominator.
    pub fn bound(&self, tau: f64, dual: f64) -> f64 {
        if !self.is_ratio() {
            return dual;
        }
        tau + dual
            / if dual < 0.0 {
                self.denominator_floor
            } else {
                self.denominator_ceiling
            }
    }

    /// A dual point to start from cold: the weights and the ratio of the solid, no multipliers.
    pub fn cold_start(&self, reach: &Reach) -> DualPoint {
        let ratio = self.numerator_at(&reach.solid) / self.denominator.dot(&reach.solid);
        DualPoint {
            y: self.set.maximiser(&(&self.directions * reach.solid)),
            lambda: DVector::zeros(self.rows.nrows()),
            tau: if self.is_ratio() { ratio } else { 0.0 },
        }
    }

    /// A known dual point, fitted to this programme's rows, or a cold start.
    pub fn start_near(&self, reach: &Reach, near: Option<&DualPoint>) -> DualPoint {
        let fitting = near.filter(|point| point.y.len() == self.directions.nrows());
        let Some(point) = fitting else {
            return self.cold_start(reach);
        };
        let multiplier = |i: usize| point.lambda.get(i).copied().unwrap_or(0.0);
        let lambda = DVector::from_fn(self.rhs.len(), |i, _| multiplier(i));
        DualPoint {
            lambda,
            ..point.clone()
        }
    }
}
