//! A density that is a wave of the distance to a point: the paper's radial sine (eq. 5).

use std::f64::consts::TAU;
use std::fmt;

use super::density::{AlongRays, Density, Form};
use crate::geom::{Aabb, Point, Vector};

/// Phase below which integrals are summed as series: above, the closed forms lose fewer digits.
const SERIES_BELOW: f64 = 2.0;
/// Terms of the series: the next one is below 1e-17 at the phase above.
const TERMS: usize = 12;

/// low + (high − low)(1 + sin(2π|x − center|/wave))/2.
///
/// Its kink is the centre. Integrals along rays from there are in closed form, so that only
/// directions are left to quadrature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sine {
    center: Point,
    wave_mm: f64,
    densities: [f64; 2],
}

impl Sine {
    /// Returns the wave; `None` unless its length is positive and all numbers are finite.
    pub fn new(center: Point, wave_mm: f64, densities: [f64; 2]) -> Option<Self> {
        let numbers = center.coords.iter().chain(&densities);
        let is_finite = numbers.into_iter().all(|number| number.is_finite());
        (is_finite && wave_mm.is_finite() && wave_mm > 0.0).then_some(Self {
            center,
            wave_mm,
            densities,
        })
    }

    /// Returns the centre, mm.
    pub fn center(&self) -> Point {
        self.center
    }

    /// Returns the length of the wave, mm.
    pub fn wave_mm(&self) -> f64 {
        self.wave_mm
    }

    /// Returns the least and the greatest density.
    pub fn densities(&self) -> [f64; 2] {
        self.densities
    }

    /// Returns the mean density and half the difference of the two.
    fn mean_and_swing(&self) -> [f64; 2] {
        let [low, high] = self.densities;
        [0.5 * (low + high), 0.5 * (high - low)]
    }
}

/// Prints as it is typed, to a nanometre.
impl fmt::Display for Sine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z]: [f64; 3] = self.center.into();
        let [low, high] = self.densities;
        write!(f, "sine:{x:.6},{y:.6},{z:.6}@{:.6}mm", self.wave_mm)?;
        write!(f, ":{low:.6}..{high:.6}")
    }
}

impl Density for Sine {
    fn at(&self, point: &Point) -> f64 {
        let [mean, swing] = self.mean_and_swing();
        mean + swing * (TAU / self.wave_mm * (point - self.center).norm()).sin()
    }

    fn bounds(&self, _: &Aabb) -> [f64; 2] {
        let [one, other] = self.densities;
        [f64::min(one, other), f64::max(one, other)]
    }

    fn form(&self) -> Form<'_> {
        Form::Rays {
            apex: Some(self.center),
            rays: self,
        }
    }
}

impl AlongRays for Sine {
    fn integrals(&self, _: &Point, ray: &Vector) -> [f64; 3] {
        let [mean, swing] = self.mean_and_swing();
        let waves = powers_times_sine(TAU / self.wave_mm * ray.norm());
        [0, 1, 2].map(|j| mean / (3 + j) as f64 + swing * waves[j])
    }
}

/// Returns ∫₀¹ tⁿ sin(zt) dt for n = 2, 3, 4 and z ≥ 0. Right to about 1e-15.
///
/// By parts: Sₙ = (n Cₙ₋₁ − cos z)/z and Cₙ = (sin z − n Sₙ₋₁)/z.
fn powers_times_sine(z: f64) -> [f64; 3] {
    if z < SERIES_BELOW {
        return [2.0, 3.0, 4.0].map(|power| series(power, z));
    }
    let (sin, cos) = z.sin_cos();
    let by_cosine = |n: f64, before: f64| (n * before - cos) / z;
    let by_sine = |n: f64, before: f64| (sin - n * before) / z;
    let (s0, c0) = ((1.0 - cos) / z, sin / z);
    let (s1, c1) = (by_cosine(1.0, c0), by_sine(1.0, s0));
    let (s2, c2) = (by_cosine(2.0, c1), by_sine(2.0, s1));
    let (s3, c3) = (by_cosine(3.0, c2), by_sine(3.0, s2));
    [s2, s3, by_cosine(4.0, c3)]
}

/// Returns Σ (−1)ᵐ z²ᵐ⁺¹ / ((2m + 1)! (2m + 2 + power)).
fn series(power: f64, z: f64) -> f64 {
    let (mut sum, mut term) = (0.0, z);
    for m in 0..TERMS {
        let twice = 2.0 * m as f64;
        sum += term / (twice + 2.0 + power);
        term *= -z * z / ((twice + 2.0) * (twice + 3.0));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::gauss_jacobi;

    #[test]
    fn the_closed_forms_agree_with_gauss() {
        let rule = gauss_jacobi(24, 0);
        for z in [0.0, 1e-9, 0.3, 1.9, 1.999_999, 2.0, 2.1, 7.0, 20.0] {
            for (got, power) in powers_times_sine(z).into_iter().zip([2, 3, 4]) {
                let want: f64 = rule
                    .iter()
                    .map(|[t, w]| w * t.powi(power) * (z * t).sin())
                    .sum();
                assert!((got - want).abs() < 2e-14, "{z} {power}: {got} {want}");
            }
        }
    }
}
