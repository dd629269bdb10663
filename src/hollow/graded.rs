//! A density between two bounds that must meet linear rows, in the solver's units.

use nalgebra::{DMatrix, DVector};

use super::dual::units::{Scale, Vector10};
use super::newton::Local;
use crate::geom::Quadric;
use crate::interior::{Columns, Matrix10, moments_and_own_derivative};
use crate::mass::Moments;

/// A linear row over the ten moments of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Coefficients of the moments: the row is the integral of this quadric times the density.
    pub quadric: Quadric,
    /// Value that the integral must have, or must not exceed.
    pub wanted: f64,
    /// The kind of row.
    pub sense: Sense,
}

/// The kind of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// The integral must have the value.
    Equal,
    /// The integral must not exceed the value.
    AtMost,
}

/// A body whose interior may have any density between two bounds, and what it must meet.
#[derive(Debug, Clone, Copy)]
pub struct Graded<'a> {
    /// Moments of what is solid in any case, in the columns' frame.
    pub shell: Moments,
    /// The interior.
    pub columns: &'a Columns,
    /// The rows, in the columns' frame.
    pub rows: &'a [Row],
}

/// A proof that no density within the bounds meets the rows.
///
/// The quadric's integral times the density is above what the rows allow, for every density.
#[derive(Debug, Clone, PartialEq)]
pub struct Separation {
    /// The weights of the rows, which make the quadric.
    pub weights: Vec<f64>,
    /// The weighted sum of the rows' quadrics.
    pub quadric: Quadric,
}

impl Row {
    /// Returns the row that a linear function of the moments be zero.
    pub fn zero(quadric: Quadric) -> Self {
        Self {
            quadric,
            wanted: 0.0,
            sense: Sense::Equal,
        }
    }
}

/// The rows and the moments in units of the body's volume and radius of gyration; rows have unit
/// length.
pub(super) struct InUnits<'a> {
    columns: &'a Columns,
    scale: Scale,
    /// Moments of the shell and of the interior at density 1.
    pub shell: Vector10,
    pub interior: Vector10,
    pub rows: DMatrix<f64>,
    pub wanted: DVector<f64>,
    pub is_bounded: Vec<bool>,
    lengths: Vec<f64>,
}

/// Moments where a quadric is positive, and their derivative, in units.
pub(super) struct Positive {
    pub moments: Vector10,
    pub derivative: Matrix10,
}

impl<'a> InUnits<'a> {
    pub fn new(graded: &Graded<'a>) -> Self {
        let interior = graded.columns.moments();
        let scale = Scale::of(&(graded.shell + interior));
        let units = scale.units();
        let scaled: Vec<Vector10> = graded
            .rows
            .iter()
            .map(|row| Vector10::from(row.quadric.0).component_mul(&units))
            .collect();
        let lengths: Vec<f64> = scaled
            .iter()
            .map(|row| row.norm().max(f64::MIN_POSITIVE))
            .collect();
        let count = graded.rows.len();
        Self {
            columns: graded.columns,
            shell: scale.moments_to_units(&graded.shell),
            interior: scale.moments_to_units(&interior),
            rows: DMatrix::from_fn(count, 10, |i, j| scaled[i][j] / lengths[i]),
            wanted: DVector::from_fn(count, |i, _| graded.rows[i].wanted / lengths[i]),
            is_bounded: graded
                .rows
                .iter()
                .map(|row| row.sense == Sense::AtMost)
                .collect(),
            lengths,
            scale,
        }
    }

    /// Returns A s − b for moments in units.
    pub fn excess(&self, moments: &Vector10) -> DVector<f64> {
        &self.rows * moments - &self.wanted
    }

    /// Returns the weighted sum of the rows as a quadric over mm.
    pub fn quadric(&self, weights: &DVector<f64>) -> Quadric {
        let sum = self.rows.tr_mul(weights);
        let units = self.scale.units() / self.scale.volume_mm3;
        Quadric(std::array::from_fn(|i| sum[i] / units[i]))
    }

    /// Returns the weights of the rows as they were given, for weights in units.
    pub fn separation(&self, weights: &DVector<f64>) -> Separation {
        let own = weights.iter().zip(&self.lengths);
        let factor = weights.norm().max(f64::MIN_POSITIVE).recip();
        Separation {
            weights: own
                .map(|(weight, length)| factor * weight / length)
                .collect(),
            quadric: Quadric(self.quadric(weights).0.map(|c| c * factor)),
        }
    }

    /// Returns the weights of a row of unit length over moments in units, and what it wants.
    pub fn row_to_units(&self, row: &Row) -> (Vector10, f64) {
        let scaled = Vector10::from(row.quadric.0).component_mul(&self.scale.units());
        let length = scaled.norm().max(f64::MIN_POSITIVE);
        (scaled / length, row.wanted / length)
    }

    /// Returns a quadric over mm in units: the inverse of [`Self::quadric`] without rows.
    pub fn quadric_to_units(&self, quadric: &Quadric) -> Vector10 {
        let units = self.scale.units() / self.scale.volume_mm3;
        Vector10::from(quadric.0).component_mul(&units)
    }

    /// Returns the unit of length, mm.
    pub fn length_mm(&self) -> f64 {
        self.scale.length_mm
    }

    /// Returns moments over mm in units.
    pub fn to_units(&self, moments: &Moments) -> Vector10 {
        self.scale.moments_to_units(moments)
    }

    /// Returns moments in units over mm.
    pub fn to_mm(&self, moments: &Vector10) -> Moments {
        self.scale.moments_to_mm(moments)
    }

    /// Returns a matrix over pairs of monomials in units: an integral of m mᵀ, or a derivative of
    /// moments by the coefficients of a quadric.
    pub fn pairs_to_units(&self, matrix: &Matrix10) -> Matrix10 {
        let units = self.scale.units();
        Matrix10::from_fn(|i, j| matrix[(i, j)] * self.scale.volume_mm3 / (units[i] * units[j]))
    }

    /// Returns the moments where a quadric over mm is positive, and their derivative by the
    /// coefficients in units.
    pub fn positive(&self, quadric: &Quadric) -> Positive {
        let (moments, derivative) = moments_and_own_derivative(self.columns, quadric);
        Positive {
            moments: self.to_units(&moments),
            derivative: self.pairs_to_units(&derivative),
        }
    }

    /// Returns A M Aᵀ.
    pub fn between_rows(&self, matrix: &Matrix10) -> DMatrix<f64> {
        &self.rows * matrix * self.rows.transpose()
    }

    /// Returns the greatest share of the whole by which a quadratic form over all of the interior
    /// can count, for flat Hessians.
    pub fn full_trace(&self) -> f64 {
        let squares = self.rows.map(|entry| entry * entry).row_sum();
        squares.sum() * self.interior[0].max(f64::MIN_POSITIVE)
    }

    /// Returns a function to minimise from a dual function to maximise.
    pub fn negated(&self, value: f64, gradient: &DVector<f64>, curvature: &Matrix10) -> Local {
        Local {
            value: -value,
            gradient: -gradient,
            hessian: self.between_rows(curvature),
            full_trace: self.full_trace(),
        }
    }
}
