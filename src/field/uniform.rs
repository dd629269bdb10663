//! The same density everywhere.

use super::density::{Density, Form};
use crate::geom::{Aabb, Point};

/// The same density everywhere. It has no kinks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uniform(pub f64);

impl Density for Uniform {
    fn at(&self, _: &Point) -> f64 {
        self.0
    }

    fn bounds(&self, _: &Aabb) -> [f64; 2] {
        [self.0; 2]
    }

    fn form(&self) -> Form<'_> {
        Form::Piecewise {
            kinks: Vec::new(),
            degree: 0,
        }
    }
}
