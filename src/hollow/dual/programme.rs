//! A goal as a quasi-convex programme over the ten moments, and the points of its dual.

use nalgebra::{DMatrix, DVector};

use super::reach::Reach;
use super::set::DualSet;
use super::units::Vector10;
use crate::hollow::log::Stage;

/// The programme: minimise (n·s + max_{y∈Y} yᵀJs) / (e·s) over the s ∈ K with As = b.
///
/// The denominator e·s is positive on all of K ([theory §2](crate::guide::theory#2-goals)).
#[derive(Debug, Clone)]
pub(crate) struct Programme {
    /// Search it belongs to.
    pub stage: Stage,
    /// n
    pub numerator: Vector10,
    /// J, k × 10
    pub directions: DMatrix<f64>,
    /// Y
    pub set: DualSet,
    /// e
    pub denominator: Vector10,
    /// Positive lower bound of e·s over the s that meet the rows; zero if there is no denominator.
    pub denominator_floor: f64,
    /// Upper bound of e·s.
    pub denominator_ceiling: f64,
    /// A, m × 10
    pub rows: DMatrix<f64>,
    /// b
    pub rhs: DVector<f64>,
}

/// A point of the dual: the weights y, a multiplier for each row, and the trial ratio τ.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DualPoint {
    pub y: DVector<f64>,
    pub lambda: DVector<f64>,
    pub tau: f64,
}

impl Programme {
    /// Returns a programme over the ball with right-hand sides of zero. Its denominator has no
    /// bounds yet.
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

    /// Adds the bounds of a denominator that grows with every bit of material: its values at the
    /// shell and at the fullest interior.
    pub fn with_denominator_bounds(mut self, reach: &Reach) -> Self {
        self.denominator_floor = self.denominator.dot(&reach.shell);
        self.denominator_ceiling = self.denominator.dot(&reach.fullest);
        self
    }

    /// Returns the programme of the least residual, min ‖As‖. A positive value proves that no
    /// interior meets the rows.
    pub fn feasibility(&self) -> Self {
        let rows = DMatrix::zeros(0, 10);
        Self::new(
            Vector10::zeros(),
            self.rows.clone(),
            Vector10::zeros(),
            rows,
        )
    }

    /// Returns the convex numerator at s.
    pub fn numerator_at(&self, s: &Vector10) -> f64 {
        self.numerator.dot(s) + self.set.support(&(&self.directions * s))
    }

    /// Returns the quadric g = n + Jᵀy − τe + Aᵀλ of a dual point.
    pub fn quadric(&self, point: &DualPoint) -> Vector10 {
        let combination = self.directions.tr_mul(&point.y) + self.rows.tr_mul(&point.lambda);
        self.numerator - self.denominator * point.tau
            + Vector10::from_column_slice(combination.as_slice())
    }

    /// Returns the denominator at s, at least its floor; 1 if there is no denominator.
    pub fn denominator_at(&self, s: &Vector10) -> f64 {
        if self.is_ratio() {
            self.denominator.dot(s).max(self.denominator_floor)
        } else {
            1.0
        }
    }

    /// Returns true if there is a denominator; without one the value is the numerator alone.
    pub fn is_ratio(&self) -> bool {
        self.denominator_floor > 0.0
    }

    /// Returns true if every right-hand side is zero.
    pub fn is_homogeneous(&self) -> bool {
        self.rhs.iter().all(|&b| b == 0.0)
    }

    /// Returns J stacked on A, the derivative of g by (y, λ).
    pub fn jacobian(&self) -> DMatrix<f64> {
        let k = self.directions.nrows();
        DMatrix::from_fn(k + self.rows.nrows(), 10, |i, j| {
            if i < k {
                self.directions[(i, j)]
            } else {
                self.rows[(i - k, j)]
            }
        })
    }

    /// Returns the greatest lower bound of the ratio that the dual value D proves at the trial
    /// ratio τ.
    ///
    /// Along τ, D falls at least at the rate of the denominator's floor and at most at that of its
    /// ceiling.
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

    /// Returns the dual point of a cold start: weights and ratio of the solid, multipliers zero.
    pub fn cold_start(&self, reach: &Reach) -> DualPoint {
        let ratio = self.numerator_at(&reach.solid) / self.denominator.dot(&reach.solid);
        DualPoint {
            y: self.set.maximiser(&(&self.directions * reach.solid)),
            lambda: DVector::zeros(self.rows.nrows()),
            tau: if self.is_ratio() { ratio } else { 0.0 },
        }
    }

    /// Fits a known dual point to this programme's rows; returns a cold start if it does not fit.
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
