//! The view of a density that integration has: its value, its bounds and its kinks.

use std::fmt::Debug;

use crate::geom::{Aabb, Plane, Point, Vector};

/// A relative density given everywhere in space, in the model's coordinates.
pub trait Density: Debug + Send + Sync {
    /// Returns the value at a point; finite for a finite point.
    fn at(&self, point: &Point) -> f64;

    /// Returns a lower and an upper bound over a box. They hold, but need not be reached.
    fn bounds(&self, region: &Aabb) -> [f64; 2];

    /// Returns the form in which it is integrated, with its kinks.
    fn form(&self) -> Form<'_>;
}

/// The form of a density for integration.
#[derive(Debug)]
pub enum Form<'a> {
    /// A polynomial of this degree on every side of the planes, which it may jump at.
    Piecewise {
        /// The planes.
        kinks: Vec<Plane>,
        /// The degree.
        degree: usize,
    },
    /// Integrals along rays are known in closed form.
    Rays {
        /// The point that the rays must start from; `None` if they may start anywhere.
        apex: Option<Point>,
        /// The integrals.
        rays: &'a dyn AlongRays,
    },
    /// The sum of other densities.
    Sum(&'a [Box<dyn Density>]),
    /// A function of the depth below a surface.
    Depth(&'a dyn OfDepth),
    /// Anything else, with the planes at which it has kinks.
    Any {
        /// The planes.
        kinks: Vec<Plane>,
    },
}

/// A density whose integrals along rays are known in closed form.
pub trait AlongRays: Debug + Send + Sync {
    /// Returns ∫₀¹ t²⁺ʲ d(apex + t ray) dt for j = 0, 1, 2.
    fn integrals(&self, apex: &Point, ray: &Vector) -> [f64; 3];
}

/// A density that is a function of the depth below the surface of its solid.
pub trait OfDepth: Debug + Send + Sync {
    /// Returns the depth, mm; negative outside. Its slope is at most 1.
    fn depth_mm(&self, point: &Point) -> f64;

    /// Returns the density at a depth, mm, of at least zero.
    fn of_depth(&self, depth_mm: f64) -> f64;

    /// Returns the depth from which the density is constant, mm; may be infinite.
    fn constant_from_mm(&self) -> f64;
}

/// Returns ∫ t²⁺ʲ dt for j = 0, 1, 2 over a stretch of a ray.
pub(super) fn powers_between([from, to]: [f64; 2]) -> [f64; 3] {
    let power = |t: f64| [t.powi(3) / 3.0, t.powi(4) / 4.0, t.powi(5) / 5.0];
    let (low, high) = (power(from), power(to));
    [0, 1, 2].map(|j| high[j] - low[j])
}

/// Returns the places in (0, 1) where a + bt + ct² has one of the given values, ascending, between
/// 0 and 1 themselves.
pub(super) fn stretches([a, b, c]: [f64; 3], values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut places = vec![0.0, 1.0];
    for value in values {
        let discriminant = b * b - 4.0 * c * (a - value);
        if discriminant > 0.0 {
            let half = -0.5 * (b + discriminant.sqrt().copysign(b));
            places.extend([half / c, (a - value) / half]);
        }
    }
    places.retain(|t| (0.0..=1.0).contains(t));
    places.sort_by(f64::total_cmp);
    places
}
