//! The dual ascent: a damped Newton method that raises the bound and the trial ratio together.

use nalgebra::DVector;

use super::programme::{DualPoint, Programme};
use super::reach::Reach;
use super::step::{Step, Stride};
use super::visit::{Slack, Visit};
use crate::base::watch::Watch;
use crate::hollow::log::Pass;

/// The first damping of a search from nothing, as a part of the mean curvature. A tenth of it, and
/// the first steps overshoot to where the model is worthless; ten times more costs a pass an
/// ascent.
pub(crate) const COLD_DAMPING: f64 = 1e-2;
/// The first damping near a known answer, where the model is good. A hundred times more costs a
/// pass an ascent.
pub(crate) const WARM_DAMPING: f64 = 1e-4;
/// The first damping where a scout has been: the model is all but exact there.
pub(crate) const SCOUTED_DAMPING: f64 = 1e-7;
/// Multipliers beyond this many times the ratio raise the suspicion that no interior meets the
/// rows.
const SUSPICIOUS_MULTIPLIER: f64 = 20.0;

/// How sharply the least miss of rows that cannot be met is found; any positive bound is a proof.
const PROOF_TOLERANCE: f64 = 1e-3;

/// How an ascent ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum End {
    /// Residual and gap are within the tolerance.
    Converged,
    /// No step gains any more.
    Stalled,
    /// These rows cannot be met: at best they are missed by this much, in the solver's units.
    Infeasible(f64),
    /// The passes are used up.
    PassLimit,
    /// The caller has cancelled.
    Cancelled,
}

/// Where an ascent came to.
#[derive(Debug, Clone)]
pub(crate) struct Climb {
    pub best: Visit,
    pub end: End,
    /// Value and bound of every point it was at, the last one `best`.
    pub course: Vec<Pass>,
}

impl Climb {
    /// No ascent, only a visit.
    pub fn of(visit: Visit) -> Self {
        Self {
            course: vec![visit.pass()],
            best: visit,
            end: End::Stalled,
        }
    }

    /// The same ascent with what it began after.
    pub fn after(mut self, course: &[Pass]) -> Self {
        self.course.splice(0..0, course.iter().copied());
        self
    }
}

/// What an ascent may cost and whom it obeys.
#[derive(Clone, Copy)]
pub(crate) struct Budget<'a> {
    pub tolerance: f64,
    /// When the bound is good enough whatever the tolerance; none where it never is.
    pub slack: Option<Slack>,
    pub passes: usize,
    pub first_damping: f64,
    pub watch: &'a Watch,
}

/// Climbs from a visit until residual and gap are within the budget's tolerance.
///
/// D(y, λ, τ) = min_K g·s is concave; {D ≥ 0} is convex and the greatest τ in it is the optimum.
/// Each pass gives D, its gradient and its curvature, and each step maximises the damped quadratic
/// model over y ∈ Y and all λ, with τ moved to where D vanishes (Dinkelbach, "On nonlinear
/// fractional programming", Management Science 13, 1967). Damping follows Levenberg and Marquardt.
/// Near the optimum every step squares the error.
pub(crate) fn climb(reach: &Reach, programme: &Programme, start: Visit, budget: Budget) -> Climb {
    let last_pass = reach.passes() + budget.passes.saturating_sub(1);
    let mut here = start;
    let mut stride = Stride::first(programme, budget.first_damping);
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
        if budget.watch.is_cancelled() {
            return done(End::Cancelled);
        }
        if reach.passes() >= last_pass {
            return done(End::PassLimit);
        }
        if stride.is_exhausted() {
            return done(End::Stalled);
        }
        let mut step = Step::from(&here, programme, &stride);
        let is_settled = stride.leaves_only_the_ratio(&here, &step, programme);
        if is_settled {
            stride = Stride::first(programme, budget.first_damping);
            step = Step::from(&here, programme, &stride);
        }
        if budget
            .slack
            .is_some_and(|slack| here.suffices(step.gain(), slack))
        {
            return done(End::Converged);
        }
        let there = Visit::new(reach, programme, step.to.clone());
        if is_settled || stride.judge(&here, &there, &step, programme.is_ratio()) {
            here = there;
            course.push(here.pass());
            if reach.is_free()
                && is_suspicious(&here, programme)
                && let Some(proof) = separation(reach, programme, &here, budget)
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

/// The proof that no interior meets the rows, if the multipliers point to one: D > 0 along them
/// alone.
fn separation(
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
    refusal(reach, programme, start, budget)
}

/// The same from where the proof is to be looked for: multipliers of the rows, as the weights of
/// [`Programme::feasibility`].
pub(crate) fn refusal(
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

    /// A dual point of the egg's dominance where no column is about to be touched or left by the
    /// quadric.
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
