//! The optimal void on the printer's columns.

use super::Placed;
use crate::ballast::Load;
use crate::base::watch::Watch;
use crate::field::Clamped;
use crate::hollow::{Problem, Proof, Solution, TopCourse};
use crate::interior::Columns;
use crate::mass::Moments;

/// The optimal void on the finest columns, and the ballast beside it.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The ballast that is laid in.
    pub load: Load,
    /// Moments of the solid with ballast and hardware and without any void, goal frame.
    pub fixed: Moments,
    /// The finest columns.
    pub columns: Columns,
    /// The solution on them.
    pub solution: Solution,
    /// The proof for other heights of a top's centre, on the finest columns that it was made on.
    pub height_proof: Option<HeightProof>,
    /// The proof that no void within the wall is better; `None` beside ballast, with filled voids,
    /// and if none was made.
    pub proof: Option<Proof>,
    /// The course of the answer on the coarsest columns: the ascent from nothing, and for tops the
    /// speed by height.
    pub course: TopCourse,
    /// The answer on coarser columns, for a search among plans; `None` if the finest are few.
    pub coarse: Option<Box<Solved>>,
}

/// A bound on the critical speed of tops with their centre of mass at any other height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightProof {
    /// Pitch of the columns that it was made on, mm.
    pub pitch_mm: f64,
    /// The value reached there.
    pub value: f64,
    /// The bound for all other heights.
    pub bound: f64,
}

impl Placed {
    /// Solves on some columns, with these moments of the solid without any void (goal frame).
    ///
    /// A `known` solution of coarser columns, or of nearly the same problem, saves most of the
    /// passes. A cancelled solve ends with a solution that is not usable.
    pub fn solve(
        &self,
        columns: &Columns,
        fixed: Moments,
        known: Option<&Solution>,
        watch: &Watch,
    ) -> Solution {
        let problem = Problem {
            goal: self.goal(),
            fixed,
            columns,
        };
        let sparse = self.sparse.as_ref();
        let near = sparse.and_then(|nested| nested.near.as_ref());
        let field = sparse.and_then(|nested| nested.field.as_ref());
        match (near, field) {
            (Some(near), Some(field)) => field.solve(near, &problem, known, watch),
            (Some(near), None) => near.solve(&problem, known, watch),
            (None, _) => self.fill.solve(&problem, known, &watch.muted()),
        }
    }

    /// Returns the moments of the body with what a solution empties or fills; `fixed` are those of
    /// the solid without any void (goal frame).
    pub fn filled(&self, fixed: Moments, columns: &Columns, solution: &Solution) -> Moments {
        match &self.sparse {
            Some(nested) => nested.filled(fixed, columns, &solution.quadric),
            None => self.fill.filled(fixed, columns, &solution.quadric),
        }
    }
}

impl Solved {
    /// Solves again on the same columns, with other moments of the solid without any void.
    pub fn solve_again(&self, placed: &Placed, fixed: Moments, watch: &Watch) -> Solution {
        placed.solve(&self.columns, fixed, Some(&self.solution), watch)
    }

    /// Returns the density without steps that does what the regions of the solution do, goal frame;
    /// `None` unless they are near a wished infill.
    pub fn smooth(&self, placed: &Placed) -> Option<Clamped> {
        let sparse = placed.sparse.as_ref();
        let sparse = sparse.filter(|nested| nested.field.is_none())?;
        let problem = Problem {
            goal: placed.goal(),
            fixed: self.fixed,
            columns: &self.columns,
        };
        sparse.near.as_ref()?.smooth(&problem, &self.solution)
    }
}
