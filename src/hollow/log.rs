//! The record of a search: one row an ascent, and value and bound pass by pass.

use serde::{Deserialize, Serialize};

/// Which search an ascent belonged to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// The goal's programme itself.
    Goal,
    /// The dominance that decides whether a stable interior exists.
    Dominance,
    /// The least or greatest height a top's centre can have.
    HeightRange,
    /// A top with its centre at this height.
    AtHeight {
        /// The height, mm.
        height_mm: f64,
    },
    /// A top with its centre at this height and of this lever.
    AtLever {
        /// The height, mm.
        height_mm: f64,
        /// Volume times the height of the centre, mm⁴.
        lever_mm4: f64,
    },
    /// The proof that no other height is better, for heights about this one.
    Cover {
        /// The middle of the heights covered, mm.
        height_mm: f64,
    },
}

/// One ascent, in the solver's own units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LogRow {
    /// What it was for.
    pub stage: Stage,
    /// Passes over the columns.
    pub passes: usize,
    /// The ratio its interior reaches.
    pub value: f64,
    /// The ratio no interior beats.
    pub bound: f64,
    /// How far the constraints are from met.
    pub residual: f64,
}

/// How far a search had come after a pass over the columns: what the interior at hand reaches, and
/// what no interior beats. The interior at hand meets the constraints at the end of the search
/// only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pass {
    /// What is reached.
    pub value: f64,
    /// What no interior can beat.
    pub bound: f64,
}

impl Pass {
    /// The pass with both numbers changed.
    pub(crate) fn map(self, change: impl Fn(f64) -> f64) -> Self {
        Self {
            value: change(self.value),
            bound: change(self.bound),
        }
    }

    /// Whether it is of use to look at.
    pub(crate) fn is_finite(&self) -> bool {
        self.value.is_finite() && self.bound.is_finite()
    }
}
