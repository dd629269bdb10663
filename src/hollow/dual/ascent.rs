//! The dual ascent: a damped Newton method that raises the bound and the trial ratio together.

use nalgebra::{DMatrix, DVector};

use super::programme::{DualPoint, Programme, index};
use super::reach::{Extreme, Reach, Vector10};
use crate::base::watch::Watch;
use crate::hollow::solution::Pass;

/// The first damping of a search from nothing, as a part of the mean curvature. A tenth of it, and
/// the first steps overshoot to where the model is worthless; ten times more costs a pass an
/// ascent.
pub(crate) const COLD_DAMPING: f64 = 1e-2;
/// The first damping near a known answer, where the model is good. A hundred times more costs a
/// pass an ascent.
pub(crate) const WARM_DAMPING: f64 = 1e-4;
/// The first damping where a scout has been: the model is all but exact there.
pub(crate) const SCOUTED_DAMPING: f64 = 1e-7;
/// Damping below this part is none; above the greatest the steps are shorter than rounding.
const LEAST_DAMPING: f64 = 1e-12;
const GREATEST_DAMPING: f64 = 1e9;
/// How the damping follows the model's fortune.
const EASE: f64 = 0.1;
const TIGHTEN: f64 = 8.0;
/// A step is taken when it gains at least this part of what the model promised; above the second
/// the damping eases.
const LEAST_GAIN_RATIO: f64 = 0.05;
const GOOD_GAIN_RATIO: f64 = 0.5;
/// Curvature below which a quadric counts as cutting nothing: the damping then stands on this.
const LEAST_CURVATURE: f64 = 1e-4;
/// Gains below this are rounding: a step that promises no more is judged by whether it comes nearer
/// to the optimum.
const ROUNDING_GAIN: f64 = 1e-13;
/// When no y and λ promise to raise D by more than this part of it, it is τ that has to move, as
/// Dinkelbach's method always may; larger, and τ moves on a D that is far from its maximum.
const SETTLED_RATIO: f64 = 0.03;
/// Multipliers beyond this many times the ratio raise the suspicion that no interior meets the
/// rows.
const SUSPICIOUS_MULTIPLIER: f64 = 20.0;

/// How sharply the least miss of rows that cannot be met is found; any positive bound is a proof.
const PROOF_TOLERANCE: f64 = 1e-3;

/// A dual point, its quadric's extreme interior, and what they prove.
#[derive(Debug, Clone)]
pub(crate) struct Visit {
    pub point: DualPoint,
    /// The quadric's coefficients in the solver's units.
    pub quadric: Vector10,
    pub extreme: Extreme,
    /// D = min over K at this point.
    dual: f64,
    /// As − b
    pub misses: DVector<f64>,
    /// The ratio of the extreme interior, which meets the rows up to `misses`.
    pub value: f64,
    /// No interior that meets the rows has a smaller ratio.
    pub bound: f64,
    /// The denominator of the extreme interior.
    pub denominator: f64,
}

impl Visit {
    pub fn new(reach: &Reach, programme: &Programme, point: DualPoint) -> Self {
        let quadric = programme.quadric(&point);
        let extreme = reach.extreme(&quadric);
        let dual = quadric.dot(&extreme.s) + extreme.cost - programme.rhs.dot(&point.lambda);
        let denominator = programme.denominator_at(&extreme.s);
        Self {
            misses: &programme.rows * extreme.s - &programme.rhs,
            value: (programme.numerator_at(&extreme.s) + extreme.cost) / denominator,
            bound: programme.bound(point.tau, dual),
            quadric,
            extreme,
            dual,
            denominator,
            point,
        }
    }

    /// Its ratio and its bound.
    pub fn pass(&self) -> Pass {
        Pass {
            value: self.value,
            bound: self.bound,
        }
    }

    /// How far the rows are from met, in the solver's units.
    pub fn residual(&self) -> f64 {
        self.misses.amax()
    }

    /// Value over bound, as a part of the value (of one where it is smaller than a thousandth).
    pub fn gap_ratio(&self) -> f64 {
        (self.value - self.bound) / self.value.abs().max(1e-3)
    }

    /// The extreme interior's mass.
    pub fn mass(&self) -> f64 {
        self.extreme.s[index::ONE]
    }

    /// Its lever s_z.
    pub fn lever(&self) -> f64 {
        self.extreme.s[index::Z]
    }

    /// The height of the extreme interior's centre.
    pub fn center_height(&self) -> f64 {
        self.extreme.s[index::Z] / self.extreme.s[index::ONE]
    }

    /// Whether the bound is good enough, where the next step promises this gain in D.
    fn suffices(&self, gain: f64, slack: Slack) -> bool {
        let promised = self.point.tau + (self.dual + gain) / self.denominator;
        promised - self.bound <= slack.share * promised.abs() || self.bound >= slack.enough
    }

    pub fn is_within(&self, tolerance: f64) -> bool {
        self.residual() <= tolerance && self.gap_ratio().abs() <= tolerance
    }

    fn error(&self) -> f64 {
        self.residual().max(self.gap_ratio().abs())
    }
}

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

