//! A density that is a polynomial in place.

use serde::Deserialize;

use super::density::{Density, Form};
use crate::geom::{Aabb, Point};

/// Greatest degree: quadrature of a higher one would lose its digits in mm.
const MAX_DEGREE: usize = 8;
/// Most terms of a polynomial: those of the greatest degree.
const MAX_TERMS: usize = 165;

/// A term: a coefficient times powers of the coordinates in mm.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Term {
    /// The coefficient, 1/mm^degree.
    pub coefficient: f64,
    /// The power of x.
    #[serde(default)]
    pub x: u8,
    /// The power of y.
    #[serde(default)]
    pub y: u8,
    /// The power of z.
    #[serde(default)]
    pub z: u8,
}

/// A density that is a polynomial in place. It has no kinks.
#[derive(Debug, Clone, PartialEq)]
pub struct Polynomial(Vec<Term>);

/// A reason why terms make no polynomial density.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PolynomialError {
    /// A coefficient is not a number.
    #[error("a coefficient is not a finite number; remedy: give a number such as 0.01")]
    Coefficient,
    /// The degree is too high.
    #[error("a term has degree {0}; remedy: use degrees up to {MAX_DEGREE}")]
    Degree(usize),
    /// There are too many terms, or none.
    #[error("the polynomial has {0} terms; remedy: give 1 to {MAX_TERMS}")]
    Terms(usize),
}

impl Term {
    fn degree(&self) -> usize {
        usize::from(self.x) + usize::from(self.y) + usize::from(self.z)
    }

    fn at(&self, p: &Point) -> f64 {
        let power = |base: f64, power: u8| base.powi(i32::from(power));
        self.coefficient * power(p.x, self.x) * power(p.y, self.y) * power(p.z, self.z)
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        let powers = [self.x, self.y, self.z];
        let factors = [0, 1, 2].map(|i| power_bounds(region.min[i], region.max[i], powers[i]));
        let start = [self.coefficient; 2];
        factors.into_iter().fold(start, times)
    }
}

impl Polynomial {
    /// Returns the sum of the terms.
    ///
    /// # Errors
    /// There are too many terms or none, or one is of a degree above 8 or not finite.
    pub fn new(terms: Vec<Term>) -> Result<Self, PolynomialError> {
        if terms.is_empty() || terms.len() > MAX_TERMS {
            return Err(PolynomialError::Terms(terms.len()));
        }
        if let Some(high) = terms.iter().find(|term| term.degree() > MAX_DEGREE) {
            return Err(PolynomialError::Degree(high.degree()));
        }
        if terms.iter().any(|term| !term.coefficient.is_finite()) {
            return Err(PolynomialError::Coefficient);
        }
        Ok(Self(terms))
    }
}

impl Density for Polynomial {
    fn at(&self, point: &Point) -> f64 {
        self.0.iter().map(|term| term.at(point)).sum()
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        let bounds = self.0.iter().map(|term| term.bounds(region));
        bounds.fold([0.0; 2], |sum, term| [sum[0] + term[0], sum[1] + term[1]])
    }

    fn form(&self) -> Form<'_> {
        let degree = self.0.iter().map(Term::degree).max().unwrap_or(0);
        Form::Piecewise {
            kinks: Vec::new(),
            degree,
        }
    }
}

/// Returns the least and greatest power of a coordinate in a range.
fn power_bounds(low: f64, high: f64, power: u8) -> [f64; 2] {
    let ends = [low, high].map(|end| end.powi(i32::from(power)));
    let greatest = f64::max(ends[0], ends[1]);
    let is_even = power > 0 && power.is_multiple_of(2);
    if is_even && low < 0.0 && high > 0.0 {
        [0.0, greatest]
    } else {
        [f64::min(ends[0], ends[1]), greatest]
    }
}

/// Returns the range of products of numbers in two ranges.
pub(super) fn times([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    let products = [a * c, a * d, b * c, b * d];
    let least = products.into_iter().fold(f64::INFINITY, f64::min);
    let greatest = products.into_iter().fold(f64::NEG_INFINITY, f64::max);
    [least, greatest]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    #[test]
    fn bounds_hold_over_a_box() {
        let term = |coefficient, [x, y, z]: [u8; 3]| Term {
            coefficient,
            x,
            y,
            z,
        };
        let terms = vec![
            term(2.0, [2, 0, 1]),
            term(-1.0, [0, 3, 0]),
            term(0.5, [1, 1, 1]),
        ];
        let field = Polynomial::new(terms).unwrap();
        let region = Aabb {
            min: Point::new(-1.0, -2.0, 0.5),
            max: Point::new(2.0, 1.0, 3.0),
        };
        let [low, high] = field.bounds(&region);
        let mut random = Random::new(3);
        for _ in 0..1000 {
            let share = crate::geom::Vector::from_fn(|_, _| random.between(0.0, 1.0));
            let point = region.min + region.size().component_mul(&share);
            assert!((low..=high).contains(&field.at(&point)));
        }
    }

    #[test]
    fn terms_that_are_too_many_too_high_or_no_numbers_are_refused() {
        let term = |coefficient, x| Term {
            coefficient,
            x,
            y: 0,
            z: 0,
        };
        let error = |terms| Polynomial::new(terms).unwrap_err();
        assert_eq!(error(Vec::new()), PolynomialError::Terms(0));
        assert_eq!(error(vec![term(1.0, 9)]), PolynomialError::Degree(9));
        assert_eq!(error(vec![term(f64::NAN, 1)]), PolynomialError::Coefficient);
    }
}
