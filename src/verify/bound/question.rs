//! The question of a proof: how good can any hollowing be?

use super::core::Core;
use super::ground::{Form, Ground, Ten, Weights};
use crate::mass::Moments;
use crate::verify::{BoundPoint, BoundProof};

/// Rounds of Newton's method; it needs about five, and comes from one side.
const ROUNDS: usize = 40;
/// Change of a ratio at which it ends, as a part of it. The cells are far coarser.
const END_RATIO: f64 = 1e-7;
/// Excess of the weights over their set that rounding may cause.
const WEIGHT_SLACK: f64 = 1e-9;

/// A proof, and what it is held against.
pub(super) struct Question<'a> {
    pub ground: &'a Ground,
    pub core: &'a Core,
    pub proof: &'a BoundProof,
}

/// The quadric of a point but for its ratio, and the constant that it must reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Base {
    pub quadric: Ten,
    pub least: f64,
}

impl Question<'_> {
    /// Returns the greatest ratio below which no hollowing is, by one point.
    ///
    /// Along the ratio the least value is concave and falls. So Newton's method overshoots once,
    /// and then comes nearer from above.
    pub fn ratio(&self, base: &Base, denominator: &Ten) -> Option<f64> {
        if *denominator == [0.0; 10] {
            return Some(self.least(&base.quadric).0 - base.least);
        }
        let mut ratio = 0.0;
        for _ in 0..ROUNDS {
            let quadric = minus(&base.quadric, denominator, ratio);
            let (least, body) = self.least(&quadric);
            let slope = dot(denominator, &body);
            let step = (least - base.least) / slope;
            if !(slope > 0.0 && step.is_finite()) {
                return None;
            }
            ratio += step;
            if step.abs() <= END_RATIO * ratio.abs() {
                break;
            }
        }
        Some(ratio)
    }

    /// Returns the least value of a quadric over all hollowings, and the moments of the body that
    /// has it.
    fn least(&self, quadric: &Ten) -> (f64, Moments) {
        let (emptied, integral) = self.core.emptied(quadric);
        let body = self.ground.solid - emptied;
        (dot(quadric, &self.ground.solid) - integral, body)
    }
}

/// Returns the quadric of a point of a form; `None` if the point is none.
pub(super) fn base(form: &Form, point: &BoundPoint) -> Option<Base> {
    let (weights, multipliers) = (&point.weights, &point.multipliers);
    let fits = weights.len() == form.directions.len() && multipliers.len() == form.rows.len();
    let is_weight = match form.weights {
        Weights::Ball => weights.iter().map(|y| y * y).sum::<f64>() <= 1.0 + WEIGHT_SLACK,
        Weights::Shares => {
            let sum: f64 = weights.iter().sum();
            (sum - 1.0).abs() <= WEIGHT_SLACK && weights.iter().all(|&y| y >= 0.0)
        }
    };
    if !(fits && is_weight) {
        return None;
    }
    let mut quadric = form.numerator;
    let rows = form.directions.iter().zip(weights);
    for (row, factor) in rows.chain(form.rows.iter().zip(multipliers)) {
        quadric = minus(&quadric, row, -factor);
    }
    let least = form.rhs.iter().zip(multipliers).map(|(b, l)| b * l).sum();
    Some(Base { quadric, least })
}

/// Returns a − factor·b.
pub(super) fn minus(a: &Ten, b: &Ten, factor: f64) -> Ten {
    std::array::from_fn(|i| a[i] - factor * b[i])
}

fn dot(a: &Ten, moments: &Moments) -> f64 {
    a.iter().zip(moments.0).map(|(a, m)| a * m).sum()
}
