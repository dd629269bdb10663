//! A right-handed orthonormal frame placed in the model's frame.

use super::{Matrix, Point, Vector, plane::orthonormal_basis};

/// A rigid placement: a local frame's origin and axes in the model frame.
///
/// The goal frame has its origin at the contact point (top), at the spin point (yo-yo) or on the
/// support plane (stand). Its z axis points along the spin axis or up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The local origin, in model coordinates, mm.
    pub origin: Point,
    /// The local axes as columns, in model coordinates; a proper rotation.
    pub axes: Matrix,
}

impl Frame {
    /// Returns the model frame itself.
    pub fn identity() -> Self {
        Self {
            origin: Point::origin(),
            axes: Matrix::identity(),
        }
    }

    /// Makes the frame at `origin` whose z axis is `axis` (any length but zero).
    pub fn with_axis(origin: Point, axis: &Vector) -> Self {
        let z = axis.normalize();
        let (x, y) = orthonormal_basis(&z);
        Self {
            origin,
            axes: Matrix::from_columns(&[x, y, z]),
        }
    }

    /// Returns the z axis in model coordinates, a unit vector.
    pub fn axis(&self) -> Vector {
        self.axes.column(2).into()
    }

    /// Converts a point from this frame to model coordinates.
    pub fn to_model(&self, local: &Point) -> Point {
        self.origin + self.axes * local.coords
    }

    /// Converts a point from model coordinates to this frame.
    pub fn to_local(&self, model: &Point) -> Point {
        Point::from(self.axes.tr_mul(&(model - self.origin)))
    }

    /// Converts a direction from model coordinates to this frame.
    pub fn direction_to_local(&self, model: &Vector) -> Vector {
        self.axes.tr_mul(model)
    }

    /// Converts a direction from this frame to model coordinates.
    pub fn direction_to_model(&self, local: &Vector) -> Vector {
        self.axes * local
    }

    /// Returns a frame given in the coordinates of this one, in model coordinates. Seen as a rigid
    /// motion, that is `local` first and this one after it.
    #[must_use]
    pub fn frame_to_model(&self, local: &Self) -> Self {
        Self {
            origin: self.to_model(&local.origin),
            axes: self.axes * local.axes,
        }
    }

    /// Returns the model frame in the coordinates of this one: the motion back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self {
            origin: self.to_local(&Point::origin()),
            axes: self.axes.transpose(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_and_its_inverse_leave_the_model_frame() {
        let frame = Frame::with_axis(Point::new(1.0, -2.0, 3.0), &Vector::new(2.0, 1.0, -1.0));
        let back = frame.frame_to_model(&frame.inverse());
        assert!(back.origin.coords.norm() < 1e-14);
        assert!((back.axes - Matrix::identity()).norm() < 1e-14);
    }
}
