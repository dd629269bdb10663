//! A sum of densities.

use super::density::{Density, Form};
use crate::geom::{Aabb, Point};

/// A sum of densities. Each part is integrated on its own; its kinks are those of the parts.
#[derive(Debug)]
pub struct Sum(pub Vec<Box<dyn Density>>);

impl Density for Sum {
    fn at(&self, point: &Point) -> f64 {
        self.0.iter().map(|part| part.at(point)).sum()
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        let bounds = self.0.iter().map(|part| part.bounds(region));
        bounds.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
    }

    fn form(&self) -> Form<'_> {
        Form::Sum(&self.0)
    }
}
