//! The problem to solve, and the solver's settings.

use crate::goal::Goal;
use crate::interior::Columns;
use crate::mass::Moments;

/// A goal, the moments of the solid body, and the region that may be emptied.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// The goal for the object.
    pub goal: &'a Goal,
    /// Moments with nothing emptied, goal frame, mm.
    ///
    /// These are the solid's ([`Goal::solid`]) plus the measured difference of the printed object
    /// (defect correction, [theory §10](crate::guide::theory#10-from-the-solution-to-the-print)).
    pub fixed: Moments,
    /// Region that may be emptied, goal frame.
    pub columns: &'a Columns,
}

/// Accuracy and cost limits of the solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Gap (as a part of the value) and constraint residual (in the solver's normalised units) at
    /// which an ascent ends. Above 1e-7 the centre of mass strays by micrometres. Below 1e-12
    /// rounding stalls the ascent.
    pub tolerance: f64,
    /// Gap at which an unfinished ascent still counts as solved.
    pub accepted_gap_ratio: f64,
    /// Residual at which an unfinished ascent still counts as solved.
    pub accepted_residual: f64,
    /// Passes over the columns allowed per ascent; a cold start takes about 15.
    pub passes_per_ascent: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-9,
            accepted_gap_ratio: 1e-6,
            accepted_residual: 1e-7,
            passes_per_ascent: 60,
        }
    }
}
