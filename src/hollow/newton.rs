//! Newton's method for convex functions of a few variables, some of which may not be negative.

use nalgebra::{DMatrix, DVector};

/// Share of the full Hessian's trace added to a flat one.
const FLAT_RATIO: f64 = 1e-12;
/// Part of the predicted descent that a step must reach (Armijo's rule).
const ARMIJO_RATIO: f64 = 1e-4;
/// Halvings of a step after which none is found.
const MOST_HALVINGS: usize = 40;
/// Change of the value, as a share of it, that is rounding.
const ROUNDING: f64 = 1e-13;

/// A convex function near a point.
#[derive(Debug, Clone)]
pub(super) struct Local {
    pub value: f64,
    pub gradient: DVector<f64>,
    /// Positive semidefinite.
    pub hessian: DMatrix<f64>,
    /// Trace of the Hessian where nothing is clamped, by which a flat one is mended.
    pub full_trace: f64,
}

/// The end of a descent.
#[derive(Debug, Clone)]
pub(super) struct Minimum {
    pub at: DVector<f64>,
    pub steps: usize,
}

/// The accuracy and the cost of a descent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    pub residual: f64,
    pub steps: usize,
}

/// Minimises a convex function by projected Newton steps (Bertsekas, "Projected Newton methods for
/// optimization problems with simple constraints", SIAM J. Control Optim. 20, 1982).
///
/// Variables with `is_bounded` stay at 0 or above. `visit` returns `None` to end the descent at
/// once, for example because the function is known to have no minimum.
pub(super) fn minimise(
    start: DVector<f64>,
    is_bounded: &[bool],
    limits: Limits,
    mut visit: impl FnMut(&DVector<f64>) -> Option<Local>,
) -> Option<Minimum> {
    let mut at = project(start, is_bounded);
    let mut local = visit(&at)?;
    for steps in 0..=limits.steps {
        let is_free = free_variables(&at, &local, is_bounded);
        let residual = free_gradient(&local, &is_free).amax();
        let is_done = residual <= limits.residual || steps == limits.steps;
        let next = if is_done {
            None
        } else {
            let kinds = Kinds {
                is_free: &is_free,
                is_bounded,
            };
            search(&at, &local, &kinds, &mut visit)?
        };
        let Some(next) = next else {
            return Some(Minimum { at, steps });
        };
        (at, local) = (next.at, next.local);
    }
    None
}

/// The variables that may move, and those that may not be negative.
struct Kinds<'a> {
    is_free: &'a [bool],
    is_bounded: &'a [bool],
}

/// A point and the function there.
struct Visited {
    at: DVector<f64>,
    local: Local,
}

/// Searches along the projected Newton step. `Some(None)` if no step descends.
fn search(
    at: &DVector<f64>,
    local: &Local,
    kinds: &Kinds,
    visit: &mut impl FnMut(&DVector<f64>) -> Option<Local>,
) -> Option<Option<Visited>> {
    let step = newton_step(local, kinds.is_free);
    let gradient = free_gradient(local, kinds.is_free);
    let mut factor = 1.0;
    for _ in 0..MOST_HALVINGS {
        let moved = project(at + &step * factor, kinds.is_bounded);
        let descent = -local.gradient.dot(&(&moved - at));
        let found = visit(&moved)?;
        let gain = local.value - found.value;
        let rounding = ROUNDING * local.value.abs().max(found.value.abs()).max(1e-3);
        let is_flatter = free_gradient(&found, kinds.is_free).norm() < 0.9 * gradient.norm();
        if (gain >= ARMIJO_RATIO * descent && gain > rounding)
            || (gain.abs() <= rounding && is_flatter)
        {
            return Some(Some(Visited {
                at: moved,
                local: found,
            }));
        }
        factor *= 0.5;
    }
    Some(None)
}

fn project(mut at: DVector<f64>, is_bounded: &[bool]) -> DVector<f64> {
    let bounded = at
        .iter_mut()
        .zip(is_bounded)
        .filter(|(_, bounded)| **bounded);
    bounded.for_each(|(value, _)| *value = value.max(0.0));
    at
}

/// Returns which variables may move: all but those at 0 that would become negative.
fn free_variables(at: &DVector<f64>, local: &Local, is_bounded: &[bool]) -> Vec<bool> {
    let held = |i: usize| is_bounded[i] && at[i] <= 0.0 && local.gradient[i] > 0.0;
    (0..at.len()).map(|i| !held(i)).collect()
}

fn free_gradient(local: &Local, is_free: &[bool]) -> DVector<f64> {
    let entry = |i: usize, _| if is_free[i] { local.gradient[i] } else { 0.0 };
    DVector::from_fn(is_free.len(), entry)
}

/// Returns the Newton step over the free variables.
fn newton_step(local: &Local, is_free: &[bool]) -> DVector<f64> {
    let count = is_free.len();
    let trace = local
        .full_trace
        .max(local.hessian.trace())
        .max(f64::MIN_POSITIVE);
    let mut hessian = local.hessian.clone();
    for i in 0..count {
        if is_free[i] {
            hessian[(i, i)] += FLAT_RATIO * trace;
            continue;
        }
        for j in 0..count {
            (hessian[(i, j)], hessian[(j, i)]) = (0.0, 0.0);
        }
        hessian[(i, i)] = 1.0;
    }
    let gradient = free_gradient(local, is_free);
    match hessian.cholesky() {
        Some(cholesky) => -cholesky.solve(&gradient),
        // Rounding made it indefinite: the steepest descent is safe.
        None => -gradient / trace,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadratic_with_a_bound_ends_on_the_bound() {
        // (x − 1)² + (y + 2)² + xy/2 with y ≥ 0.
        let visit = |at: &DVector<f64>| {
            let (x, y) = (at[0], at[1]);
            Some(Local {
                value: (x - 1.0).powi(2) + (y + 2.0).powi(2) + 0.5 * x * y,
                gradient: DVector::from_vec(vec![
                    2.0 * (x - 1.0) + 0.5 * y,
                    2.0 * (y + 2.0) + 0.5 * x,
                ]),
                hessian: DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 2.0]),
                full_trace: 4.0,
            })
        };
        let limits = Limits {
            residual: 1e-12,
            steps: 20,
        };
        let start = DVector::from_vec(vec![-3.0, 5.0]);
        let found = minimise(start, &[false, true], limits, visit).unwrap();
        assert!((found.at[0] - 1.0).abs() < 1e-12 && found.at[1] == 0.0);
        assert!(found.steps <= 4);
    }

    #[test]
    fn a_visit_that_ends_the_descent_ends_it() {
        let limits = Limits {
            residual: 1e-12,
            steps: 20,
        };
        assert!(minimise(DVector::zeros(1), &[false], limits, |_| None).is_none());
    }
}
