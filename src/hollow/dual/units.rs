//! The ten moments in the solver's own units.

use nalgebra::SVector;

use crate::geom::Quadric;
use crate::interior::Matrix10;
use crate::mass::Moments;

/// Ten numbers over the monomials of the moments, in the solver's own units.
pub(crate) type Vector10 = SVector<f64, 10>;

/// The degree of each of the ten monomials.
const DEGREES: [i32; 10] = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2];

/// The solver's own units: the solid's volume, and its radius of gyration about the goal's origin.
/// In them all ten moments are of the order of one, so one tolerance and one damping serve every
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

    /// What one unit of each moment is in mm.
    pub fn units(&self) -> Vector10 {
        Vector10::from_fn(|i, _| self.volume_mm3 * self.length_mm.powi(DEGREES[i]))
    }

    pub fn moments_to_units(&self, moments: &Moments) -> Vector10 {
        Vector10::from(moments.0).component_div(&self.units())
    }

    pub fn moments_to_mm(&self, moments: &Vector10) -> Moments {
        Moments(moments.component_mul(&self.units()).into())
    }

    /// The same quadric over mm; its values are left unchanged but for the volume's factor.
    pub fn quadric_to_mm(&self, quadric: &Vector10) -> Quadric {
        Quadric(quadric.component_div(&self.units()).into())
    }
}

/// Where the ten moments stand.
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

/// The point of K least along a direction g: the interior with { g·m > 0 } emptied.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extreme {
    /// Its moments.
    pub s: Vector10,
    /// −∂s/∂g, positive semidefinite.
    pub w: Matrix10,
    /// What its heavy material costs.
    pub cost: f64,
}
