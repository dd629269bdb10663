//! A density that is linear in place.

use super::density::{Density, Form};
use crate::geom::{Aabb, Point, Vector};

/// A density that is linear in place. It has no kinks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear {
    /// Value at the model's origin.
    pub at_origin: f64,
    /// Change along each axis, 1/mm.
    pub gradient: Vector,
}

impl Density for Linear {
    fn at(&self, point: &Point) -> f64 {
        self.at_origin + self.gradient.dot(&point.coords)
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        let middle = self.at(&region.center());
        let reach = 0.5 * self.gradient.abs().dot(&region.size());
        [middle - reach, middle + reach]
    }

    fn form(&self) -> Form<'_> {
        Form::Piecewise {
            kinks: Vec::new(),
            degree: 1,
        }
    }
}
