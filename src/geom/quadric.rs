//! A quadric, given by its ten coefficients over the monomials of the moments.

use super::{Point, Vector};

/// The function q(x) = g · (1, x, y, z, xy, yz, xz, x², y², z²).
///
/// The optimal void is where q > 0: the reachable set of moments is convex, and its corners are
/// quadrics ([`crate::guide::theory`]).
///
/// Coordinates are those of the goal frame, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadric(pub [f64; 10]);

impl Quadric {
    /// Returns the value at a point of the goal frame.
    pub fn value(&self, p: &Point) -> f64 {
        let [c, x, y, z, xy, yz, xz, xx, yy, zz] = self.0;
        c + p.x * (x + xx * p.x + xy * p.y + xz * p.z)
            + p.y * (y + yy * p.y + yz * p.z)
            + p.z * (z + zz * p.z)
    }

    /// Returns the gradient at a point of the goal frame.
    pub fn gradient(&self, p: &Point) -> Vector {
        let [_, x, y, z, xy, yz, xz, xx, yy, zz] = self.0;
        Vector::new(
            x + 2.0 * xx * p.x + xy * p.y + xz * p.z,
            y + 2.0 * yy * p.y + xy * p.x + yz * p.z,
            z + 2.0 * zz * p.z + xz * p.x + yz * p.y,
        )
    }
}
