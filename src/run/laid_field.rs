//! The field of densities that is laid in nested regions.

use crate::base::watch::Watch;
use crate::geom::Frame;
use crate::hollow::{DrawnField, NearWished, PrintField, Problem, Solution};

/// A field that is laid in nested regions of one density each.
#[derive(Debug, Clone, PartialEq)]
pub enum LaidField {
    /// A ramp, a wave or a uniform density: its regions are those of a quadric.
    Shaped(PrintField),
    /// Any other: its regions are bodies.
    Drawn(DrawnField),
}

impl LaidField {
    /// Returns true if it was given by its numbers, which stay.
    pub fn is_given(&self) -> bool {
        match self {
            Self::Shaped(field) => field.is_given,
            Self::Drawn(_) => true,
        }
    }

    /// Fits the field on some columns, or takes it as it is given.
    #[must_use]
    pub fn solve(
        &self,
        near: &NearWished,
        problem: &Problem,
        known: Option<&Solution>,
        watch: &Watch,
    ) -> Solution {
        match self {
            Self::Shaped(field) => field.solve(near, problem, known, watch),
            Self::Drawn(field) => field.solve(near, problem, known, watch),
        }
    }

    /// Returns the words for the field of a solution, in the model's coordinates, as they can be
    /// typed. `frame` is the goal's.
    pub fn words(&self, solution: &Solution, frame: &Frame) -> String {
        match self {
            Self::Shaped(field) => field.words(solution, frame),
            Self::Drawn(field) => field.words().to_owned(),
        }
    }
}
