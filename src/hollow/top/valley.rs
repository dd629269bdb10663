//! The least of a smooth function of one number whose slope comes free with its value.

use crate::hollow::dual::ascent::Climb;
use crate::hollow::dual::programme::DualPoint;
use crate::hollow::solution::{Tangent, Warm};

/// Rounds of a descent; the secant needs about six.
const ROUNDS: usize = 16;
/// A descent ends when the next step promises less than this part of the value, which is then exact
/// to twice it.
const PROMISE_RATIO: f64 = 1e-8;
/// Values below this count as this large, lest a value near zero ask for impossible precision.
const LEAST_VALUE: f64 = 1e-3;
/// The longest step from a hint, as a part of its place: on finer or corrected columns the bottom
/// hardly moves.
const HINT_RANGE_RATIO: f64 = 0.05;
/// A bracket narrower than this part of its place cannot be split usefully.
const NARROW_RATIO: f64 = 1e-12;
/// How exact the first sample is, and the others as a part of how far they are from the one before,
/// relative to their place. Ten times more, and the secant is led astray; ten times less costs a
/// pass a sample.
const FIRST_TOLERANCE: f64 = 1e-2;
const TOLERANCE_RATIO: f64 = 0.03;
/// A slope is trusted to tell where the bottom lies when it is this many times what the tolerance
/// may make of it.
const TRUSTED_RATIO: f64 = 10.0;

/// The function at one place.
#[derive(Debug, Clone)]
pub(crate) struct Sample {
    pub at: f64,
    pub value: f64,
    pub slope: f64,
    /// What the slope grows at most, by a bound; zero where none is known.
    pub bend: f64,
    /// The ascent that gave it.
    pub climb: Climb,
    /// The lever the function was least at, where it was minimised over that too.
    pub lever: Option<Tangent>,
}

/// The dual point, and the best lever if that is known, that a sample starts from.
#[derive(Clone, Copy)]
pub(crate) struct Start<'a> {
    pub point: &'a DualPoint,
    pub lever: Option<Tangent>,
}

impl Sample {
    /// What a sample near this one starts from.
    pub fn start(&self) -> Start<'_> {
        Start {
            point: &self.climb.best.point,
            lever: self.lever,
        }
    }
}

/// Where the function is to be sampled, how exactly, and the sample before.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place<'a> {
    pub at: f64,
    pub tolerance: f64,
    pub near: Option<&'a Sample>,
}

/// The lowest point of a valley.
#[derive(Debug, Clone)]
pub(crate) struct Bottom {
    pub sample: Sample,
    /// The derivative of the slope there.
    pub curvature: f64,
}

impl Bottom {
    /// What a later search of a similar function starts from.
    pub fn tangent(&self) -> Tangent {
        Tangent {
            at: self.sample.at,
            curvature: self.curvature,
        }
    }

    /// The same with the dual point.
    pub fn warm(&self) -> Warm {
        let Sample { climb, lever, .. } = &self.sample;
        Warm {
            point: climb.best.point.clone(),
            height: Some(self.tangent()),
            lever: *lever,
        }
    }

    /// Whether a slope of this curvature promises nothing worth the while, of a value as large as
    /// this one's.
    pub fn is_level(&self, slope: f64, curvature: f64) -> bool {
        0.5 * slope * slope <= PROMISE_RATIO * curvature * self.sample.value.abs().max(LEAST_VALUE)
    }
}

/// A search for the place where the slope turns from falling to rising.
#[derive(Debug, Clone)]
pub(crate) struct Valley {
    /// The bottom lies between these, as far as trusted samples tell.
    low: f64,
    high: f64,
    /// No step is longer.
    longest_step: f64,
    /// Where it begins, and the growth of the slope there, where that is known of a similar
    /// function.
    start: Tangent,
    /// It ends when the next step promises less than this part of the value.
    promise_ratio: f64,
    /// The last two samples; the secant goes through them.
    before: Option<Sample>,
    last: Option<Sample>,
}

impl Valley {
    /// A search from a place in a range of which nothing else is known.
    pub fn from(place: f64, [low, high]: [f64; 2]) -> Self {
        Self::from_tangent(
            Tangent {
                at: place,
                curvature: 0.0,
            },
            [low, high],
        )
    }

