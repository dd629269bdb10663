//! One run's bench: the reachable set, the settings, the caller's wishes and the log.

use std::cell::RefCell;

use super::ascent::{Budget, COLD_DAMPING, Climb, End, Slack, WARM_DAMPING, climb};
use super::problem::Problem;
use super::programme::{DualPoint, Programme};
use super::reach::{Heavy, Reach, Scale};
use super::settings::Settings;
use super::solution::LogRow;
use crate::goal::Goal;
use crate::progress::Progress;

/// What every search of one run shares.
pub(super) struct Work<'a> {
    pub goal: &'a Goal,
    pub reach: Reach<'a>,
    pub settings: &'a Settings,
    progress: &'a Progress<'a>,
    first_damping: f64,
    log: RefCell<Vec<LogRow>>,
}

impl<'a> Work<'a> {
    pub fn new(problem: &Problem<'a>, settings: &'a Settings, progress: &'a Progress<'a>) -> Self {
        // The scale is the solid's own, so that dual points stay valid when `fixed` is corrected.
        let scale = Scale::of(&problem.goal.solid);
        let reach = Reach::new(problem.columns, &problem.fixed, scale);
        let first_damping = COLD_DAMPING;
        Self { goal: problem.goal, reach, settings, progress, first_damping, log: RefCell::default() }
    }

    /// The same bench, its columns given in model coordinates.
    pub fn on_model_columns(self) -> Self {
        let reach = self.reach.of_model_columns(&self.goal.frame);
        Self { reach, ..self }
    }

    /// The same bench with a heavy material to be had.
    pub fn with(self, heavy: Heavy) -> Self {
        let reach = self.reach.with(heavy);
        Self { reach, ..self }
    }

    /// The same bench for a search that starts near its answer.
    pub fn warmed(self) -> Self {
        Self { first_damping: WARM_DAMPING, ..self }
    }

    /// Climbs to the settings' tolerance, or to a looser one, and logs how it went.
    pub fn climb(&self, programme: &Programme, start: DualPoint, tolerance: f64) -> Climb {
        self.climb_within(programme, start, (tolerance, None))
    }

    /// The same until the bound is good enough, whatever the constraints are missed by.
    pub fn climb_to_bound(&self, programme: &Programme, start: DualPoint, slack: Slack) -> Climb {
        self.climb_within(programme, start, (0.0, Some(slack)))
    }

    fn climb_within(
        &self,
        programme: &Programme,
        start: DualPoint,
        (tolerance, slack): (f64, Option<Slack>),
    ) -> Climb {
        let before = self.reach.passes();
        let budget = Budget {
            tolerance: tolerance.max(self.settings.tolerance),
            slack,
            passes: self.settings.passes_per_ascent,
            first_damping: self.first_damping,
            progress: self.progress,
        };
        let climb = climb(&self.reach, programme, start, budget);
        self.log.borrow_mut().push(LogRow {
            stage: programme.stage,
            passes: self.reach.passes() - before,
            value: climb.best.value,
            bound: climb.best.bound,
            residual: climb.best.residual(),
        });
        climb
    }

    /// The same from a near dual point; none where it was stopped or the rows cannot be met.
    pub fn climb_near(
        &self,
        programme: &Programme,
        near: Option<&DualPoint>,
        tolerance: f64,
    ) -> Option<Climb> {
        let climb = self.climb(programme, programme.start_near(&self.reach, near), tolerance);
        (!matches!(climb.end, End::Infeasible(_) | End::Cancelled)).then_some(climb)
    }

    /// Whether an ascent is good enough to stand as an answer.
    pub fn accepts(&self, climb: &Climb) -> bool {
        !matches!(climb.end, End::Infeasible(_))
            && climb.best.residual() <= self.settings.accepted_residual
            && climb.best.gap_ratio().abs() <= self.settings.accepted_gap_ratio
    }

    /// A height in the solver's units, in mm.
    pub fn to_mm(&self, height: f64) -> f64 {
        height * self.reach.scale.length_mm
    }

    pub fn into_log(self) -> Vec<LogRow> {
        self.log.into_inner()
    }
}
