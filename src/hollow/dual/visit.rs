//! One look at a dual point: its interior, and what the two prove.

use nalgebra::DVector;

use super::programme::{DualPoint, Programme};
use super::reach::Reach;
use super::units::{Extreme, Vector10, index};
use crate::hollow::log::Pass;

/// A dual point, its quadric's extreme interior, and what they prove.
#[derive(Debug, Clone)]
pub(crate) struct Visit {
    pub point: DualPoint,
    /// The quadric's coefficients in the solver's units.
    pub quadric: Vector10,
    pub extreme: Extreme,
    /// D = min over K at this point.
    pub dual: f64,
    /// As − b
    pub misses: DVector<f64>,
    /// The ratio of the extreme interior, which meets the rows up to `misses`.
    pub value: f64,
    /// No interior that meets the rows has a smaller ratio.
    pub bound: f64,
    /// The denominator of the extreme interior.
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

    /// Its ratio and its bound.
    pub fn pass(&self) -> Pass {
        Pass {
            value: self.value,
            bound: self.bound,
        }
    }

    /// How far the rows are from met, in the solver's units.
    pub fn residual(&self) -> f64 {
        self.misses.amax()
    }

    /// Value over bound, as a part of the value (of one where it is smaller than a thousandth).
    pub fn gap_ratio(&self) -> f64 {
        (self.value - self.bound) / self.value.abs().max(1e-3)
    }

    /// The extreme interior's mass.
    pub fn mass(&self) -> f64 {
        self.extreme.s[index::ONE]
    }

    /// Its lever s_z.
    pub fn lever(&self) -> f64 {
        self.extreme.s[index::Z]
    }

    /// The height of the extreme interior's centre.
    pub fn center_height(&self) -> f64 {
        self.extreme.s[index::Z] / self.extreme.s[index::ONE]
    }

    /// Whether the bound is good enough, where the next step promises this gain in D.
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

/// When a bound is good enough.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slack {
    /// It may still rise by this share of itself,
    pub share: f64,
    /// or it is this much.
    pub enough: f64,
}
