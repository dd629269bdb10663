//! The dual ascent: a damped Newton method that raises the bound and the trial ratio together.

use nalgebra::DVector;

use super::programme::{DualPoint, Programme};
use super::reach::Reach;
use super::step::{Step, StepControl};
use super::visit::{Slack, Visit};
use crate::base::watch::Watch;
use crate::hollow::log::Pass;

/// First damping of a cold start, as a part of the mean curvature. With a tenth of it the first
/// steps overshoot to where the model is worthless. Ten times more costs one extra pass per ascent.
pub(crate) const COLD_DAMPING: f64 = 1e-2;
/// First damping near a known answer, where the model is good. A hundred times more costs one extra
/// pass per ascent.
pub(crate) const WARM_DAMPING: f64 = 1e-4;
/// First damping after a scout's search, where the model is nearly exact.
pub(crate) const SCOUTED_DAMPING: f64 = 1e-7;
/// Multiple of the ratio beyond which multipliers suggest that no interior meets the rows.
const SUSPICIOUS_MULTIPLIER: f64 = 20.0;

/// Relative accuracy of the least residual of rows that cannot be met; any positive bound is a
/// proof.
const PROOF_TOLERANCE: f64 = 1e-3;

/// The reason an ascent ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum End {
    /// Residual and gap are within the tolerance.
    Converged,
    /// No step gains any more.
    Stalled,
    /// The rows cannot be met; the least residual, in the solver's units.
    Infeasible(f64),
    /// The passes are used up.
    PassLimit,
    /// The caller cancelled.
    Cancelled,
}

/// The result of an ascent.
#[derive(Debug, Clone)]
pub(crate) struct Climb {
    pub best: Visit,
    pub end: End,
    /// Value and bound of every accepted point; the last is `best`.
    pub course: Vec<Pass>,
}

impl Climb {
    /// Returns a result of no steps, at a dual point that was only evaluated.
    pub fn of(visit: Visit) -> Self {
        Self {
            course: vec![visit.pass()],
            best: visit,
            end: End::Stalled,
        }
    }

    /// Puts the passes made before this ascent at the head of its record.
    pub fn after(mut self, course: &[Pass]) -> Self {
        self.course.splice(0..0, course.iter().copied());
        self
    }
}

/// The tolerance, cost limit and stop signal of an ascent.
#[derive(Clone, Copy)]
pub(crate) struct Budget<'a> {
    pub tolerance: f64,
    /// Criterion for a bound that is good enough whatever the tolerance; `None` if only the
    /// tolerance counts.
    pub slack: Option<Slack>,
    pub passes: usize,
    pub first_damping: f64,
    pub watch: &'a Watch,
}

/// Climbs from an evaluated point until residual and gap are within the budget's tolerance.
///
/// D(y, λ, τ) = min_K g·s is concave. The set {D ≥ 0} is convex, and its greatest τ is the optimum.
/// Each pass gives D, its gradient and its curvature. Each step maximises the damped quadratic
/// model over y ∈ Y and all λ, and moves τ to where D vanishes. Near the optimum convergence is
/// quadratic. Damping follows Levenberg and Marquardt.
///
/// Source: Dinkelbach, "On nonlinear fractional programming", Management Science 13, 1967.
pub(crate) fn climb(reach: &Reach, programme: &Programme, start: Visit, budget: Budget) -> Climb {
    let last_pass = reach.passes() + budget.passes.saturating_sub(1);
    let mut here = start;
    let mut control = StepControl::first(programme, budget.first_damping);
    let mut course = vec![here.pass()];
    loop {
        let done = |end| Climb {
            best: here.clone(),
            end,
            course: course.clone(),
        };
        if here.is_within(budget.tolerance) {
            return done(End::Converged);
        }
        if budget.watch.check().is_err() {
            return done(End::Cancelled);
        }
        if reach.passes() >= last_pass {
            return done(End::PassLimit);
        }
        if control.is_exhausted() {
            return done(End::Stalled);
        }
        let mut step = Step::from(&here, programme, &control);
        let is_settled = control.must_move_ratio(&here, &step, programme);
        if is_settled {
            control = StepControl::first(programme, budget.first_damping);
            step = Step::from(&here, programme, &control);
        }
        if budget
            .slack
            .is_some_and(|slack| here.suffices(step.gain(), slack))
        {
            return done(End::Converged);
        }
        let there = Visit::new(reach, programme, step.to.clone());
        if is_settled || control.judge(&here, &there, &step, programme.is_ratio()) {
            here = there;
            course.push(here.pass());
            if reach.is_free()
                && is_suspicious(&here, programme)
                && let Some(proof) = prove_separation(reach, programme, &here, budget)
            {
                return proof;
            }
        }
    }
}

