//! A rigid body: mass, centre and inertia tensor, and its principal axes.

use super::moments::Moments;
use crate::geom::{Frame, Matrix, Point, Vector};

/// The mass properties of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Mass, g.
    pub mass_g: f64,
    /// Centre of mass, mm.
    pub center: Point,
    /// Inertia tensor about the centre of mass, g·mm².
    pub inertia_g_mm2: Matrix,
}

/// Principal moments and axes of a body, moments ascending.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Principal {
    /// Principal moments I_a ≤ I_b ≤ I_c about the centre of mass, g·mm².
    pub moments_g_mm2: [f64; 3],
    /// Matching unit axes as columns.
    pub axes: Matrix,
}

/// Excess over the triangle inequality, as a share of the greatest moment, that is rounding.
const TRIANGLE_ROUNDING: f64 = 1e-9;

/// A reason why no distribution of mass has some mass properties.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImpossibleBody {
    /// The mass is not positive, or a number is not finite.
    #[error(
        "no body has a mass of {0} g and these numbers; remedy: give finite ones, mass above 0"
    )]
    Mass(f64),
    /// The principal moments violate the triangle inequality.
    #[error(
        "no body has the principal moments {:.6}, {:.6} and {:.6} g·mm²: each is at most the sum \
         of the other two (triangle inequality); remedy: check the signs of the off-diagonals",
        .0[0], .0[1], .0[2]
    )]
    Triangle([f64; 3]),
}

impl Body {
    /// Returns the body that fills a region of these moments with a material of `density_g_mm3`.
    ///
    /// The tensor is I = tr(S)·1 − S with S the central second moments (Spin-It, eq. 4 and after).
    pub fn new(moments: &Moments, density_g_mm3: f64) -> Self {
        let center = moments.centroid();
        let central = moments.translated(&-center.coords).second() * density_g_mm3;
        Self {
            mass_g: moments.volume() * density_g_mm3,
            center,
            inertia_g_mm2: Matrix::identity() * central.trace() - central,
        }
    }

    /// Returns the moments of a region of this material, g/mm³, that has these mass properties: the
    /// inverse of [`Body::new`].
    ///
    /// # Errors
    /// No distribution of mass has them.
    pub fn moments(&self, density_g_mm3: f64) -> Result<Moments, ImpossibleBody> {
        self.check()?;
        let mass = self.mass_g;
        let center = self.center.coords;
        let central = Matrix::identity() * (0.5 * self.inertia_g_mm2.trace()) - self.inertia_g_mm2;
        let second = central + center * center.transpose() * mass;
        Ok(Moments::from_parts(mass, &(center * mass), &second) * density_g_mm3.recip())
    }

    /// Checks that some distribution of mass has these properties: its mass is positive, and no
    /// principal moment exceeds the sum of the other two.
    ///
    /// # Errors
    /// None has.
    pub fn check(&self) -> Result<(), ImpossibleBody> {
        let numbers = self.center.coords.iter().chain(self.inertia_g_mm2.iter());
        let is_finite = numbers.into_iter().all(|number| number.is_finite());
        if !(is_finite && self.mass_g.is_finite() && self.mass_g > 0.0) {
            return Err(ImpossibleBody::Mass(self.mass_g));
        }
        let [least, middle, greatest] = self.principal().moments_g_mm2;
        let rounding = TRIANGLE_ROUNDING * greatest.abs();
        if greatest > least + middle + rounding || least < -rounding {
            return Err(ImpossibleBody::Triangle([least, middle, greatest]));
        }
        Ok(())
    }

    /// Returns the principal moments, ascending, and their axes.
    pub fn principal(&self) -> Principal {
        let eigen = self.inertia_g_mm2.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        Principal {
            moments_g_mm2: order.map(|i| eigen.eigenvalues[i]),
            axes: Matrix::from_columns(&order.map(|i| eigen.eigenvectors.column(i).into_owned())),
        }
    }

    /// Returns the same body in the coordinates of `frame`.
    pub fn in_frame(&self, frame: &Frame) -> Self {
        Self {
            mass_g: self.mass_g,
            center: frame.to_local(&self.center),
            inertia_g_mm2: frame.axes.transpose() * self.inertia_g_mm2 * frame.axes,
        }
    }

    /// Returns the distance of the centre of mass from the line through `origin` along the unit
    /// `axis`, mm.
    pub fn axis_offset_mm(&self, origin: &Point, axis: &Vector) -> f64 {
        (self.center - origin).cross(axis).norm()
    }
}
