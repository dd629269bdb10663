//! One run's bench: the reachable set, the settings, the caller's wishes and the log.

use std::cell::RefCell;

use super::ascent::{
    Budget, COLD_DAMPING, Climb, End, SCOUTED_DAMPING, WARM_DAMPING, climb, refusal,
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

/// What every search of one run shares.
pub(crate) struct Work<'a> {
    pub goal: &'a Goal,
    pub reach: Reach<'a>,
    pub settings: &'a Settings,
    watch: &'a Watch,
    first_damping: f64,
    /// How exact ascents are at most.
    pub tolerance: f64,
    /// How much of the margins found here is claimed; none where all of it is.
    pub prudence: Option<Prudence>,
    log: RefCell<Vec<LogRow>>,
}

/// What one ascent is to reach.
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

    /// A bench like this with thinned columns.
    pub fn thinned(&self, reach: Reach<'a>) -> Self {
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

    /// The same bench, its thinned columns mended by what all of them have at the point of a visit.
    pub fn mended(self, visit: &Visit) -> Self {
        let reach = self.reach.mended(&visit.quadric, &visit.extreme);
        Self {
            reach,
            tolerance: self.settings.tolerance.max(MENDED_TOLERANCE),
            ..self
        }
    }

    /// The same bench claiming less of what it sees.
    pub fn doubly_prudent(self) -> Self {
        let prudence = self.prudence.map(Prudence::doubled);
        Self { prudence, ..self }
    }

    /// The same bench for a search that starts near its answer.
    pub fn warmed(self) -> Self {
        Self {
            first_damping: WARM_DAMPING,
            ..self
        }
    }

    /// Climbs to the settings' tolerance, or to a looser one, and logs how it went.
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

    /// The same from a visit to where a scout has been.
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

    /// The same until the bound is good enough, whatever the constraints are missed by.
    pub fn climb_to_bound(&self, programme: &Programme, start: DualPoint, slack: Slack) -> Climb {
        let aim = Aim {
            tolerance: 0.0,
            slack: Some(slack),
            damping: self.first_damping,
        };
        self.climb_within(programme, start, aim)
    }

    fn climb_within(&self, programme: &Programme, start: DualPoint, aim: Aim) -> Climb {
        let visit = self.look(programme, start);
        self.climb_on(programme, visit, aim)
    }

    /// Climbs from a visit that is the last in the log, and logs how it went instead.
    fn climb_on(&self, programme: &Programme, visit: Visit, aim: Aim) -> Climb {
        let before = self.reach.passes();
        let climb = climb(&self.reach, programme, visit, self.budget(aim));
        self.log.borrow_mut().pop();
        self.note(
            programme.stage,
            1 + self.reach.passes() - before,
            &climb.best,
        );
        climb
    }

    /// The bound that a dual point proves, where there is no heavy material; one cheaper pass.
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

    /// The proof that no interior meets the rows, if there is one near the multipliers with which a
    /// scout found its own.
    pub fn refusal(&self, programme: &Programme, seen: DualPoint) -> Option<Climb> {
        let before = self.reach.passes();
        let aim = Aim {
            tolerance: 0.0,
            slack: None,
            damping: SCOUTED_DAMPING,
        };
        let proof = refusal(&self.reach, programme, seen, self.budget(aim))?;
        self.note(programme.stage, self.reach.passes() - before, &proof.best);
        Some(proof)
    }

    /// One pass at a dual point.
    pub fn look(&self, programme: &Programme, point: DualPoint) -> Visit {
        let visit = Visit::new(&self.reach, programme, point);
        self.note(programme.stage, 1, &visit);
        visit
    }

    /// Logs a post that was held against all columns, and what was to spare.
    pub fn note_post(&self, at: f64, margin: f64, spare: f64) {
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

    fn note(&self, stage: Stage, passes: usize, best: &Visit) {
        let (value, bound, residual) = (best.value, best.bound, best.residual());
        self.log.borrow_mut().push(LogRow {
            stage,
            passes,
            value,
            bound,
            residual,
        });
    }

    /// The same from a near dual point; none where it was stopped or the rows cannot be met.
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
