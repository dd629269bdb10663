//! The workspace of one run: the reachable set, the settings, the stop signal and the log.

use std::cell::RefCell;

use super::ascent::{
    Budget, COLD_DAMPING, Climb, End, SCOUTED_DAMPING, WARM_DAMPING, climb, prove_infeasible,
};
use super::programme::{DualPoint, Programme};
use super::prudence::{MENDED_TOLERANCE, Prudence, ROUGH_TOLERANCE};
use super::reach::{Heavy, Reach};
use super::units::Scale;
use super::visit::{Slack, Visit};
use crate::base::watch::Watch;
use crate::goal::Goal;
use crate::hollow::log::{LogRow, Stage};
use crate::hollow::problem::{Problem, Settings};

/// The state that all searches of one run share.
pub(crate) struct Work<'a> {
    pub goal: &'a Goal,
    pub reach: Reach<'a>,
    pub settings: &'a Settings,
    pub watch: &'a Watch,
    first_damping: f64,
    /// Finest tolerance of the ascents.
    pub tolerance: f64,
    /// Share of the margins found here that is claimed; `None` if all of it is.
    pub prudence: Option<Prudence>,
    log: RefCell<Vec<LogRow>>,
}

/// The target of one ascent.
struct Aim {
    tolerance: f64,
    slack: Option<Slack>,
    damping: f64,
}

impl<'a> Work<'a> {
    pub fn new(problem: &Problem<'a>, settings: &'a Settings, watch: &'a Watch) -> Self {
        // The scale is the solid's own, so that dual points stay valid when `fixed` is corrected.
        let scale = Scale::of(&problem.goal.solid);
        let reach = Reach::new(problem.columns, &problem.fixed, scale);
        let first_damping = COLD_DAMPING;
        let (tolerance, prudence, log) = (settings.tolerance, None, RefCell::default());
        Self {
            goal: problem.goal,
            reach,
            settings,
            watch,
            first_damping,
            tolerance,
            prudence,
            log,
        }
    }

    /// Returns a workspace for the same goal on thinned columns.
    pub fn on_thinned(&self, reach: Reach<'a>) -> Self {
        let Self {
            goal,
            settings,
            watch,
            first_damping,
            ..
        } = *self;
        let (tolerance, prudence) = (
            self.tolerance.max(ROUGH_TOLERANCE),
            Some(Prudence::default()),
        );
        Self {
            goal,
            reach,
            settings,
            watch,
            first_damping,
            tolerance,
            prudence,
            log: RefCell::default(),
        }
    }

    /// Takes the columns as given in model coordinates.
    pub fn on_model_columns(self) -> Self {
        let reach = self.reach.of_model_columns(&self.goal.frame);
        Self { reach, ..self }
    }

    /// Adds a heavy material.
    pub fn with_heavy(self, heavy: Heavy) -> Self {
        let reach = self.reach.with_heavy(heavy);
        Self { reach, ..self }
    }

    /// Mends the thinned columns so that they agree with all columns at an evaluated point.
    pub fn mend_at(self, visit: &Visit) -> Self {
        let reach = self.reach.mend_at(&visit.quadric, &visit.extreme);
        Self {
            reach,
            tolerance: self.settings.tolerance.max(MENDED_TOLERANCE),
            ..self
        }
    }

    /// Doubles the part of the margins that is not claimed.
    pub fn with_double_prudence(self) -> Self {
        let prudence = self.prudence.map(Prudence::doubled);
        Self { prudence, ..self }
    }

    /// Starts ascents with the damping for a point near the answer.
    pub fn for_warm_start(self) -> Self {
        Self {
            first_damping: WARM_DAMPING,
            ..self
        }
    }

    /// Climbs to the settings' tolerance, or to a looser one, and logs the ascent.
    pub fn climb(&self, programme: &Programme, start: DualPoint, tolerance: f64) -> Climb {
        self.climb_within(
            programme,
            start,
            Aim {
                tolerance,
                slack: None,
                damping: self.first_damping,
            },
        )
    }

    /// Climbs from an evaluated point that a scout found.
    pub fn climb_from(&self, programme: &Programme, visit: Visit) -> Climb {
        self.climb_on(
            programme,
            visit,
            Aim {
                tolerance: 0.0,
                slack: None,
                damping: SCOUTED_DAMPING,
            },
        )
    }

