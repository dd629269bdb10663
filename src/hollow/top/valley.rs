//! Minimisation of a smooth function of one number whose slope comes free with its value.

use crate::hollow::dual::ascent::Climb;
use crate::hollow::dual::programme::DualPoint;
use crate::hollow::solution::{Tangent, Warm};

/// Round limit of a descent; the secant needs about six.
const ROUNDS: usize = 16;
/// Promised gain, as a part of the value, at which a descent ends; the value is then exact to twice
/// it.
const PROMISE_RATIO: f64 = 1e-8;
/// Least magnitude of a value in relative tolerances; otherwise a value near zero would ask for
/// impossible accuracy.
const LEAST_VALUE: f64 = 1e-3;
/// Longest step from a hint, as a part of its place. On finer or corrected columns the bottom
/// hardly moves.
const HINT_RANGE_RATIO: f64 = 0.05;
/// Width of a bracket, as a part of its place, that cannot usefully be split.
const NARROW_RATIO: f64 = 1e-12;
/// Tolerance of the first sample, and of the others as a part of their relative distance from the
/// one before. Ten times more misleads the secant. Ten times less costs one more pass per sample.
const FIRST_TOLERANCE: f64 = 1e-2;
const TOLERANCE_RATIO: f64 = 0.03;
/// Ratio of a slope to its uncertainty from which its sign is trusted.
const TRUSTED_RATIO: f64 = 10.0;

/// The function at one place.
#[derive(Debug, Clone)]
pub(crate) struct Sample {
    pub at: f64,
    pub value: f64,
    pub slope: f64,
    /// Upper bound on the growth of the slope; zero if none is known.
    pub bend: f64,
    /// Ascent that gave the sample.
    pub climb: Climb,
    /// Best lever, if the function was minimised over that too.
    pub lever: Option<Tangent>,
}

/// The dual point, and the best lever if it is known, at which a sample's ascent starts.
#[derive(Clone, Copy)]
pub(crate) struct Start<'a> {
    pub point: &'a DualPoint,
    pub lever: Option<Tangent>,
}

impl Sample {
    /// Returns the start for a nearby sample.
    pub fn start(&self) -> Start<'_> {
        Start {
            point: &self.climb.best.point,
            lever: self.lever,
        }
    }
}

/// A place to sample, the tolerance, and the sample before.
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
    /// Derivative of the slope at the bottom.
    pub curvature: f64,
}

impl Bottom {
    /// Returns the start of a later search of a similar function.
    pub fn tangent(&self) -> Tangent {
        Tangent {
            at: self.sample.at,
            curvature: self.curvature,
        }
    }

    /// Returns the start of a later search, with the dual point.
    pub fn warm(&self) -> Warm {
        let Sample { climb, lever, .. } = &self.sample;
        Warm {
            point: climb.best.point.clone(),
            height: Some(self.tangent()),
            lever: *lever,
            kept: None,
        }
    }

    /// Returns true if a slope of this curvature promises no gain worth a step, for a value like
    /// this one's.
    pub fn is_level(&self, slope: f64, curvature: f64) -> bool {
        0.5 * slope * slope <= PROMISE_RATIO * curvature * self.sample.value.abs().max(LEAST_VALUE)
    }
}

/// A search for the place where the slope turns from falling to rising.
#[derive(Debug, Clone)]
pub(crate) struct Valley {
    /// Bracket of the bottom, from the slopes that are trusted.
    low: f64,
    high: f64,
    /// Longest step allowed.
    longest_step: f64,
    /// First place, and the growth of the slope there if it is known from a similar function.
    start: Tangent,
    /// Promised gain, as a part of the value, at which the search ends.
    promise_ratio: f64,
    /// The last two samples, which define the secant.
    before: Option<Sample>,
    last: Option<Sample>,
}

impl Valley {
    /// Starts a search at a place in a range, with no other knowledge.
    pub fn from(place: f64, [low, high]: [f64; 2]) -> Self {
        Self::from_tangent(
            Tangent {
                at: place,
                curvature: 0.0,
            },
            [low, high],
        )
    }

    /// Starts a search at the bottom of a similar function.
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

    /// Limits the steps to this part of the first place.
    pub fn in_steps_of(self, part: f64) -> Self {
        Self {
            longest_step: part * self.start.at,
            ..self
        }
    }

    /// Loosens the end of the search for samples of this tolerance: the bottom need not be more
    /// exact than they are.
    pub fn within(self, tolerance: f64) -> Self {
        Self {
            promise_ratio: PROMISE_RATIO.max(tolerance * tolerance),
            ..self
        }
    }

    /// Starts a search near the bottom of a similar function.
    pub fn near(hint: Tangent) -> Self {
        Self::from_tangent(hint, [0.0, 2.0 * hint.at]).in_steps_of(HINT_RANGE_RATIO)
    }

    /// Finds the bottom by a secant on the slope, safeguarded by a bracket. `None` if a place
    /// cannot be sampled.
    ///
    /// The nearer a sample is to the bottom, the more exact it is.
    pub fn find_bottom(
        mut self,
        mut sample_at: impl FnMut(Place) -> Option<Sample>,
    ) -> Option<Bottom> {
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

    /// Returns the zero of the line through the last two slopes if it lies downhill. It is limited
    /// to the longest step, and replaced by the middle of the rest of the bracket if it leaves
    /// that.
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

    /// Returns the tolerance for a sample; zero (full accuracy) for the last one.
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

    /// Returns true if the next place promises no gain worth a step.
    fn is_bottom(&self, next: f64) -> bool {
        let Some(last) = &self.last else { return false };
        let promise = 0.5 * (last.slope * (next - last.at)).abs();
        promise <= self.promise_ratio * last.value.abs().max(LEAST_VALUE)
            || self.high - self.low <= NARROW_RATIO * (self.low.abs() + self.high.abs())
    }

    /// Returns the growth of the slope between the last two samples if it is positive, else the
    /// best known value.
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
