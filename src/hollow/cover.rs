//! The proof over every height: a finite set of intervals in each of which no interior is better.

use super::heights::Heights;
use super::programme::{DualPoint, HEIGHT_ROW, index};
use super::reach::Vector10;
use super::solution::Stage;
use crate::goal::Objective;

/// Intervals examined at most. A smooth valley takes about twenty.
const MOST_INTERVALS: usize = 160;
/// How exact an interval's ascent is at first; its bound is rigorous however exact it is.
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
        let mut climb = work.climb(&programme, start.clone(), COVER_TOLERANCE);
        if climb.separator.is_none() && climb.best.bound < self.target {
            climb = work.climb(&programme, climb.best.point, 0.0);
        }
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

#[cfg(test)]
mod tests {
    use super::super::work::Work;
    use super::super::{Settings, worlds};
    use super::*;
    use crate::progress::Progress;

    #[test]
    fn a_true_claim_is_proved_and_a_false_one_is_not() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let (settings, progress, problem) = (Settings::default(), Progress::silent(), world.problem());
        let work = Work::new(&problem, &settings, &progress);
        let heights = Heights { work: &work, objective: Objective::CriticalSpeed };
        let range = Heights::range(&work).unwrap();
        let best = heights.lowest(range).unwrap().sample;
        for (share, expected) in [(1.1, true), (1.01, true), (0.99, false), (0.5, false)] {
            // The ratio is −g/ω², so a target further below zero is a weaker claim.
            let cover = Cover { heights, target: share * best.value };
            assert_eq!(cover.holds_over(range, &best.climb.best.point), expected, "{share}");
        }
    }
}