    /// The same from where the bottom of a similar function was.
    pub fn from_tangent(hint: Tangent, [low, high]: [f64; 2]) -> Self {
        let start = Tangent {
            at: hint.at.max(low).min(high),
            ..hint
        };
        let promise_ratio = PROMISE_RATIO;
        Self {
            low,
            high,
            longest_step: high - low,
            start,
            promise_ratio,
            before: None,
            last: None,
        }
    }

    /// The same with steps of no more than this part of the place it begins at.
    pub fn in_steps_of(self, part: f64) -> Self {
        Self {
            longest_step: part * self.start.at,
            ..self
        }
    }

    /// The same for samples of this tolerance: the bottom need not be known better than they are.
    pub fn within(self, tolerance: f64) -> Self {
        Self {
            promise_ratio: PROMISE_RATIO.max(tolerance * tolerance),
            ..self
        }
    }

    /// A search near the bottom of a similar function.
    pub fn near(hint: Tangent) -> Self {
        Self::from_tangent(hint, [0.0, 2.0 * hint.at]).in_steps_of(HINT_RANGE_RATIO)
    }

    /// The bottom, by a secant on the slope that the samples keep from straying; none where a place
    /// cannot be sampled. Samples are the more exact the nearer they are to it.
    pub fn bottom(mut self, mut sample_at: impl FnMut(Place) -> Option<Sample>) -> Option<Bottom> {
        for _ in 0..ROUNDS {
            let at = self.next_place();
            let tolerance = self.tolerance_at(at);
            let sample = sample_at(Place {
                at,
                tolerance,
                near: self.last.as_ref(),
            })?;
            self.narrow(&sample, tolerance);
            self.before = self.last.replace(sample);
            if tolerance == 0.0 && self.is_bottom(self.next_place()) {
                break;
            }
        }
        let curvature = self.curvature();
        self.last.map(|sample| Bottom { sample, curvature })
    }

    /// Where the line through the last two slopes vanishes, if that is downhill; never further than
    /// the longest step, nor more than half way to an end of what is left.
    fn next_place(&self) -> f64 {
        let Some(last) = &self.last else {
            return self.start.at;
        };
        let curvature = self.curvature();
        let longest = self.longest_step.copysign(-last.slope);
        let newton = if curvature > 0.0 {
            -last.slope / curvature
        } else {
            longest
        };
        let place = last.at
            + if newton.abs() < longest.abs() {
                newton
            } else {
                longest
            };
        let end = if last.slope < 0.0 {
            self.high
        } else {
            self.low
        };
        if self.low < place && place < self.high {
            place
        } else {
            0.5 * (last.at + end)
        }
    }

    /// How exact a sample has to be: fully where it is the last.
    fn tolerance_at(&self, place: f64) -> f64 {
        match &self.last {
            None if self.start.curvature > 0.0 => 0.0,
            None => FIRST_TOLERANCE,
            Some(_) if self.is_bottom(place) => 0.0,
            Some(last) => FIRST_TOLERANCE.min(TOLERANCE_RATIO * ((place - last.at) / place).abs()),
        }
    }

    fn narrow(&mut self, sample: &Sample, tolerance: f64) {
        let uncertain = TRUSTED_RATIO * tolerance * sample.at * sample.bend;
        if sample.slope < -uncertain {
            self.low = sample.at;
        } else if sample.slope > uncertain {
            self.high = sample.at;
        }
    }

    /// Whether nothing worth the while is to be had by going on to the next place.
    fn is_bottom(&self, next: f64) -> bool {
        let Some(last) = &self.last else { return false };
        let promise = 0.5 * (last.slope * (next - last.at)).abs();
        promise <= self.promise_ratio * last.value.abs().max(LEAST_VALUE)
            || self.high - self.low <= NARROW_RATIO * (self.low.abs() + self.high.abs())
    }

    /// The growth of the slope between the last two samples, where there are two and it is one;
    /// else what is known of it.
    fn curvature(&self) -> f64 {
        let Some(last) = &self.last else {
            return self.start.curvature;
        };
        let known = if self.start.curvature > 0.0 {
            self.start.curvature
        } else {
            last.bend
        };
        let Some(before) = self.before.as_ref().filter(|before| before.at != last.at) else {
            return known;
        };
        let secant = (last.slope - before.slope) / (last.at - before.at);
        if secant > 0.0 || last.bend == 0.0 {
            secant
        } else {
            last.bend
        }
    }
}
