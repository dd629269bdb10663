//! The ground every search walks on: one model, sampled once, tried at any wall, contact and axis.

use super::Case;
use crate::goal::{Placement, Request, Warning, place};
use crate::hollow::{Problem, Settings, Solution, solve, solve_on_model_columns};
use crate::interior::{Columns, Depths};
use crate::progress::Progress;
use crate::shell::Shell;

/// Samples of the depth that a search aims by. A third of them, and what is found strays by some per cent from what is
/// confirmed; three times as many cost as much more a trial and are no nearer than the confirming solve asks for.
pub(super) const FINE_SAMPLES: usize = 40_000;
/// Samples for a first look at many axes.
pub(super) const COARSE_SAMPLES: usize = 8_000;
/// Columns a side of the confirming solve. A run proves on four times as many that a goal is impossible; at 100 an answer
/// at the very border may be another than there, at 400 the advice on a large mesh takes three times as long.
pub(super) const CONFIRMING_COLUMNS: usize = 200;

/// A model whose depths are known.
pub(super) struct Ground<'a> {
    pub case: Case<'a>,
    depths: Depths,
}

/// What the solver says of a request.
#[derive(Debug, Clone)]
pub(super) struct Trial {
    pub placement: Placement,
    pub solution: Solution,
    /// How many columns it was solved on.
    pub columns: usize,
}

impl Trial {
    /// Whether there is an interior that does what is asked.
    pub fn is_possible(&self) -> bool {
        self.solution.is_usable()
    }

    /// Whether the spin axis passes through the model above its contact; no advice leads beside it.
    pub fn meets_the_model(&self) -> bool {
        !self.placement.warnings.contains(&Warning::AxisMissesModel)
    }
}

impl<'a> Ground<'a> {
    pub fn new(case: Case<'a>, samples: usize) -> Self {
        Self { depths: Depths::of_solid(case.solid, samples), case }
    }

    /// What the solver says on the sampled depths; none where the request cannot be placed.
    pub fn trial(&self, request: &Request, wall_mm: f64) -> Option<Trial> {
        let placement = place(self.case.solid, wall_mm, request).ok()?;
        let columns = self.depths.columns(wall_mm, &placement.keeps);
        let problem = problem(&placement, &columns);
        let solution = solve_on_model_columns(&problem, &Settings::default(), &Progress::silent());
        Some(Trial { columns: columns.len(), placement, solution })
    }

    /// Whether the sampled depths allow it.
    pub fn allows(&self, request: &Request, wall_mm: f64) -> bool {
        self.trial(request, wall_mm).is_some_and(|trial| trial.is_possible())
    }

    /// The same question put to exact columns, with nothing known from before; none unless the answer is yes.
    pub fn confirmed(&self, request: &Request, wall_mm: f64) -> Option<Trial> {
        let (placement, columns) = self.exact(request, wall_mm, CONFIRMING_COLUMNS)?;
        let solution = solve(&problem(&placement, &columns), &Settings::default(), &Progress::silent());
        let trial = Trial { columns: columns.len(), placement, solution };
        trial.is_possible().then_some(trial)
    }

    /// A request placed, with the exact columns of what may then be emptied, so many along the longer side.
    pub fn exact(
        &self,
        request: &Request,
        wall_mm: f64,
        columns_a_side: usize,
    ) -> Option<(Placement, Columns)> {
        let placement = place(self.case.solid, wall_mm, request).ok()?;
        let shell = Shell::new(self.case.solid, &placement.goal.frame, wall_mm, &placement.keeps).ok()?;
        let pitch_mm = shell.coarse_pitch(columns_a_side);
        let columns = Columns::of_shell(&shell, pitch_mm, &Progress::silent()).ok()?;
        Some((placement, columns))
    }
}

/// The plain question: what of these columns is to be emptied for the goal.
pub(super) fn problem<'p>(placement: &'p Placement, columns: &'p Columns) -> Problem<'p> {
    Problem { goal: &placement.goal, fixed: placement.goal.solid, columns }
}
