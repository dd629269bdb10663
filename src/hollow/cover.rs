//! The proof over every height: a finite set of intervals in each of which no interior is better.

use super::programme::{DualPoint, Programme, index};
use super::solution::Stage;
use super::work::Work;
use crate::goal::Objective;

/// Intervals examined at most. A smooth valley takes about twenty.
const MOST_INTERVALS: usize = 160;
/// How exact an interval's ascent is; its bound is rigorous however exact it is.
const COVER_TOLERANCE: f64 = 1e-3;

/// A claim about all heights: no interior, wherever its centre, has a ratio below `target`.
///
/// For a centre at height h in an interval of half width r about ℓ, the true tensor is I′(ℓ) − s₁(h − ℓ)²·1, so
/// λ_max falls short of the linear formula's by at most s₁r²; and the height row is no equation but
/// |s_z − ℓs₁| ≤ r s₁, whose multiplier costs |λ_ℓ| r s₁. So with any dual point of the programme at ℓ,
/// D = min over K of (g − (r² + |λ_ℓ| r) e₁)·s ≥ 0 proves the claim for the whole interval with one pass.
pub(super) struct Cover<'a> {
    /// How many times s₁r² the numerator falls short at most.
    pub relaxation: f64,
    pub target: f64,
    pub programme_at: &'a dyn Fn(f64) -> Programme,
}

/// By how many s₁r² the linear numerator exceeds the true one, for the objectives that a cover can speak of: those with
/// λ_max, by one.
pub(super) fn relaxation(objective: Objective) -> Option<f64> {
    matches!(objective, Objective::CriticalSpeed | Objective::Dominance).then_some(1.0)
}

impl Cover<'_> {
    /// Whether the claim is proved for every height of the range, by halving what one pass cannot prove.
    pub fn holds_over(&self, work: &Work, [low, high]: [f64; 2], near: &DualPoint) -> bool {
        let mut open = vec![[low, high]];
        let mut start = near.clone();
        for _ in 0..MOST_INTERVALS {
            let Some([low, high]) = open.pop() else { return true };
            let middle = 0.5 * (low + high);
            let programme = (self.programme_at)(middle);
            let stage = Stage::Cover { height_mm: work.to_mm(middle) };
            let climb = work.climb(stage, &programme, start, COVER_TOLERANCE);
            if work.is_cancelled() || climb.best.bound < self.target && climb.separator.is_none() {
                return false;
            }
            start = climb.best.point;
            if !self.holds_within(work, &programme, &start, 0.5 * (high - low)) {
                open.extend([[middle, high], [low, middle]]);
            }
        }
        false
    }

    /// Whether a dual point at the middle of an interval proves the claim for all of it.
    fn holds_within(&self, work: &Work, programme: &Programme, point: &DualPoint, half_width: f64) -> bool {
        let at_target = DualPoint { tau: self.target, ..point.clone() };
        let mut quadric = programme.quadric(&at_target);
        let multiplier = point.lambda[point.lambda.len() - 1];
        quadric[index::ONE] -= self.relaxation * half_width * half_width + multiplier.abs() * half_width;
        quadric.dot(&work.reach.least(&quadric)) >= 0.0
    }
}
