//! A quadric, given by its ten coefficients over the monomials of the moments.

use super::{Frame, Matrix, Point, Vector};

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

    /// Returns the same function over the coordinates of `frame`; this one is over the model's.
    #[must_use]
    pub fn in_frame(&self, frame: &Frame) -> Self {
        let [_, _, _, _, xy, yz, xz, xx, yy, zz] = self.0;
        let (xy, yz, xz) = (0.5 * xy, 0.5 * yz, 0.5 * xz);
        let curved = Matrix::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let curved = frame.axes.tr_mul(&curved) * frame.axes;
        let slope = frame.axes.tr_mul(&self.gradient(&frame.origin));
        let constant = self.value(&frame.origin);
        let c = |i: usize, j: usize| curved[(i, j)] + if i == j { 0.0 } else { curved[(j, i)] };
        let linear = [constant, slope.x, slope.y, slope.z];
        let [a, b, c] = [[c(0, 1), c(0, 0)], [c(1, 2), c(1, 1)], [c(0, 2), c(2, 2)]];
        let [one, x, y, z] = linear;
        Self([one, x, y, z, a[0], b[0], c[0], a[1], b[1], c[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadric_has_the_same_values_in_every_frame() {
        let quadric = Quadric([1.0, -0.5, 0.3, 2.0, 0.7, -0.2, 0.4, 0.1, 0.9, -0.6]);
        let frame = Frame::with_axis(Point::new(1.0, 2.0, -3.0), &Vector::new(0.3, -1.0, 0.5));
        let turned = quadric.in_frame(&frame);
        for local in [[0.0, 0.0, 0.0], [1.0, -2.0, 3.0], [0.5, 4.0, -1.0]].map(Point::from) {
            let want = quadric.value(&frame.to_model(&local));
            assert!((turned.value(&local) - want).abs() < 1e-12);
        }
    }
}
