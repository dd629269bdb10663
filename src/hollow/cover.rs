//! The proof over every height: a finite set of intervals in each of which no interior is better.

use super::heights::Heights;
use super::programme::{DualPoint, HEIGHT_ROW, index};
use super::reach::Vector10;
use super::solution::Stage;
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
    pub heights: Heights<'a>,
    pub target: f64,
}

/// Whether a cover can speak of this objective: of those with λ_max, which loses s₁r² and no more.
pub(super) fn can_cover(objective: Objective) -> bool {
    matches!(objective, Objective::CriticalSpeed | Objective::Dominance)
}

impl Cover<'_> {
    /// Whether the claim is proved for every height of the range, by halving what one pass cannot prove.
    pub fn holds_over(&self, range: [f64; 2], near: &DualPoint) -> bool {
        let mut open = vec![range];
        let mut start = near.clone();
        for _ in 0..MOST_INTERVALS {
            let Some([low, high]) = open.pop() else { return true };
            let middle = 0.5 * (low + high);
            match self.holds_within(middle, 0.5 * (high - low), &mut start) {
                Some(true) => {}
                Some(false) => open.extend([[middle, high], [low, middle]]),
                None => return false,
            }
        }
        open.is_empty()
    }

    /// Whether the claim is proved for the interval about a height; none where the height itself breaks it.
    fn holds_within(&self, height: f64, half_width: f64, start: &mut DualPoint) -> Option<bool> {
        let work = self.heights.work;
        let mut programme = self.heights.programme(height);
        programme.stage = Stage::Cover { height_mm: work.to_mm(height) };
        let climb = work.climb(&programme, start.clone(), COVER_TOLERANCE);
        if let Some(separator) = &climb.separator {
            let slack = separator[HEIGHT_ROW].abs() * half_width;
            return Some(self.is_positive(climb.best.quadric, slack));
        }
        if work.is_cancelled() || climb.best.bound < self.target {
            return None;
        }
        *start = climb.best.point;
        let quadric = programme.quadric(&DualPoint { tau: self.target, ..start.clone() });
        let slack = (half_width + start.lambda[HEIGHT_ROW].abs()) * half_width;
        Some(self.is_positive(quadric, slack))
    }

    /// Whether (g − slack·e₁)·s ≥ 0 for every interior; one pass.
    fn is_positive(&self, mut quadric: Vector10, slack: f64) -> bool {
        quadric[index::ONE] -= slack;
        quadric.dot(&self.heights.work.reach.least(&quadric)) >= 0.0
    }
}
