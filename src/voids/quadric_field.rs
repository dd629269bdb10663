//! A quadric's positive region as a function in model coordinates.

use super::field::{Field, Known, Sample};
use crate::geom::{Bvh, Frame, Matrix, Point, Quadric};

/// Share of itself by which the gradient may change within a cell. At 0.5, two sheets or a small
/// ellipsoid cannot hide between the lattice's corners.
const TURN_RATIO: f64 = 0.5;

/// A quadric as a signed lower bound of the distance to its surface q = 0, positive if q is.
///
/// From the second-order Taylor series, |q(x + v) − q(x)| ≤ |∇q| |v| + ‖H‖ |v|²/2. So no zero is
/// nearer than 2|q| / (|∇q| + √(|∇q|² + 2‖H‖|q|)). Near the surface this is the distance itself,
/// and it is finite at a cone's apex.
pub(super) struct QuadricField<'a> {
    quadric: &'a Quadric,
    frame: &'a Frame,
    /// Spectral norm of the second derivatives.
    curvature: f64,
    /// Body in which the surface must be drawn within tolerance.
    body: &'a Bvh,
    cells: CellSizes,
}

/// Largest cells of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CellSizes {
    /// Largest cell that may hold the surface, mm.
    pub coarse_mm: f64,
    /// Largest cell in which the surface may turn much, mm.
    pub singular_mm: f64,
}

impl<'a> QuadricField<'a> {
    /// Returns the function of a quadric given in `frame`, to be drawn in `body`.
    pub fn new(quadric: &'a Quadric, frame: &'a Frame, body: &'a Bvh, cells: CellSizes) -> Self {
        let curvature = hessian(quadric).symmetric_eigenvalues().amax();
        Self {
            quadric,
            frame,
            curvature,
            body,
            cells,
        }
    }
}

/// Returns the second derivatives.
fn hessian(&Quadric([_, _, _, _, xy, yz, xz, xx, yy, zz]): &Quadric) -> Matrix {
    Matrix::new(2.0 * xx, xy, xz, xy, 2.0 * yy, yz, xz, yz, 2.0 * zz)
}

impl Field for QuadricField<'_> {
    fn sample(&self, p: &Point, _nearby: &[Known]) -> Sample {
        let local = self.frame.to_local(p);
        let (value, gradient) = (self.quadric.value(&local), self.quadric.gradient(&local));
        let slope = gradient.norm();
        let reach = slope + (slope * slope + 2.0 * self.curvature * value.abs()).sqrt();
        let distance = if value == 0.0 {
            0.0
        } else if reach > 0.0 {
            2.0 * value / reach
        } else {
            f64::INFINITY.copysign(value)
        };
        let direction = if slope > 0.0 {
            gradient / slope
        } else {
            gradient
        };
        Sample::plain(distance, self.frame.direction_to_model(&direction))
    }

    fn is_free(&self, center: &Known, radius_mm: f64) -> bool {
        center.sample.value.abs() > radius_mm
    }

    fn is_too_coarse(&self, center: &Known, size_mm: f64) -> bool {
        let slope = self
            .quadric
            .gradient(&self.frame.to_local(&center.at))
            .norm();
        let turns = self.curvature * size_mm > TURN_RATIO * slope;
        size_mm > self.cells.coarse_mm
            || (turns && size_mm > self.cells.singular_mm && self.matters(&center.at, size_mm))
    }

    fn matters(&self, center: &Point, radius_mm: f64) -> bool {
        self.body.closest(center, radius_mm, &[]).is_some() || self.body.winding(center) > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;

    #[test]
    fn the_value_is_at_most_the_distance_to_a_ball_and_equals_it_near_the_surface() {
        let cells = CellSizes {
            coarse_mm: 1.0,
            singular_mm: 1.0,
        };
        let ball = Quadric([-25.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
        let body = Bvh::new(Vec::new());
        let frame = Frame::with_axis(Point::new(1.0, 2.0, 3.0), &Vector::new(1.0, 1.0, 0.3));
        let field = QuadricField::new(&ball, &frame, &body, cells);
        for i in 0..200 {
            let radius = 0.05 * f64::from(i);
            let value = field
                .sample(&(frame.origin + Vector::new(0.6, 0.0, 0.8) * radius), &[])
                .value;
            assert!(value.abs() <= (radius - 5.0).abs() + 1e-12);
            assert_eq!(value > 0.0, radius > 5.0);
        }
        let near = field.sample(&(frame.origin + Vector::new(0.0, 5.001, 0.0)), &[]);
        // The bound's relative error is about distance over radius.
        assert!((near.value - 0.001).abs() < 1e-6);
        assert!((near.gradient - Vector::y()).norm() < 1e-12);
    }
}
