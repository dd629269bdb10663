//! The task of a fit: rows, and the fields that may meet them.

use super::shape::Family;
use super::state::Rows;
use crate::field::DensityRange;
use crate::hollow::graded::{Graded, InUnits, Row};
use crate::mass::Moments;

/// Rows to which a field of a family is fitted.
pub(in crate::hollow) struct Task<'a> {
    pub graded: &'a Graded<'a>,
    pub units: &'a InUnits<'a>,
    /// The rows that touch convex limits at some moments.
    pub touching: &'a (dyn Fn(&Moments) -> Vec<Row> + Sync),
    pub family: Family,
    pub range: DensityRange,
    pub wished: f64,
}

impl Task<'_> {
    /// Returns the rows.
    pub fn rows(&self) -> Rows<'_> {
        Rows {
            fixed: self.graded.rows,
            touching: self.touching,
        }
    }
}
