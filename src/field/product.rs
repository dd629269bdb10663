//! A product of densities.

use super::density::{Density, Form};
use super::polynomial::times;
use crate::geom::{Aabb, Plane, Point};

/// A product of densities. Its kinks are those of the factors.
///
/// If all factors are polynomials between planes, so is the product, and its integral is exact.
#[derive(Debug)]
pub struct Product(pub Vec<Box<dyn Density>>);

impl Density for Product {
    fn at(&self, point: &Point) -> f64 {
        self.0.iter().map(|factor| factor.at(point)).product()
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        let bounds = self.0.iter().map(|factor| factor.bounds(region));
        bounds.fold([1.0; 2], times)
    }

    fn form(&self) -> Form<'_> {
        let (mut kinks, mut degree, mut is_exact) = (Vec::new(), 0, true);
        for factor in &self.0 {
            match planes_and_degree(factor.as_ref()) {
                (planes, Some(of_factor)) => {
                    kinks.extend(planes);
                    degree += of_factor;
                }
                (planes, None) => {
                    kinks.extend(planes);
                    is_exact = false;
                }
            }
        }
        if is_exact {
            Form::Piecewise { kinks, degree }
        } else {
            Form::Any { kinks }
        }
    }
}

/// Returns the planes at which a density has kinks, and its degree between them; `None` if it is no
/// polynomial there.
fn planes_and_degree(density: &dyn Density) -> (Vec<Plane>, Option<usize>) {
    match density.form() {
        Form::Piecewise { kinks, degree } => (kinks, Some(degree)),
        Form::Any { kinks } => (kinks, None),
        Form::Rays { .. } | Form::Depth(_) => (Vec::new(), None),
        Form::Sum(parts) => {
            let (mut kinks, mut degree) = (Vec::new(), Some(0));
            for part in parts {
                let (planes, of_part) = planes_and_degree(part.as_ref());
                kinks.extend(planes);
                degree = degree.zip(of_part).map(|(one, other)| one.max(other));
            }
            (kinks, degree)
        }
    }
}
