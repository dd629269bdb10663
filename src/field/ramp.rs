//! A density that rises between two planes and is constant beyond: the paper's ramp (Fig. 4).

use std::fmt;

use super::density::{Density, Form};
use crate::geom::{Aabb, Plane, Point, Vector};

/// A density that is linear between two parallel planes and constant beyond. They are its kinks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    direction: Vector,
    ends_mm: [f64; 2],
    densities: [f64; 2],
}

impl Ramp {
    /// Returns the ramp along `direction`, of any length but zero. It has the first density where
    /// n·x is below the first of `ends_mm`, and the second above the second.
    ///
    /// `None` unless the first end is below the second and all numbers are finite.
    pub fn new(direction: &Vector, ends_mm: [f64; 2], densities: [f64; 2]) -> Option<Self> {
        let direction = direction.try_normalize(f64::MIN_POSITIVE)?;
        let numbers = ends_mm.iter().chain(&densities).chain(direction.iter());
        let is_finite = numbers.into_iter().all(|number| number.is_finite());
        (is_finite && ends_mm[0] < ends_mm[1]).then_some(Self {
            direction,
            ends_mm,
            densities,
        })
    }

    /// Returns the direction in which it goes from its first density to the second; of length 1.
    pub fn direction(&self) -> Vector {
        self.direction
    }

    /// Returns the places along the direction between which it is linear, mm.
    pub fn ends_mm(&self) -> [f64; 2] {
        self.ends_mm
    }

    /// Returns the densities below the first place and above the second.
    pub fn densities(&self) -> [f64; 2] {
        self.densities
    }

    fn at_height(&self, height_mm: f64) -> f64 {
        let [low, high] = self.ends_mm;
        let [below, above] = self.densities;
        let share = ((height_mm - low) / (high - low)).clamp(0.0, 1.0);
        below + (above - below) * share
    }
}

/// Prints as it is typed, to a nanometre.
impl fmt::Display for Ramp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z]: [f64; 3] = self.direction.into();
        let [from, to] = self.ends_mm;
        write!(f, "ramp:{x:.9},{y:.9},{z:.9}@{from:.6}mm..{to:.6}mm")?;
        write!(f, ":{:.6}..{:.6}", self.densities[0], self.densities[1])
    }
}

impl Density for Ramp {
    fn at(&self, point: &Point) -> f64 {
        self.at_height(self.direction.dot(&point.coords))
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        let middle = self.direction.dot(&region.center().coords);
        let reach = 0.5 * self.direction.abs().dot(&region.size());
        let ends = [middle - reach, middle + reach].map(|height| self.at_height(height));
        [f64::min(ends[0], ends[1]), f64::max(ends[0], ends[1])]
    }

    fn form(&self) -> Form<'_> {
        let plane = |offset_mm| Plane {
            normal: self.direction,
            offset_mm,
        };
        Form::Piecewise {
            kinks: self.ends_mm.map(plane).to_vec(),
            degree: 1,
        }
    }
}
