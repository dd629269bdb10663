//! A quadratic density, clamped to a range: the least change of a uniform one.

use std::fmt;

use super::density::{AlongRays, Density, Form, powers_between, stretches};
use super::levels::on_ray;
use super::range::DensityRange;
use crate::geom::{Aabb, Frame, Point, Quadric, Vector};
use crate::mass::gauss_jacobi;

/// Points of the Gauss rule over a stretch: t⁴ times a quadratic is of degree 6.
const POINTS: usize = 4;

/// clamp(wished − q(x)) to a range. Its kinks are the two quadrics at which the clamp begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Clamped {
    quadric: Quadric,
    wished: f64,
    range: DensityRange,
    rule: Vec<[f64; 2]>,
}

impl Clamped {
    /// Returns the density.
    pub fn new(quadric: Quadric, wished: f64, range: DensityRange) -> Self {
        Self {
            quadric,
            wished,
            range,
            rule: gauss_jacobi(POINTS, 0),
        }
    }

    /// Returns the density in another frame; this one is in the model's.
    #[must_use]
    pub fn in_frame(&self, frame: &Frame) -> Self {
        Self {
            quadric: self.quadric.in_frame(frame),
            ..self.clone()
        }
    }

    fn of_value(&self, value: f64) -> f64 {
        (self.wished - value).clamp(self.range.low(), self.range.high())
    }
}

/// The words that can be typed: `clamped:` with the quadric's ten numbers, the wished density and
/// the range.
impl fmt::Display for Clamped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers = self.quadric.0.map(|number| number.to_string()).join(",");
        let [low, high] = [self.range.low(), self.range.high()];
        write!(f, "clamped:{numbers}@{}:{low}..{high}", self.wished)
    }
}

impl Density for Clamped {
    fn at(&self, point: &Point) -> f64 {
        self.of_value(self.quadric.value(point))
    }

    fn bounds(&self, _: &Aabb) -> [f64; 2] {
        [self.range.low(), self.range.high()]
    }

    fn form(&self) -> Form<'_> {
        Form::Rays {
            apex: None,
            rays: self,
        }
    }
}

impl AlongRays for Clamped {
    fn integrals(&self, apex: &Point, ray: &Vector) -> [f64; 3] {
        let along = on_ray(&self.quadric, apex, ray);
        let value = |t: f64| along[0] + t * (along[1] + t * along[2]);
        let ends = [self.range.high(), self.range.low()].map(|end| self.wished - end);
        let mut sum = [0.0; 3];
        for pair in stretches(along, ends.into_iter()).windows(2) {
            let (from, length) = (pair[0], pair[1] - pair[0]);
            let middle = self.wished - value(from + 0.5 * length);
            if middle <= self.range.low() || middle >= self.range.high() {
                let powers = powers_between([pair[0], pair[1]]);
                let density = middle.clamp(self.range.low(), self.range.high());
                sum = [0, 1, 2].map(|j| sum[j] + density * powers[j]);
                continue;
            }
            for [share, weight] in &self.rule {
                let t = from + length * share;
                let term = weight * length * (self.wished - value(t)) * t * t;
                sum = [sum[0] + term, sum[1] + term * t, sum[2] + term * t * t];
            }
        }
        sum
    }
}
