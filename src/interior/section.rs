//! A quadric over one row of columns: a quadratic in z on each column.

use super::columns::Columns;
use crate::geom::Quadric;

/// q(x, z) = c₀(x) + c₁(x) z + c₂ z² at one y, by the means over cells in x and y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    /// Coefficients of c₀ by powers of x.
    pub c0: [f64; 3],
    /// Coefficients of c₁ by powers of x.
    pub c1: [f64; 2],
    /// The constant c₂.
    pub c2: f64,
    /// Half of a cell's sides times ∂q/∂x = a₀ + a₁x + a₂z and ∂q/∂y = b₀ + b₁x + b₂z.
    pub across: [[f64; 3]; 2],
}

impl Section {
    /// Returns the quadric over the row at `y`.
    pub fn new(quadric: &Quadric, pitch_mm: [f64; 2], y: f64) -> Self {
        let [g, gx, gy, gz, gxy, gyz, gxz, gxx, gyy, gzz] = quadric.0;
        let [var_x, var_y] = pitch_mm.map(cell_variance);
        Self {
            c0: [
                g + gy * y + gyy * (y * y + var_y) + gxx * var_x,
                gx + gxy * y,
                gxx,
            ],
            c1: [gz + gyz * y, gxz],
            c2: gzz + 0.0, // turns −0 into +0, on which the roots at infinity rely
            across: [
                [gx + gxy * y, 2.0 * gxx, gxz].map(|slope| slope * 0.5 * pitch_mm[0]),
                [gy + 2.0 * gyy * y, gxy, gyz].map(|slope| slope * 0.5 * pitch_mm[1]),
            ],
        }
    }

    /// Returns the quadratic on the column at `x`, by powers of z.
    pub fn at(&self, x: f64) -> [f64; 3] {
        [
            self.c0[0] + x * (self.c0[1] + x * self.c0[2]),
            self.c1[0] + x * self.c1[1],
            self.c2,
        ]
    }
}

/// Returns the mean of x² over a cell of width `pitch_mm` centred at zero, mm².
pub(super) fn cell_variance(pitch_mm: f64) -> f64 {
    pitch_mm * pitch_mm / 12.0
}

/// Returns q on a column as c₀ + c₁z + c₂z², by its cell's means in x and y.
pub(super) fn mean_on_column(columns: &Columns, column: usize, quadric: &Quadric) -> [f64; 3] {
    let [x, y] = columns.centers[column];
    Section::new(quadric, columns.pitch_mm, y).at(x)
}

/// The sign changes of q on a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// Roots, ascending; equal if there are none.
    pub roots: [f64; 2],
    /// True if q is positive outside of the roots, false if it is between them.
    pub is_positive_outside: bool,
}

/// Returns the sign changes of q on a column.
///
/// The quadratic formula is the stable one: nothing cancels, and a vanishing leading term sends one
/// root to infinity.
pub(super) fn crossing_of_column(columns: &Columns, quadric: &Quadric, column: usize) -> Crossing {
    let [c0, c1, c2] = mean_on_column(columns, column, quadric);
    let discriminant = c1 * c1 - 4.0 * c2 * c0;
    if discriminant <= 0.0 {
        return Crossing {
            roots: [0.0; 2],
            is_positive_outside: c2 > 0.0 || (c2 == 0.0 && c0 > 0.0),
        };
    }
    let half = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let (one, other) = (half / c2, c0 / half);
    Crossing {
        roots: [one.min(other), one.max(other)],
        is_positive_outside: c2 >= 0.0,
    }
}
