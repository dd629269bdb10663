//! The least of a smooth function of one number whose slope comes free with its value.

use super::ascent::Climb;
use super::programme::DualPoint;
use super::solution::Tangent;

/// Rounds of a descent; the secant needs about six.
const ROUNDS: usize = 16;
/// A descent ends when the next step promises less than this part of the value: the value is then exact to twice it.
const PROMISE_RATIO: f64 = 1e-8;
/// Values below this count as this large, lest a value near zero ask for impossible precision.
const LEAST_VALUE: f64 = 1e-3;
/// The longest step from a hint, as a part of its place: on finer or corrected columns the bottom hardly moves.
const HINT_RANGE_RATIO: f64 = 0.05;
/// A bracket narrower than this part of its place cannot be split usefully.
const NARROW_RATIO: f64 = 1e-12;

/// The function at one place.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub at: f64,
    pub value: f64,
    pub slope: f64,
    /// The ascent that gave it.
    pub climb: Climb,
    /// The mass the function was least at, where it was minimised over that too.
    pub mass: Option<f64>,
}

impl Sample {
    /// What a sample near this one starts from.
    pub fn start(&self) -> (&DualPoint, Option<f64>) {
        (&self.climb.best.point, self.mass)
    }
}

/// The lowest point of a valley.
#[derive(Debug, Clone)]
pub(super) struct Bottom {
    pub sample: Sample,
    /// The derivative of the slope there.
    pub curvature: f64,
}

impl Bottom {
    /// What a later search of a similar function starts from.
    pub fn tangent(&self) -> Tangent {
        Tangent { at: self.sample.at, curvature: self.curvature }
    }
}

/// A search for the place where the slope turns from falling to rising.
#[derive(Debug, Clone)]
pub(super) struct Valley {
    /// The bottom lies between these, as far as exact samples tell.
    low: f64,
    high: f64,
    /// No step is longer.
    longest_step: f64,
    /// Rough samples to aim by, then the exact ones; the secant goes through the last two.
    known: Vec<Sample>,
    rough: usize,
    /// Where the bottom was in a similar function, and the growth of the slope there.
    hint: Option<Tangent>,
}

impl Valley {
    /// A search over a range of which nothing is known.
    pub fn unknown(low: f64, high: f64) -> Self {
        Self { low, high, longest_step: high - low, known: Vec::new(), rough: 0, hint: None }
    }

    /// A search near the bottom of a similar function.
    pub fn near(hint: Tangent) -> Self {
        let longest_step = HINT_RANGE_RATIO * hint.at;
        Self { longest_step, hint: Some(hint), ..Self::unknown(0.0, 2.0 * hint.at) }
    }

    /// A search for every place of the range where rough samples, ascending, show a fall and then a rise; the ends of
    /// the range count as walls. The samples are aimed by, not trusted.
    pub fn all_between(low: f64, high: f64, samples: &[Sample]) -> Vec<Self> {
        let falls = |sample: Option<&Sample>, at_wall| sample.map_or(at_wall, |sample| sample.slope < 0.0);
        let ends_fall = |gap: &usize| {
            let before = gap.checked_sub(1).and_then(|i| samples.get(i));
            falls(before, true) && !falls(samples.get(*gap), false)
        };
        let aimed = |gap: usize| Self {
            longest_step: 2.0 * (high - low) / samples.len().max(1) as f64,
            rough: (gap + 1).min(samples.len()) - gap.saturating_sub(1),
            known: samples[gap.saturating_sub(1)..(gap + 1).min(samples.len())].to_vec(),
            ..Self::unknown(low, high)
        };
        (0..=samples.len()).filter(ends_fall).map(aimed).collect()
    }

    /// The bottom, by a secant on the slope that the exact samples keep from straying; none where no place can be
    /// sampled.
    pub fn bottom(
        mut self,
        mut sample_at: impl FnMut(f64, Option<&Sample>) -> Option<Sample>,
    ) -> Option<Bottom> {
        for _ in 0..ROUNDS {
            let next = self.next_place();
            if self.is_at_bottom(next) {
                break;
            }
            let sample = sample_at(next, self.known.last())?;
            if sample.slope < 0.0 {
                self.low = next
            } else {
                self.high = next
            }
            self.known.push(sample);
        }
        let curvature = self.curvature();
        let best = self.known.drain(self.rough..).min_by(|a, b| a.value.total_cmp(&b.value));
        best.map(|sample| Bottom { sample, curvature })
    }

    /// Where the line through the last two slopes vanishes, if that is downhill; never further than the longest step,
    /// nor more than half way to an end of what is left.
    fn next_place(&self) -> f64 {
        let middle = 0.5 * (self.low + self.high);
        let Some(last) = self.known.last() else { return self.hint.map_or(middle, |hint| hint.at) };
        let curvature = self.curvature();
        let longest = self.longest_step.copysign(-last.slope);
        let newton = if curvature > 0.0 { -last.slope / curvature } else { longest };
        let place = last.at + if newton.abs() < longest.abs() { newton } else { longest };
        let end = if last.slope < 0.0 { self.high } else { self.low };
        if self.low < place && place < self.high { place } else { 0.5 * (last.at + end) }
    }

    fn is_at_bottom(&self, next: f64) -> bool {
        let Some(last) = self.known[self.rough..].last() else { return false };
        let promise = 0.5 * (last.slope * (next - last.at)).abs();
        promise <= PROMISE_RATIO * last.value.abs().max(LEAST_VALUE)
            || self.high - self.low <= NARROW_RATIO * (self.low.abs() + self.high.abs())
    }

    /// The growth of the slope between the last two samples; where there are not two, the hint's or zero.
    fn curvature(&self) -> f64 {
        match &self.known[..] {
            [.., before, last] if last.at != before.at => (last.slope - before.slope) / (last.at - before.at),
            _ => self.hint.map_or(0.0, |hint| hint.curvature),
        }
    }
}
