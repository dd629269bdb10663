//! The evaluation of the dual at one point: the extreme interior and the bound.

use nalgebra::DVector;

use super::programme::{DualPoint, Programme};
use super::reach::Reach;
use super::units::{Extreme, Vector10, index};
use crate::hollow::log::Pass;

/// A dual point, the extreme interior of its quadric, and the bound they prove.
#[derive(Debug, Clone)]
pub(crate) struct Visit {
    pub point: DualPoint,
    /// Coefficients of the quadric in the solver's units.
    pub quadric: Vector10,
    pub extreme: Extreme,
    /// Dual value D = min over K at this point.
    pub dual: f64,
    /// Residuals As − b of the rows.
    pub misses: DVector<f64>,
    /// Ratio of the extreme interior, which meets the rows up to `misses`.
    pub value: f64,
    /// Lower bound of the ratio over all interiors that meet the rows.
    pub bound: f64,
    /// Denominator of the extreme interior.
    pub denominator: f64,
}

impl Visit {
    pub fn new(reach: &Reach, programme: &Programme, point: DualPoint) -> Self {
        let quadric = programme.quadric(&point);
        let extreme = reach.extreme(&quadric);
        let dual = quadric.dot(&extreme.s) + extreme.cost - programme.rhs.dot(&point.lambda);
        let denominator = programme.denominator_at(&extreme.s);
        Self {
            misses: &programme.rows * extreme.s - &programme.rhs,
            value: (programme.numerator_at(&extreme.s) + extreme.cost) / denominator,
            bound: programme.bound(point.tau, dual),
            quadric,
            extreme,
            dual,
            denominator,
            point,
        }
    }

    /// Returns its ratio and its bound.
    pub fn pass(&self) -> Pass {
        Pass {
            value: self.value,
            bound: self.bound,
        }
    }

    /// Returns the largest residual of the rows, in the solver's units.
    pub fn residual(&self) -> f64 {
        self.misses.amax()
    }

    /// Returns the gap between value and bound as a part of the value, with 1e-3 as the least
    /// divisor.
    pub fn gap_ratio(&self) -> f64 {
        (self.value - self.bound) / self.value.abs().max(1e-3)
    }

    /// Returns the mass of the extreme interior.
    pub fn mass(&self) -> f64 {
        self.extreme.s[index::ONE]
    }

    /// Returns the lever s_z of the extreme interior.
    pub fn lever(&self) -> f64 {
        self.extreme.s[index::Z]
    }

    /// Returns the height of the extreme interior's centre.
    pub fn center_height(&self) -> f64 {
        self.extreme.s[index::Z] / self.extreme.s[index::ONE]
    }

    /// Returns true if the bound is good enough, given the gain in D that the next step promises.
    pub fn suffices(&self, gain: f64, slack: Slack) -> bool {
        let promised = self.point.tau + (self.dual + gain) / self.denominator;
        promised - self.bound <= slack.share * promised.abs() || self.bound >= slack.enough
    }

    pub fn is_within(&self, tolerance: f64) -> bool {
        self.residual() <= tolerance && self.gap_ratio().abs() <= tolerance
    }

    pub fn error(&self) -> f64 {
        self.residual().max(self.gap_ratio().abs())
    }
}

/// The criterion for a bound that is good enough.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slack {
    /// Share of itself by which it may still rise.
    pub share: f64,
    /// Bound that suffices in any case.
    pub enough: f64,
}
