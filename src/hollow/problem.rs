//! What is to be solved: a goal, what is fixed, and what may be emptied.

use crate::goal::Goal;
use crate::interior::Columns;
use crate::mass::Moments;

/// A goal on an interior.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// What the object shall do.
    pub goal: &'a Goal,
    /// The moments with nothing emptied, goal frame, mm: the solid's ([`Goal::solid`]), plus
    /// whatever the printed object differs by (THEORY §4, defect correction).
    pub fixed: Moments,
    /// What may be emptied, goal frame.
    pub columns: &'a Columns,
}

/// How exact the answer shall be, and what it may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The gap (as a part of the value) and the residual of the constraints (in the solver's
    /// normalised units) at which an ascent is finished. Above 1e-7 the centre of mass strays by
    /// micrometres; below 1e-12 rounding stalls it.
    pub tolerance: f64,
    /// The gap at which an unfinished ascent still counts as solved.
    pub accepted_gap_ratio: f64,
    /// The residual at which an unfinished ascent still counts as solved.
    pub accepted_residual: f64,
    /// The passes over the columns one ascent may take; a cold start takes about 15.
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
