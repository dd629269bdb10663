//! Round bars in closed form: axles, pins, rings and rounded tips that are not printed.

use std::f64::consts::PI;

use super::moments::Moments;
use crate::geom::{Frame, Matrix, Point, Vector};

/// A round bar: a cylinder between two points, with or without a hole along it. Its far end is flat
/// or a half ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundBar {
    /// One end, on the axis.
    pub from: Point,
    /// The other end, on the axis; for a rounded end its outermost point.
    pub to: Point,
    /// Outer radius, mm; a rounded bar is at least as long.
    pub radius_mm: f64,
    /// Radius of the hole along it, mm; zero for none.
    pub hole_mm: f64,
    /// True if the end at `to` is a half ball; such a bar has no hole.
    pub is_round: bool,
}

impl RoundBar {
    /// Returns a plain cylinder.
    pub fn plain(from: Point, to: Point, radius_mm: f64) -> Self {
        Self {
            from,
            to,
            radius_mm,
            hole_mm: 0.0,
            is_round: false,
        }
    }

    /// Returns the length from end to end, mm.
    pub fn length_mm(&self) -> f64 {
        (self.to - self.from).norm()
    }

    /// Returns the ten moments of the bar's volume, in the coordinates of its ends. Closed forms,
    /// exact to rounding; zero for a bar of no length.
    pub fn moments(&self) -> Moments {
        let length_mm = self.length_mm();
        if length_mm == 0.0 {
            return Moments::default();
        }
        let along = Frame::with_axis(self.from, &(self.to - self.from));
        let straight_mm = if self.is_round {
            length_mm - self.radius_mm
        } else {
            length_mm
        };
        let body = cylinder(self.radius_mm, straight_mm) - cylinder(self.hole_mm, straight_mm);
        let cap = if self.is_round {
            half_ball(self.radius_mm)
        } else {
            Moments::default()
        };
        (body + cap.translated(&(Vector::z() * straight_mm))).from_frame(&along)
    }
}

/// Returns the moments of the cylinder about z that stands on z = 0.
fn cylinder(radius_mm: f64, height_mm: f64) -> Moments {
    let volume = PI * radius_mm * radius_mm * height_mm;
    let across = 0.25 * radius_mm * radius_mm;
    let second = Matrix::from_diagonal(&Vector::new(across, across, height_mm * height_mm / 12.0));
    let middle = Moments::from_parts(volume, &Vector::zeros(), &(second * volume));
    middle.translated(&(Vector::z() * (0.5 * height_mm)))
}

/// Returns the moments of the half ball over z = 0: its centre lies 3r/8 above, ∫x² = ∫y² = ∫z² =
/// 2πr⁵/15.
fn half_ball(radius_mm: f64) -> Moments {
    let volume = 2.0 / 3.0 * PI * radius_mm.powi(3);
    let first = Vector::z() * (volume * 0.375 * radius_mm);
    Moments::from_parts(
        volume,
        &first,
        &(Matrix::identity() * (0.2 * volume * radius_mm * radius_mm)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::{Body, moments_of_mesh};
    use crate::mesh::primitives;

    #[test]
    fn a_cylinder_has_the_moments_of_a_prism_with_many_sides() {
        let bar = RoundBar::plain(Point::new(0.0, 0.0, 0.0), Point::new(0.0, 0.0, 12.0), 3.0);
        let prism = moments_of_mesh(&primitives::cylinder(3.0, 12.0, 4096));
        // A prism of n sides lacks (2π/n)²/6 of its area, 4e-7, and twice that of its second
        // moments across.
        for (exact, near) in bar.moments().0.into_iter().zip(prism.0) {
            assert!((exact - near).abs() < 1e-6 * prism.0[9], "{exact} {near}");
        }
    }

    #[test]
    fn a_tube_along_x_has_its_textbook_inertia() {
        let (from, to) = (Point::new(1.0, 2.0, 3.0), Point::new(9.0, 2.0, 3.0));
        let tube = RoundBar {
            hole_mm: 2.0,
            ..RoundBar::plain(from, to, 5.0)
        };
        let body = Body::new(&tube.moments(), 1.0);
        let squares = 25.0 + 4.0;
        assert!((body.center - Point::new(5.0, 2.0, 3.0)).norm() < 1e-12);
        assert!((body.inertia_g_mm2[(0, 0)] / (0.5 * body.mass_g * squares) - 1.0).abs() < 1e-12);
        assert!(
            (body.inertia_g_mm2[(1, 1)] / (body.mass_g * (3.0 * squares + 64.0) / 12.0) - 1.0)
                .abs()
                < 1e-12
        );
    }

    #[test]
    fn a_rounded_bar_as_long_as_its_radius_is_half_a_ball() {
        let half = RoundBar {
            is_round: true,
            ..RoundBar::plain(Point::origin(), Point::new(0.0, 0.0, -2.0), 2.0)
        };
        let other = RoundBar {
            to: Point::new(0.0, 0.0, 2.0),
            ..half
        };
        let body = Body::new(&(half.moments() + other.moments()), 1.0);
        let mass = 4.0 / 3.0 * PI * 8.0;
        assert!((body.mass_g / mass - 1.0).abs() < 1e-12 && body.center.coords.norm() < 1e-12);
        assert!(
            (body.inertia_g_mm2 - Matrix::identity() * (0.4 * mass * 4.0)).amax() < 1e-12 * mass
        );
    }
}