fn is_suspicious(visit: &Visit, programme: &Programme) -> bool {
    let multipliers = visit.point.lambda.norm();
    programme.is_homogeneous()
        && multipliers > SUSPICIOUS_MULTIPLIER * (1.0 + visit.point.tau.abs())
}

/// Returns the proof that no interior meets the rows, if the multipliers alone give D > 0.
fn prove_separation(
    reach: &Reach,
    programme: &Programme,
    visit: &Visit,
    budget: Budget,
) -> Option<Climb> {
    let direction = visit.point.lambda.normalize();
    let feasibility = programme.feasibility();
    let start = DualPoint {
        y: direction,
        lambda: DVector::zeros(0),
        tau: 0.0,
    };
    if feasibility
        .quadric(&start)
        .dot(&reach.least(&feasibility.quadric(&start)))
        <= 0.0
    {
        return None;
    }
    prove_infeasible(reach, programme, start, budget)
}

/// Climbs to a proof that no interior meets the rows; `None` if there is none.
///
/// `start` holds multipliers of the rows as the weights of [`Programme::feasibility`].
pub(crate) fn prove_infeasible(
    reach: &Reach,
    programme: &Programme,
    start: DualPoint,
    budget: Budget,
) -> Option<Climb> {
    let feasibility = programme.feasibility();
    let start = Visit::new(reach, &feasibility, start);
    let proof = climb(
        reach,
        &feasibility,
        start,
        Budget {
            tolerance: PROOF_TOLERANCE,
            slack: None,
            ..budget
        },
    );
    let end = End::Infeasible(proof.best.bound);
    (proof.best.bound > 0.0).then_some(Climb { end, ..proof })
}

#[cfg(test)]
mod tests {
    use super::super::units::Scale;
    use super::*;
    use crate::goal::Objective;
    use crate::hollow::worlds;

    /// Returns a dual point of the egg's dominance at which no column's ends lie on the quadric.
    fn world_and_point() -> (worlds::World, DualPoint) {
        let point = DualPoint {
            y: DVector::from_vec(vec![0.3, -0.2]),
            lambda: DVector::from_vec(vec![0.05, -0.07, 0.3, 0.2, 0.11]),
            tau: 0.9,
        };
        (worlds::egg(Objective::Dominance), point)
    }

    #[test]
    fn the_slope_and_curvature_of_the_dual_are_those_of_finite_differences() {
        let (world, point) = world_and_point();
        let reach = Reach::new(&world.columns, &world.fixed, Scale::of(&world.fixed));
        let programme = Programme::yoyo_dominance(&reach);
        let here = Visit::new(&reach, &programme, point.clone());
        let curvature = &programme.rows * here.extreme.w * programme.rows.transpose();
        for row in 0..5 {
            // Central differences: the slope's error is 1e-8 of the curvature's change, far below
            // 1e-6.
            let step = 1e-4;
            let at = |shift: f64| {
                let mut moved = point.clone();
                moved.lambda[row] += shift;
                Visit::new(&reach, &programme, moved)
            };
            let (more, less) = (at(step), at(-step));
            let slope = (more.dual - less.dual) / (2.0 * step);
            assert!(
                (slope - here.misses[row]).abs() < 1e-6,
                "{row}: {slope} {}",
                here.misses[row]
            );
            // The curvature is a sum over 2 000 columns, of which a few cross their ends within the
            // step.
            let bend = (&more.misses - &less.misses) / (-2.0 * step);
            let error = (bend - curvature.column(row)).amax();
            assert!(error < 2e-2 * curvature.amax(), "{row}: {error}");
        }
    }

    #[test]
    fn a_bound_never_exceeds_the_optimum_wherever_the_dual_is_asked() {
        let (world, point) = world_and_point();
        let reach = Reach::new(&world.columns, &world.fixed, Scale::of(&world.fixed));
        let programme = Programme::yoyo_dominance(&reach);
        let watch = Watch::silent();
        let budget = Budget {
            tolerance: 1e-9,
            slack: None,
            passes: 60,
            first_damping: COLD_DAMPING,
            watch: &watch,
        };
        let start = Visit::new(&reach, &programme, programme.cold_start(&reach));
        let best = climb(&reach, &programme, start, budget);
        assert_eq!(best.end, End::Converged);
        for i in 0..60 {
            let mut other = point.clone();
            other.lambda *= f64::from(i) * 0.05;
            other.tau = 0.4 + 0.02 * f64::from(i);
            assert!(
                Visit::new(&reach, &programme, other).bound <= best.best.value + 1e-8,
                "{i}"
            );
        }
    }
}
