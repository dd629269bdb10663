//! The least of a smooth function of one number whose slope comes free with its value.

use super::ascent::Climb;

/// Rounds of a descent; the secant needs about six.
const ROUNDS: usize = 16;
/// A descent ends when the next step promises less than this part of the value: the value is then exact to twice it.
const PROMISE_RATIO: f64 = 1e-10;
/// Values below this count as this large, lest a value near zero ask for impossible precision.
const LEAST_VALUE: f64 = 1e-3;
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

/// The lowest point of a valley.
#[derive(Debug, Clone)]
pub(super) struct Bottom {
    pub sample: Sample,
    /// The derivative of the slope there.
    pub curvature: f64,
}

/// A stretch in which the slope turns from falling to rising.
#[derive(Debug, Clone)]
pub(super) struct Valley {
    low: f64,
    high: f64,
    /// What is known inside or at the ends, the two to draw the first secant through last.
    known: Vec<Sample>,
}

impl Valley {
    /// The whole range, nothing known.
    pub fn unknown(low: f64, high: f64) -> Self {
        Self { low, high, known: Vec::new() }
    }

    /// Every stretch of the range in which samples, ascending, show a fall and then a rise; the ends of the range
    /// count as walls.
    pub fn all_between(low: f64, high: f64, samples: &[Sample]) -> Vec<Self> {
        let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
            return vec![Self::unknown(low, high)];
        };
        let mut valleys = Vec::new();
        if first.slope >= 0.0 {
            valleys.push(Self { low, high: first.at, known: vec![first.clone()] });
        }
        for pair in samples.windows(2).filter(|pair| pair[0].slope < 0.0 && pair[1].slope >= 0.0) {
            valleys.push(Self { low: pair[0].at, high: pair[1].at, known: pair.to_vec() });
        }
        if last.slope < 0.0 {
            valleys.push(Self { low: last.at, high, known: vec![last.clone()] });
        }
        valleys
    }

    /// The bottom, by a secant on the slope that the bracket keeps from straying; none where no place can be sampled.
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
        let best = self.known.into_iter().min_by(|a, b| a.value.total_cmp(&b.value));
        best.map(|sample| Bottom { sample, curvature })
    }

    /// Where the line through the last two slopes vanishes; the middle where it strays from the bracket.
    fn next_place(&self) -> f64 {
        let middle = 0.5 * (self.low + self.high);
        let [.., before, last] = &self.known[..] else { return middle };
        let place = last.at - last.slope * (last.at - before.at) / (last.slope - before.slope);
        if self.low < place && place < self.high { place } else { middle }
    }

    fn is_at_bottom(&self, next: f64) -> bool {
        let Some(last) = self.known.last() else { return false };
        let promise = 0.5 * (last.slope * (next - last.at)).abs();
        promise <= PROMISE_RATIO * last.value.abs().max(LEAST_VALUE)
            || self.high - self.low <= NARROW_RATIO * (self.low.abs() + self.high.abs())
    }

    fn curvature(&self) -> f64 {
        match &self.known[..] {
            [.., before, last] if last.at != before.at => (last.slope - before.slope) / (last.at - before.at),
            _ => 0.0,
        }
    }
}