/// When a bound is good enough.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slack {
    /// It may still rise by this share of itself,
    pub share: f64,
    /// or it is this much.
    pub enough: f64,
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
    let mut stride = Stride::first(programme, budget);
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
        if stride.damping > GREATEST_DAMPING {
            return done(End::Stalled);
        }
        let mut step = Step::from(&here, programme, &stride);
        let is_settled = stride.leaves_only_the_ratio(&here, &step, programme);
        if is_settled {
            stride = Stride::first(programme, budget);
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

/// How boldly the next step goes.
struct Stride {
    damping: f64,
    /// Whether τ moves with the step; it rests while the model is too poor to predict what moving
    /// it does.
    moves_ratio: bool,
}

impl Stride {
    fn first(programme: &Programme, budget: Budget) -> Self {
        Self {
            damping: budget.first_damping,
            moves_ratio: programme.is_ratio(),
        }
    }

    /// Whether D is all but maximal at a resting τ, so that τ has to move whatever the model says
    /// of it.
    fn leaves_only_the_ratio(&self, here: &Visit, step: &Step, programme: &Programme) -> bool {
        programme.is_ratio() && !self.moves_ratio && step.gain() <= SETTLED_RATIO * here.dual.abs()
    }

    /// Whether `there` is to be taken; adapts the damping to how well the model foresaw it.
    fn judge(&mut self, here: &Visit, there: &Visit, step: &Step, is_ratio: bool) -> bool {
        let promised = step.gain();
        let gained = there.dual - step.standing;
        let gain_ratio = if promised > ROUNDING_GAIN {
            gained / promised
        } else if there.error() < here.error() {
            1.0
        } else {
            0.0
        };
        if gain_ratio < LEAST_GAIN_RATIO {
            self.damping *= TIGHTEN;
            self.moves_ratio = false;
            return false;
        }
        if gain_ratio > GOOD_GAIN_RATIO {
            self.damping = (self.damping * EASE).max(LEAST_DAMPING);
        }
        self.moves_ratio = is_ratio;
        true
    }
}

/// A step, and what the model says of it.
struct Step {
    to: DualPoint,
    /// The model's D at `to`.
    promised: f64,
    /// The model's D at the old y and λ, with τ moved.
    standing: f64,
}

impl Step {
    /// What the model promises the step to gain over standing still.
    fn gain(&self) -> f64 {
        self.promised - self.standing
    }

    /// Maximises D + r·d − ½ dᵀ(H + μI)d over the step d = (dy, dλ) with y + dy ∈ Y.
    fn from(here: &Visit, programme: &Programme, stride: &Stride) -> Self {
        let turning = programme.turning();
        let w = &here.extreme.w;
        let ratio_step = if stride.moves_ratio {
            here.dual / here.denominator
        } else {
            0.0
        };
        let eased = w * programme.denominator * ratio_step;
        let mut slope = &turning * here.extreme.s;
        slope
            .rows_mut(programme.directions.nrows(), programme.rhs.len())
            .copy_from(&here.misses);
        let model = Model {
            slope: slope + &turning * eased,
            curvature: &turning * w * turning.transpose(),
        };
        let (y, lambda) = model.maximiser(&here.point, programme, stride.damping);

        let (dy, dl) = (&y - &here.point.y, &lambda - &here.point.lambda);
        let step = DVector::from_iterator(dy.len() + dl.len(), dy.iter().chain(dl.iter()).copied());
        let fall =
            ratio_step * here.denominator + 0.5 * ratio_step * programme.denominator.dot(&eased);
        let standing = here.dual - fall;
        let promised = standing + model.gain(&step);
        Self {
            to: DualPoint {
                y,
                lambda,
                tau: here.point.tau + ratio_step,
            },
            promised,
            standing,
        }
    }
}

/// D as a quadratic over (y, λ) about the present point, at the τ of the step.
struct Model {
    slope: DVector<f64>,
    curvature: DMatrix<f64>,
}

impl Model {
    /// What the model gains over a step.
    fn gain(&self, step: &DVector<f64>) -> f64 {
        self.slope.dot(step) - 0.5 * step.dot(&(&self.curvature * step))
    }

    /// The y and λ of the damped model's maximum: λ is eliminated, y is found on its set, λ
    /// follows.
    fn maximiser(
        &self,
        from: &DualPoint,
        programme: &Programme,
        damping: f64,
    ) -> (DVector<f64>, DVector<f64>) {
        let (k, m) = (programme.directions.nrows(), programme.rhs.len());
        let n = k + m;
        let mean = (self.curvature.trace() / n as f64).max(LEAST_CURVATURE);
        let damped = &self.curvature + DMatrix::identity(n, n) * (mean * damping);
        let (yy, yl, ll) = (
            damped.view((0, 0), (k, k)),
            damped.view((0, k), (k, m)),
            damped.view((k, k), (m, m)),
        );
        let (slope_y, slope_l) = (self.slope.rows(0, k), self.slope.rows(k, m).into_owned());
        let Some(inner) = ll.into_owned().cholesky() else {
            return (from.y.clone(), &from.lambda + slope_l / mean);
        };
        let schur = yy - yl * inner.solve(&yl.transpose());
        let reduced = slope_y - yl * inner.solve(&slope_l);
        let y = programme
            .set
            .minimise(&schur, &(reduced + &schur * &from.y), &from.y);
        let follows = inner.solve(&(slope_l - yl.tr_mul(&(&y - &from.y))));
        (y, &from.lambda + follows)
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
    use super::super::reach::Scale;
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
