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
