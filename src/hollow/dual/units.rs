//! The ten moments in the solver's own units.

use nalgebra::SVector;

use crate::geom::Quadric;
use crate::interior::Matrix10;
use crate::mass::Moments;

/// Ten numbers over the monomials of the moments, in the solver's units.
pub(crate) type Vector10 = SVector<f64, 10>;

/// Degrees of the ten monomials.
const DEGREES: [i32; 10] = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2];

/// The solver's units: the solid's volume, and its radius of gyration about the goal's origin.
///
/// In these units all ten moments are of order one. One tolerance and one damping then serve every
/// row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    pub volume_mm3: f64,
    pub length_mm: f64,
}

impl Scale {
    pub fn of(solid: &Moments) -> Self {
        let squares = solid.second().trace();
        Self {
            volume_mm3: solid.volume(),
            length_mm: (squares / solid.volume()).sqrt(),
        }
    }

    /// Returns one unit of each moment in mm.
    pub fn units(&self) -> Vector10 {
        Vector10::from_fn(|i, _| self.volume_mm3 * self.length_mm.powi(DEGREES[i]))
    }

    pub fn moments_to_units(&self, moments: &Moments) -> Vector10 {
        Vector10::from(moments.0).component_div(&self.units())
    }

    pub fn moments_to_mm(&self, moments: &Vector10) -> Moments {
        Moments(moments.component_mul(&self.units()).into())
    }

    /// Returns the quadric over mm; its values change only by the factor of the volume.
    pub fn quadric_to_mm(&self, quadric: &Vector10) -> Quadric {
        Quadric(quadric.component_div(&self.units()).into())
    }
}

/// Returns the degree of a function of the moments: the greatest of those with a coefficient that
/// is not zero.
pub(crate) fn degree(coefficients: impl Iterator<Item = f64>) -> i32 {
    let present = coefficients.zip(DEGREES).filter(|(c, _)| *c != 0.0);
    present.map(|(_, degree)| degree).max().unwrap_or(0)
}

/// Indices of the ten moments.
pub(crate) mod index {
    pub const ONE: usize = 0;
    pub const X: usize = 1;
    pub const Y: usize = 2;
    pub const Z: usize = 3;
    pub const XY: usize = 4;
    pub const YZ: usize = 5;
    pub const XZ: usize = 6;
    pub const XX: usize = 7;
    pub const YY: usize = 8;
    pub const ZZ: usize = 9;
}

/// The point of K that minimises a direction g: the interior with { g·m > 0 } emptied.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extreme {
    /// Moments of the interior.
    pub s: Vector10,
    /// −∂s/∂g, positive semidefinite.
    pub w: Matrix10,
    /// Price of its heavy material.
    pub cost: f64,
}
