//! Motions along helices: one formula for lines, arcs and helices.

use crate::geom::{Frame, Matrix, Point, Vector};

/// The angle below which the sine terms are taken from their series, rad. The first omitted terms
/// are below 1e-16 there.
const SERIES_RAD: f64 = 1e-4;

/// A helix by its curvature and torsion, 1/mm: an arc without torsion, a line without curvature.
///
/// It begins at the origin, with the tangent x, the normal (towards the axis) y and the binormal z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Helix {
    /// The curvature, 1/mm; not negative.
    pub curvature: f64,
    /// The torsion, 1/mm; positive turns right-handed.
    pub torsion: f64,
}

/// A small rigid motion, per unit of what causes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// The rate of turning, a vector along the axis.
    pub turn: Vector,
    /// The velocity of the point at the model's origin.
    pub shift: Vector,
}

impl Helix {
    /// A straight line.
    pub const LINE: Self = Self {
        curvature: 0.0,
        torsion: 0.0,
    };

    /// Returns the frame at an arc length from the start: point, and tangent, normal and binormal
    /// as columns. A negative length goes back.
    ///
    /// This is exp(s ξ) with ξ = ((τ, 0, κ), (1, 0, 0)), exact up to rounding. So the frames at a
    /// and b compose to the one at a + b: a tube about the helix slides in itself.
    pub fn frame_at(&self, arc_mm: f64) -> Frame {
        let rate = self.curvature.hypot(self.torsion);
        let angle = rate * arc_mm;
        let (sine, cosine, third) = sine_terms(angle);
        let (first, second) = (arc_mm * sine, arc_mm.powi(2) * cosine);
        let spin = cross_matrix(&self.turn_rate());
        let square = spin * spin;
        let along = Matrix::identity() * arc_mm + spin * second + square * (arc_mm.powi(3) * third);
        Frame {
            origin: Point::from(along.column(0).into_owned()),
            axes: Matrix::identity() + spin * first + square * second,
        }
    }

    /// Returns the twist that slides the helix in itself, for each mm.
    pub fn slide(&self) -> Twist {
        Twist {
            turn: self.turn_rate(),
            shift: Vector::x(),
        }
    }

    /// Returns the Darboux vector in the start frame, rad/mm.
    fn turn_rate(&self) -> Vector {
        Vector::new(self.torsion, 0.0, self.curvature)
    }
}

impl Twist {
    /// No motion.
    pub const ZERO: Self = Self {
        turn: Vector::new(0.0, 0.0, 0.0),
        shift: Vector::new(0.0, 0.0, 0.0),
    };

    /// Returns the turn about an axis through a point.
    pub fn about(axis: &Vector, point: &Point) -> Self {
        Self {
            turn: *axis,
            shift: point.coords.cross(axis),
        }
    }

    /// Returns the velocity of a point that moves with it.
    pub fn at(&self, point: &Point) -> Vector {
        self.turn.cross(&point.coords) + self.shift
    }

    /// Returns the twist, given in a frame's coordinates, in model coordinates.
    #[must_use]
    pub fn from_frame(&self, frame: &Frame) -> Self {
        let turn = frame.direction_to_model(&self.turn);
        let shift = frame.direction_to_model(&self.shift);
        Self {
            turn,
            shift: shift + frame.origin.coords.cross(&turn),
        }
    }

    /// Returns this twist and a multiple of another.
    #[must_use]
    pub fn plus(&self, other: &Self, factor: f64) -> Self {
        Self {
            turn: self.turn + other.turn * factor,
            shift: self.shift + other.shift * factor,
        }
    }
}

/// Returns the turn by an angle about the tangent, as a motion of the start frame.
pub fn roll(angle_rad: f64) -> Frame {
    let (sin, cos) = angle_rad.sin_cos();
    Frame {
        origin: Point::origin(),
        axes: Matrix::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos),
    }
}

