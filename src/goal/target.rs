//! The body that a match is like: its mass, its centre of mass and its inertia.

use serde::{Deserialize, Serialize};

use crate::geom::{Matrix, Point};
use crate::mass::{Body, ImpossibleBody, Moments};

/// The mass properties that are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// The mass, g.
    pub mass_g: f64,
    /// The centre of mass, model frame, mm.
    pub center_mm: [f64; 3],
    /// I_xx, I_yy, I_zz, I_xy, I_xz and I_yz about the centre of mass, model axes, g·mm². The last
    /// three are entries of the tensor: I_xy is minus the integral of xy.
    pub inertia_g_mm2: [f64; 6],
}

/// The mass properties that are wanted of a placed goal, in volumes of the printed material.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Wanted {
    /// The moments, goal frame, mm.
    pub moments: Moments,
    /// The density of solid print, g/mm³.
    pub density_g_mm3: f64,
}

impl Target {
    /// Returns the mass properties of a body in the model frame.
    pub fn of(body: &Body) -> Self {
        let tensor = &body.inertia_g_mm2;
        let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        Self {
            mass_g: body.mass_g,
            center_mm: body.center.coords.into(),
            inertia_g_mm2: entries.map(|entry| tensor[entry]),
        }
    }

    /// Returns the body with these mass properties, model frame.
    pub fn body(&self) -> Body {
        let [xx, yy, zz, xy, xz, yz] = self.inertia_g_mm2;
        Body {
            mass_g: self.mass_g,
            center: Point::from(self.center_mm),
            inertia_g_mm2: Matrix::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        }
    }

    /// Checks that some distribution of mass has these properties.
    ///
    /// # Errors
    /// The mass is not positive, or the principal moments violate the triangle inequality.
    pub(super) fn check(&self) -> Result<(), ImpossibleBody> {
        self.body().check()
    }
}
