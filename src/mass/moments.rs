//! The ten moments of a region. They add, and every mass property is a function of them.

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use crate::geom::{Frame, Matrix, Point, Vector};

/// The integrals of (1, x, y, z, xy, yz, xz, x², y², z²) over a region, in mm³ to mm⁵.
///
/// These are Spin-It's eq. 4 without the density. They add over disjoint regions, so a hollowed
/// body is the solid minus its voids.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moments(pub [f64; 10]);

impl Moments {
    /// Number of moments.
    pub const COUNT: usize = 10;

    /// Returns the ten monomials at one point: the integrand of the moments.
    #[inline]
    pub fn monomials(x: f64, y: f64, z: f64) -> [f64; 10] {
        [1.0, x, y, z, x * y, y * z, x * z, x * x, y * y, z * z]
    }

    /// Builds moments from the volume (mm³), the first moments (mm⁴) and the symmetric matrix of
    /// second moments ∫xᵢxⱼ (mm⁵).
    pub fn from_parts(volume: f64, first: &Vector, second: &Matrix) -> Self {
        let (f, s) = (first, second);
        Self([
            volume,
            f.x,
            f.y,
            f.z,
            s[(0, 1)],
            s[(1, 2)],
            s[(0, 2)],
            s[(0, 0)],
            s[(1, 1)],
            s[(2, 2)],
        ])
    }

    /// Returns the volume, mm³.
    pub fn volume(&self) -> f64 {
        self.0[0]
    }

    /// Returns the first moments ∫x, mm⁴.
    pub fn first(&self) -> Vector {
        Vector::new(self.0[1], self.0[2], self.0[3])
    }

    /// Returns the symmetric matrix of the second moments ∫xᵢxⱼ, mm⁵.
    pub fn second(&self) -> Matrix {
        let [_, _, _, _, xy, yz, xz, xx, yy, zz] = self.0;
        Matrix::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }

    /// Returns the centroid, mm; not finite if the volume is zero.
    pub fn centroid(&self) -> Point {
        Point::from(self.first() / self.volume())
    }

    /// Returns the moments of the region moved by `shift`.
    pub fn translated(&self, shift: &Vector) -> Self {
        let (volume, first, second) = (self.volume(), self.first(), self.second());
        let moved = second
            + first * shift.transpose()
            + shift * first.transpose()
            + shift * shift.transpose() * volume;
        Self::from_parts(volume, &(first + shift * volume), &moved)
    }

    /// Returns the moments of the region rotated about the origin by `rotation` (any orthogonal
    /// matrix; a mirror keeps the volume positive).
    pub fn rotated(&self, rotation: &Matrix) -> Self {
        let second = rotation * self.second() * rotation.transpose();
        Self::from_parts(self.volume(), &(rotation * self.first()), &second)
    }

    /// Returns the moments of the region with every length scaled by `factor` about the origin.
    pub fn scaled(&self, factor: f64) -> Self {
        let (f3, f4, f5) = (factor.powi(3), factor.powi(4), factor.powi(5));
        Self::from_parts(
            self.volume() * f3,
            &(self.first() * f4),
            &(self.second() * f5),
        )
    }

    /// Returns the moments, in the coordinates of `frame`, of a region given in model coordinates.
    pub fn in_frame(&self, frame: &Frame) -> Self {
        self.translated(&-frame.origin.coords)
            .rotated(&frame.axes.transpose())
    }

    /// Returns the moments, in model coordinates, of a region given in the coordinates of `frame`.
    pub fn from_frame(&self, frame: &Frame) -> Self {
        self.rotated(&frame.axes).translated(&frame.origin.coords)
    }
}

impl Add for Moments {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Moments {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl AddAssign for Moments {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Moments {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Neg for Moments {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|m| -m))
    }
}

impl Mul<f64> for Moments {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|m| m * factor))
    }
}