/// Returns sin x / x, (1 − cos x) / x² and (x − sin x) / x³.
fn sine_terms(x: f64) -> (f64, f64, f64) {
    let square = x * x;
    if x.abs() < SERIES_RAD {
        return (
            1.0 - square / 6.0,
            0.5 - square / 24.0,
            1.0 / 6.0 - square / 120.0,
        );
    }
    let half = (0.5 * x).sin();
    (
        x.sin() / x,
        2.0 * half * half / square,
        (x - x.sin()) / (square * x),
    )
}

/// Returns the matrix W with W x = w × x.
fn cross_matrix(w: &Vector) -> Matrix {
    Matrix::new(0.0, -w.z, w.y, w.z, 0.0, -w.x, -w.y, w.x, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn distance(a: &Frame, b: &Frame) -> f64 {
        (a.origin - b.origin).norm().max((a.axes - b.axes).norm())
    }

    #[test]
    fn the_frame_along_a_helix_is_that_of_the_reference() {
        let helix = Helix {
            curvature: 0.02,
            torsion: 0.01,
        };
        let frame = helix.frame_at(150.0);
        let point = Vector::new(22.454132, 79.100190, 63.772934);
        let tangent = Vector::new(-0.582004, -0.188647, 0.791002);
        let normal = Vector::new(0.188647, -0.977505, -0.094323);
        assert!((frame.origin.coords - point).norm() < 1e-6);
        assert!((frame.axes.column(0) - tangent).norm() < 1e-6);
        assert!((frame.axes.column(1) - normal).norm() < 1e-6);
    }

    #[test]
    fn a_line_goes_straight_and_an_arc_comes_round() {
        let end = Helix::LINE.frame_at(-40.0);
        assert_eq!(end.origin, Point::new(-40.0, 0.0, 0.0));
        assert_eq!(end.axes, Matrix::identity());
        let arc = Helix {
            curvature: 0.1,
            torsion: 0.0,
        };
        let round = arc.frame_at(20.0 * std::f64::consts::PI);
        assert!(distance(&round, &Frame::identity()) < 1e-13);
    }

    #[test]
    fn the_series_meets_the_closed_form() {
        let (below, above) = (
            sine_terms(SERIES_RAD * (1.0 - 1e-9)),
            sine_terms(SERIES_RAD),
        );
        assert!((below.0 - above.0).abs() < 1e-15);
        assert!((below.1 - above.1).abs() < 1e-15);
        // The closed form loses digits there, but it is multiplied by x².
        assert!((below.2 - above.2).abs() * SERIES_RAD.powi(2) < 1e-15);
    }

    #[test]
    fn a_twist_moves_points_as_the_helix_slides() {
        let helix = Helix {
            curvature: 0.03,
            torsion: -0.02,
        };
        let place = Frame::with_axis(Point::new(3.0, 4.0, -5.0), &Vector::new(1.0, 2.0, 2.0));
        let point = place.to_model(&helix.frame_at(7.0).origin);
        let (ahead, back) = (helix.frame_at(7.0 + 1e-4), helix.frame_at(7.0 - 1e-4));
        let found = helix.slide().from_frame(&place).at(&point);
        let expected = place.to_model(&ahead.origin) - place.to_model(&back.origin);
        assert!((found - expected / 2e-4).norm() < 1e-8);
    }

    proptest! {
        #[test]
        fn a_helix_slides_in_itself(
            curvature in 0.0..0.2f64,
            torsion in -0.2..0.2f64,
            a in -100.0..100.0f64,
            b in -100.0..100.0f64,
        ) {
            let helix = Helix { curvature, torsion };
            let both = helix.frame_at(a).frame_to_model(&helix.frame_at(b));
            prop_assert!(distance(&both, &helix.frame_at(a + b)) < 1e-11);
        }

        #[test]
        fn turns_about_the_tangent_add(a in -4.0..4.0f64, b in -4.0..4.0f64) {
            prop_assert!(distance(&roll(a).frame_to_model(&roll(b)), &roll(a + b)) < 1e-14);
        }
    }
}
