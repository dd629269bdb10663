//! The ground every search walks on: one model, sampled once, tried at any wall, contact and axis.

use super::Case;
use super::reached::Reached;
use crate::base::watch::Watch;
use crate::goal::{
    Hydrostatics, Placement, Request, Stock, Warning, Waterline, Weighed, place_weighed,
};
use crate::hollow::{Problem, Settings, Solution, solve, solve_on_model_columns};
use crate::interior::{Columns, Depths};
use crate::mass::moments_of_mesh;
use crate::shell::Shell;

/// Samples of the depth that a search aims by. A third of them, and what is found strays by some
/// per cent from what is confirmed; three times as many cost as much more a trial and are no nearer
/// than the confirming solve asks for.
pub(super) const FINE_SAMPLES: usize = 40_000;
/// Samples for a first look at many axes.
pub(super) const COARSE_SAMPLES: usize = 8_000;
/// Columns a side of the confirming solve. A run proves on four times as many that a goal is
/// impossible; at 100 an answer at the very border may be another than there, at 400 the advice on
/// a large mesh takes three times as long.
pub(super) const CONFIRMING_COLUMNS: usize = 200;

/// Waterlines that are tried where what floats leaves it free.
const WATERLINES: usize = 12;

/// A model whose depths are known.
pub(super) struct Ground<'a> {
    pub case: Case<'a>,
    weighed: Weighed<'a>,
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
        let weighed = Weighed {
            solid: case.solid,
            moments: moments_of_mesh(case.solid.mesh()),
        };
        Self {
            depths: Depths::of_solid(case.solid, samples),
            weighed,
            case,
        }
    }

    /// What the solver says on the sampled depths; none where the request cannot be placed.
    pub fn trial(&self, request: &Request, wall_mm: f64) -> Option<Trial> {
        let placement = self.placed(request, wall_mm)?;
        let columns = self.depths.columns(wall_mm, &placement.keeps);
        self.best(&placement, &columns, solve_on_model_columns)
    }

    /// Whether the sampled depths allow it.
    pub fn allows(&self, request: &Request, wall_mm: f64) -> bool {
        self.trial(request, wall_mm)
            .is_some_and(|trial| trial.is_possible())
    }

    /// The same question put to exact columns, with nothing known from before; none unless the
    /// answer is yes.
    pub fn confirmed(&self, request: &Request, wall_mm: f64) -> Option<Trial> {
        let (placement, columns) = self.exact(request, wall_mm, CONFIRMING_COLUMNS)?;
        self.best(&placement, &columns, solve)
            .filter(Trial::is_possible)
    }

    /// A request placed, with the exact columns of what may then be emptied, so many along the
    /// longer side.
    pub fn exact(
        &self,
        request: &Request,
        wall_mm: f64,
        columns_a_side: usize,
    ) -> Option<(Placement, Columns)> {
        let placement = self.placed(request, wall_mm)?;
        let shell = Shell::new(
            self.case.solid,
            &placement.goal.frame,
            wall_mm,
            &placement.keeps,
        )
        .ok()?;
        let pitch_mm = shell.coarse_pitch(columns_a_side);
        let columns = Columns::of_shell(&shell, pitch_mm, &Watch::silent()).ok()?;
        Some((placement, columns))
    }

    /// The placement of a request; none where it has none.
    pub fn placed(&self, request: &Request, wall_mm: f64) -> Option<Placement> {
        let stock = Stock {
            wall_mm,
            density_g_cm3: self.case.density_g_cm3,
        };
        place_weighed(&self.weighed, &stock, request).ok()
    }

    /// The placement as it is, or, for what floats at a line that is left free, at several lines
    /// over its height.
    pub fn at_its_lines(&self, placement: &Placement) -> Vec<Placement> {
        let water = self
            .case
            .request
            .water
            .filter(|water| water.waterline == Waterline::Auto);
        let Some(water) = water else {
            return vec![placement.clone()];
        };
        let ratio = water.liquid.density_g_cm3() / self.case.density_g_cm3;
        let hydrostatics = Hydrostatics::new(self.case.solid, &placement.goal.frame, ratio);
        let step_mm = hydrostatics.height_mm() / (WATERLINES + 1) as f64;
        let at = |line: usize| {
            let mut placement = placement.clone();
            placement.goal.afloat = Some(hydrostatics.at(step_mm * line as f64));
            placement
        };
        (1..=WATERLINES).map(at).collect()
    }

    /// The best answer over the lines at which it may float; where none is possible, the first.
    fn best(&self, placement: &Placement, columns: &Columns, ask: Ask) -> Option<Trial> {
        let trials = self.at_its_lines(placement).into_iter().map(|placement| {
            let solution = ask(
                &problem(&placement, columns),
                &Settings::default(),
                &Watch::silent(),
            );
            Trial {
                columns: columns.len(),
                placement,
                solution,
            }
        });
        let worth = |trial: &Trial| {
            if trial.is_possible() {
                Reached::of(trial).score()
            } else {
                f64::INFINITY
            }
        };
        trials.min_by(|a, b| worth(a).total_cmp(&worth(b)))
    }
}

/// A solver: for columns of the model or of the goal.
type Ask = fn(&Problem, &Settings, &Watch) -> Solution;

/// The plain question: what of these columns is to be emptied for the goal.
pub(super) fn problem<'p>(placement: &'p Placement, columns: &'p Columns) -> Problem<'p> {
    Problem {
        goal: &placement.goal,
        fixed: placement.goal.solid,
        columns,
    }
}