    /// Climbs until the bound is good enough, whatever the residual.
    pub fn climb_to_bound(&self, programme: &Programme, start: DualPoint, slack: Slack) -> Climb {
        let aim = Aim {
            tolerance: 0.0,
            slack: Some(slack),
            damping: self.first_damping,
        };
        self.climb_within(programme, start, aim)
    }

    fn climb_within(&self, programme: &Programme, start: DualPoint, aim: Aim) -> Climb {
        let visit = self.evaluate(programme, start);
        self.climb_on(programme, visit, aim)
    }

    /// Climbs from the point evaluated last, and replaces its row in the log by that of the ascent.
    fn climb_on(&self, programme: &Programme, visit: Visit, aim: Aim) -> Climb {
        let before = self.reach.passes();
        let climb = climb(&self.reach, programme, visit, self.budget(aim));
        self.log.borrow_mut().pop();
        self.log_ascent(
            programme.stage,
            1 + self.reach.passes() - before,
            &climb.best,
        );
        climb
    }

    /// Returns the bound that a dual point proves without a heavy material; one cheaper pass.
    pub fn bound_at(&self, programme: &Programme, point: &DualPoint) -> f64 {
        let direction = programme.quadric(point);
        let dual = direction.dot(&self.reach.least(&direction)) - programme.rhs.dot(&point.lambda);
        programme.bound(point.tau, dual)
    }

    fn budget(&self, aim: Aim) -> Budget<'a> {
        Budget {
            tolerance: aim.tolerance.max(self.tolerance),
            slack: aim.slack,
            passes: self.settings.passes_per_ascent,
            first_damping: aim.damping,
            watch: self.watch,
        }
    }

    /// Climbs to a proof that no interior meets the rows, from the multipliers of a scout's proof.
    /// `None` if there is none near.
    pub fn prove_infeasible(&self, programme: &Programme, start: DualPoint) -> Option<Climb> {
        let before = self.reach.passes();
        let aim = Aim {
            tolerance: 0.0,
            slack: None,
            damping: SCOUTED_DAMPING,
        };
        let proof = prove_infeasible(&self.reach, programme, start, self.budget(aim))?;
        self.log_ascent(programme.stage, self.reach.passes() - before, &proof.best);
        Some(proof)
    }

    /// Evaluates a dual point; one pass.
    pub fn evaluate(&self, programme: &Programme, point: DualPoint) -> Visit {
        let visit = Visit::new(&self.reach, programme, point);
        self.log_ascent(programme.stage, 1, &visit);
        visit
    }

    /// Logs a post that was checked on all columns, and the margin to spare.
    pub fn log_post(&self, at: f64, margin: f64, spare: f64) {
        let stage = Stage::Cover {
            height_mm: self.to_mm(at),
        };
        let (value, bound) = (margin + spare, margin);
        self.log.borrow_mut().push(LogRow {
            stage,
            passes: 1,
            value,
            bound,
            residual: 0.0,
        });
    }

    fn log_ascent(&self, stage: Stage, passes: usize, best: &Visit) {
        let (value, bound, residual) = (best.value, best.bound, best.residual());
        self.log.borrow_mut().push(LogRow {
            stage,
            passes,
            value,
            bound,
            residual,
        });
    }

    /// Climbs from a known dual point; `None` if cancelled or if the rows cannot be met.
    pub fn climb_near(
        &self,
        programme: &Programme,
        near: Option<&DualPoint>,
        tolerance: f64,
    ) -> Option<Climb> {
        let climb = self.climb(
            programme,
            programme.start_near(&self.reach, near),
            tolerance,
        );
        (!matches!(climb.end, End::Infeasible(_) | End::Cancelled)).then_some(climb)
    }

    /// Returns true if an ascent is accurate enough to stand as an answer.
    pub fn accepts(&self, climb: &Climb) -> bool {
        !matches!(climb.end, End::Infeasible(_))
            && climb.best.residual() <= self.settings.accepted_residual
            && climb.best.gap_ratio().abs() <= self.settings.accepted_gap_ratio
    }

    /// Converts a height from the solver's units to mm.
    pub fn to_mm(&self, height: f64) -> f64 {
        height * self.reach.scale.length_mm
    }

    pub fn into_log(self) -> Vec<LogRow> {
        self.log.into_inner()
    }
}
