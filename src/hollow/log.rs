//! The record of a search: one row per ascent, and value and bound pass by pass.

use serde::{Deserialize, Serialize};

/// The search an ascent belonged to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Stage {
    /// The goal's programme itself.
    Goal,
    /// The least dominance ratio, which decides whether a stable interior exists.
    Dominance,
    /// The least or greatest height of a top's centre.
    HeightRange,
    /// A top with its tensor made linear at this height of the centre.
    AtHeight {
        /// Height, mm.
        height_mm: f64,
    },
    /// A top at this height, restricted to interiors with this lever.
    AtLever {
        /// Height, mm.
        height_mm: f64,
        /// Volume times the height of the centre, mm⁴.
        lever_mm4: f64,
    },
    /// The proof that no height around this one is better.
    Cover {
        /// Middle of the covered heights, mm.
        height_mm: f64,
    },
}

/// One ascent, in the solver's own units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LogRow {
    /// Search it belonged to.
    pub stage: Stage,
    /// Passes over the columns.
    pub passes: usize,
    /// Ratio reached by its interior.
    pub value: f64,
    /// Lower bound of the ratio over all interiors.
    pub bound: f64,
    /// Constraint residual.
    pub residual: f64,
}

/// Progress of a search after one pass over the columns.
///
/// The current interior meets the constraints only at the end of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pass {
    /// Value reached by the current interior.
    pub value: f64,
    /// Bound that no interior can beat.
    pub bound: f64,
}

impl Pass {
    /// Applies `change` to both numbers.
    pub(crate) fn map(self, change: impl Fn(f64) -> f64) -> Self {
        Self {
            value: change(self.value),
            bound: change(self.bound),
        }
    }

    /// Returns true if both numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.value.is_finite() && self.bound.is_finite()
    }
}
