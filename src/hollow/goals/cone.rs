//! The convex cones whose bounds tops and yo-yos keep, and the rows that touch them.

use crate::geom::Quadric;
use crate::hollow::dual::units::index::{ONE, XX, XY, YY, Z, ZZ};
use crate::hollow::graded::{Row, Sense};
use crate::mass::Moments;

/// A function of the moments that is not positive where a limit is kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cone {
    /// Weights of s_z, I_zz and of the convex part.
    pub weights: [f64; 3],
    /// True for a norm of the tensor, false for its greatest moment across the axis.
    pub is_norm: bool,
}

impl Cone {
    /// Returns the linear function that touches it at some moments, as a row.
    pub fn row_at(&self, moments: &Moments, height_mm: f64) -> Row {
        let [about_x, across, about_y] = tensor(moments, height_mm);
        let [p, q, r] = if self.is_norm {
            let norm = (about_x.powi(2) + 2.0 * across.powi(2) + about_y.powi(2)).sqrt();
            [about_x, 2.0 * across, about_y].map(|x| x / norm.max(f64::MIN_POSITIVE))
        } else {
            let (sin, cos) = (0.5 * (2.0 * across).atan2(about_x - about_y)).sin_cos();
            [cos * cos, 2.0 * cos * sin, sin * sin]
        };
        let [lever, axial, convex] = self.weights;
        let both = convex * (p + r);
        at_most(quadric(&[
            (ONE, both * height_mm * height_mm),
            (Z, lever - 2.0 * both * height_mm),
            (XY, -convex * q),
            (XX, axial + convex * r),
            (YY, axial + convex * p),
            (ZZ, both),
        ]))
    }
}

/// Returns I'_xx, I_xy and I'_yy about a point of the axis at a height, mm⁵.
pub(super) fn tensor(moments: &Moments, height_mm: f64) -> [f64; 3] {
    let [volume, _, _, z, xy, _, _, xx, yy, zz] = moments.0;
    let across = zz - 2.0 * height_mm * z + height_mm * height_mm * volume;
    [yy + across, -xy, xx + across]
}

/// Returns a quadric of a few terms.
pub(super) fn quadric(terms: &[(usize, f64)]) -> Quadric {
    let mut quadric = Quadric([0.0; 10]);
    for &(index, coefficient) in terms {
        quadric.0[index] += coefficient;
    }
    quadric
}

/// Returns the row that a linear function of the moments be at most zero.
pub(super) fn at_most(quadric: Quadric) -> Row {
    Row {
        quadric,
        wanted: 0.0,
        sense: Sense::AtMost,
    }
}

/// Returns by how much moments break a row, over the size of its terms.
pub(super) fn excess(row: &Row, moments: &Moments) -> f64 {
    let terms = row.quadric.0.iter().zip(moments.0);
    let (sum, size) = terms.fold(
        (-row.wanted, row.wanted.abs()),
        |(sum, size), (c, moment)| (sum + c * moment, size + (c * moment).abs()),
    );
    sum / size.max(f64::MIN_POSITIVE)
}
