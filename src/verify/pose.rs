//! Poses of parts on the printer's plate.

use serde::{Deserialize, Serialize};

use crate::geom::{Matrix, Point, Vector};
use crate::mass::Moments;

/// The homogeneous 4×4 matrix that maps model coordinates to print coordinates of a part, mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Pose {
    /// The rows of the matrix.
    pub rows: [[f64; 4]; 4],
}

impl Pose {
    /// Returns the pose in which print and model coordinates are the same.
    pub fn identity() -> Self {
        Self::new(&Matrix::identity(), &Vector::zeros())
    }

    /// Returns the pose print = rotation · model + translation.
    pub fn new(rotation: &Matrix, translation: &Vector) -> Self {
        let row = |i: usize| {
            [
                rotation[(i, 0)],
                rotation[(i, 1)],
                rotation[(i, 2)],
                translation[i],
            ]
        };
        Self {
            rows: [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]],
        }
    }

    /// Returns the linear part, a proper rotation if the pose is rigid.
    #[inline]
    pub fn rotation(&self) -> Matrix {
        Matrix::from_fn(|row, column| self.rows[row][column])
    }

    /// Returns the translation, mm.
    #[inline]
    pub fn translation(&self) -> Vector {
        Vector::from_fn(|row, _| self.rows[row][3])
    }

    /// Returns the model coordinates of a point in the print frame. Exact only for a rigid pose.
    #[inline]
    pub fn to_model(&self, print: &Point) -> Point {
        Point::from(self.rotation().tr_mul(&(print.coords - self.translation())))
    }

    /// Returns the print coordinates of a point in the model frame.
    #[inline]
    pub fn to_print(&self, model: &Point) -> Point {
        Point::from(self.rotation() * model.coords + self.translation())
    }

    /// Converts the moments of a region from the print frame to the model frame.
    pub fn moments_to_model(&self, print: &Moments) -> Moments {
        print
            .translated(&-self.translation())
            .rotated(&self.rotation().transpose())
    }

    /// Returns the deviation of the matrix from a rigid motion. It is the largest deviation of R·Rᵀ
    /// from 1, of det R from +1 and of the last row from (0, 0, 0, 1). A mirror gives 2.
    pub fn rigidity_error(&self) -> f64 {
        let rotation = self.rotation();
        let orthogonal = (rotation * rotation.transpose() - Matrix::identity()).amax();
        let proper = (rotation.determinant() - 1.0).abs();
        let [x, y, z, w] = self.rows[3];
        [
            orthogonal,
            proper,
            x.abs(),
            y.abs(),
            z.abs(),
            (w - 1.0).abs(),
        ]
        .into_iter()
        .fold(0.0, max_or_nan)
    }
}

/// Returns the larger of two numbers, or NaN if either is NaN, so that a broken matrix cannot pass
/// as rigid.
fn max_or_nan(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    fn oblique_pose() -> Pose {
        let rotation = Rotation3::from_euler_angles(0.3, -1.1, 2.0).into_inner();
        Pose::new(&rotation, &Vector::new(4.0, -7.0, 2.5))
    }

    #[test]
    fn a_point_laid_on_the_plate_comes_back_to_the_model() {
        let point = Point::new(1.0, 2.0, 3.0);
        let back = oblique_pose().to_model(&oblique_pose().to_print(&point));
        // Three products and sums of numbers below 10: a few units in the last place of 10.
        assert!((back - point).norm() < 1e-14);
    }

    #[test]
    fn the_moments_of_a_point_mass_move_with_the_point() {
        let at = |p: &Point| Moments(Moments::monomials(p.x, p.y, p.z));
        let point = Point::new(1.0, 2.0, 3.0);
        let back = oblique_pose().moments_to_model(&at(&oblique_pose().to_print(&point)));
        for (got, want) in back.0.iter().zip(at(&point).0) {
            assert!((got - want).abs() < 1e-12);
        }
    }

    #[test]
    fn a_rotation_is_rigid_and_a_mirror_a_stretch_and_a_hole_are_not() {
        assert!(oblique_pose().rigidity_error() < 1e-15);
        let mirror = Pose::new(
            &Matrix::from_diagonal(&Vector::new(1.0, 1.0, -1.0)),
            &Vector::zeros(),
        );
        assert_eq!(mirror.rigidity_error(), 2.0);
        let stretch = Pose::new(&(Matrix::identity() * 1.001), &Vector::zeros());
        assert!(stretch.rigidity_error() > 1e-3);
        let mut hole = Pose::identity();
        hole.rows[1][1] = f64::NAN;
        assert!(hole.rigidity_error().is_nan());
    }
}
