//! The axes of cells and their stretch: a straight map of the space in which they are relaxed.

use crate::geom::{Matrix, Plane, Point, Vector};

/// The frame in which cells are cubes: its axes, and the sides of the cells along them.
///
/// In it the model is turned and squeezed, without a change of volume. What is a cube there is a
/// turned box in the model, and bisectors are planes in both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    to_model: Matrix,
    to_frame: Matrix,
}

impl Axes {
    /// Makes a frame of its axes (unit columns, right-handed) and the ratios of the sides along
    /// them, which are above zero.
    pub fn new(axes: &Matrix, sides: [f64; 3]) -> Self {
        let mean = sides.iter().product::<f64>().cbrt();
        let stretch = Vector::from(sides.map(|side| side / mean));
        let squeeze = stretch.map(|side| 1.0 / side);
        Self {
            to_model: axes * Matrix::from_diagonal(&stretch),
            to_frame: Matrix::from_diagonal(&squeeze) * axes.transpose(),
        }
    }

    /// Returns the model's own axes.
    pub fn plain() -> Self {
        Self {
            to_model: Matrix::identity(),
            to_frame: Matrix::identity(),
        }
    }

    /// Returns true if nothing is turned or stretched.
    pub fn is_plain(&self) -> bool {
        *self == Self::plain()
    }

    /// Returns a place in the model from one in the frame.
    pub fn to_model(&self, at: &Point) -> Point {
        self.to_model * at
    }

    /// Returns the plane in the model from one in the frame that goes through a place of it.
    pub fn plane_to_model(&self, plane: &Plane, through: &Point) -> Plane {
        let normal = self.to_frame.transpose() * plane.normal;
        Plane::through(&self.to_model(through), &normal)
    }

    /// Returns a place in the frame from one in the model.
    pub fn to_frame(&self, at: &Point) -> Point {
        self.to_frame * at
    }
}

/// A place with the axes of the cells there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedAxes {
    /// The place, mm.
    pub at: Point,
    /// The axes: unit columns, right-handed.
    pub axes: Matrix,
}

impl PlacedAxes {
    /// Makes axes at a place: the first one along `first`, the second toward `toward`. `None` if
    /// both lie on a line.
    pub fn new(at: Point, first: &Vector, toward: &Vector) -> Option<Self> {
        let [first, toward] = [first, toward].map(|way| way / way.amax().max(f64::MIN_POSITIVE));
        let first = first.try_normalize(0.0)?;
        let across = toward - first * first.dot(&toward);
        let is_beside = across.norm() > LEAST_SINE * toward.norm();
        let second = across.try_normalize(0.0).filter(|_| is_beside)?;
        let third = first.cross(&second);
        Some(Self {
            at,
            axes: Matrix::from_columns(&[first, second, third]),
        })
    }
}

/// The least sine of the angle between two axes that are given.
const LEAST_SINE: f64 = 1e-6;

/// Returns the axes of the place that is nearest to a point; the model's own without any.
pub fn nearest_axes(placed: &[PlacedAxes], at: &Point) -> Matrix {
    let far = |placed: &&PlacedAxes| (placed.at - at).norm_squared();
    let nearest = placed.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
    nearest.map_or(Matrix::identity(), |placed| placed.axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_of_the_frame_is_a_turned_box_of_the_model() {
        let turn = nalgebra::Rotation3::new(Vector::new(0.2, 0.5, -0.1)).into_inner();
        let axes = Axes::new(&turn, [1.0, 2.0, 4.0]);
        let corner = axes.to_model(&Point::new(1.0, 1.0, 1.0));
        let along = turn.transpose() * corner.coords;
        assert!((along - Vector::new(0.5, 1.0, 2.0)).norm() < 1e-12);
        let back = axes.to_frame(&corner);
        assert!((back - Point::new(1.0, 1.0, 1.0)).norm() < 1e-12);
        assert!(Axes::new(&Matrix::identity(), [3.0; 3]).is_plain() && !axes.is_plain());
    }

    #[test]
    fn axes_are_square_to_each_other_and_two_on_a_line_are_none() {
        let at = Point::origin();
        let placed = PlacedAxes::new(at, &Vector::new(0.0, 3.0, 0.0), &Vector::new(1.0, 1.0, 0.0));
        let axes = placed.unwrap().axes;
        assert_eq!(axes.column(1), Vector::x());
        assert!((axes.determinant() - 1.0).abs() < 1e-12);
        assert!(PlacedAxes::new(at, &Vector::x(), &(Vector::x() * -2.0)).is_none());
        assert!(PlacedAxes::new(at, &Vector::zeros(), &Vector::x()).is_none());
        assert_eq!(nearest_axes(&[], &at), Matrix::identity());
    }
}
