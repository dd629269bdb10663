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
