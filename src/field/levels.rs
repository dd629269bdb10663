//! A density that is constant between the nested level sets of a quadric: what a printer prints.

use super::density::{AlongRays, Density, Form, powers_between, stretches};
use crate::geom::{Aabb, Point, Quadric, Vector};

/// Most levels: slicers take a modifier for each.
const MAX_LEVELS: usize = 12;

/// A density that is constant between nested level sets. They are its kinks.
#[derive(Debug, Clone, PartialEq)]
pub struct Levels {
    quadric: Quadric,
    cuts: Vec<f64>,
    densities: Vec<f64>,
}

/// A reason why there are no such levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LevelsError {
    /// The numbers of cuts and densities do not fit.
    #[error(
        "{densities} densities with {cuts} cuts between them; \
         remedy: give one cut fewer than densities, and at most {MAX_LEVELS} densities"
    )]
    Count {
        /// Cuts.
        cuts: usize,
        /// Densities.
        densities: usize,
    },
    /// The cuts do not ascend.
    #[error("the cuts do not ascend; remedy: sort them")]
    Order,
    /// A number is not finite.
    #[error("a number is not finite; remedy: give plain numbers")]
    Number,
}

impl Levels {
    /// Returns the density that is `densities[i]` where `quadric` passes exactly i of the `cuts`.
    ///
    /// # Errors
    /// The counts do not fit, the cuts do not ascend or a number is not finite.
    pub fn new(quadric: Quadric, cuts: Vec<f64>, densities: Vec<f64>) -> Result<Self, LevelsError> {
        if densities.len() != cuts.len() + 1 || densities.len() > MAX_LEVELS {
            return Err(LevelsError::Count {
                cuts: cuts.len(),
                densities: densities.len(),
            });
        }
        let numbers = quadric.0.iter().chain(&cuts).chain(&densities);
        if numbers.into_iter().any(|number| !number.is_finite()) {
            return Err(LevelsError::Number);
        }
        if cuts.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(LevelsError::Order);
        }
        Ok(Self {
            quadric,
            cuts,
            densities,
        })
    }

    fn of_value(&self, value: f64) -> f64 {
        let passed = self.cuts.iter().filter(|cut| value > **cut).count();
        self.densities[passed]
    }
}

impl Density for Levels {
    fn at(&self, point: &Point) -> f64 {
        self.of_value(self.quadric.value(point))
    }

    fn bounds(&self, _: &Aabb) -> [f64; 2] {
        let all = self.densities.iter().copied();
        [
            all.clone().fold(f64::INFINITY, f64::min),
            all.fold(f64::NEG_INFINITY, f64::max),
        ]
    }

    fn form(&self) -> Form<'_> {
        Form::Rays {
            apex: None,
            rays: self,
        }
    }
}

impl AlongRays for Levels {
    fn integrals(&self, apex: &Point, ray: &Vector) -> [f64; 3] {
        let along = on_ray(&self.quadric, apex, ray);
        let places = stretches(along, self.cuts.iter().copied());
        let mut sum = [0.0; 3];
        for pair in places.windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]);
            let value = along[0] + middle * (along[1] + middle * along[2]);
            let powers = powers_between([pair[0], pair[1]]);
            let density = self.of_value(value);
            sum = [0, 1, 2].map(|j| sum[j] + density * powers[j]);
        }
        sum
    }
}

/// Returns q(apex + t ray) by powers of t.
pub(super) fn on_ray(quadric: &Quadric, apex: &Point, ray: &Vector) -> [f64; 3] {
    let [_, _, _, _, xy, yz, xz, xx, yy, zz] = quadric.0;
    let curvature = xx * ray.x * ray.x
        + yy * ray.y * ray.y
        + zz * ray.z * ray.z
        + xy * ray.x * ray.y
        + yz * ray.y * ray.z
        + xz * ray.x * ray.z;
    [
        quadric.value(apex),
        quadric.gradient(apex).dot(ray),
        curvature,
    ]
}
