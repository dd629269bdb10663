//! Levenberg–Marquardt within bounds.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::residuals::{Linear, Problem};
use super::unknowns::Unknowns;
use crate::curve::chain::Chain;

/// Most steps of a descent. Most end within some hundred.
const MAX_STEPS: usize = 300;

/// Steps tried with more and more damping before the place counts as a minimum.
const MAX_TRIES: usize = 12;

/// Relative fall of the cost in one step that counts as none.
const FLAT: f64 = 1e-9;

/// Flat steps after which the descent has converged: one may be flat because a bound was met.
const FLAT_STEPS: usize = 3;

/// Damping at the start, in units of the diagonal.
const FIRST_DAMPING: f64 = 1e-3;

/// Least damping, in units of the diagonal: rounding of the equations is smaller.
const LEAST_DAMPING: f64 = 1e-12;

/// Factor by which damping falls after a good step, and rises after a bad one.
const DAMPING_FACTOR: f64 = 5.0;

/// Goes down from a chain to a local minimum of the cost.
///
/// Marquardt's damping scales with the diagonal, so units do not matter. Unknowns that are pushed
/// out of their bounds rest for the step. (Nocedal and Wright, "Numerical Optimization", §10.3 and
/// §16.7.)
pub(super) fn descend(problem: &Problem, free: &Unknowns, start: &Chain) -> Chain {
    let mut descent = Descent {
        problem,
        free,
        cost: problem.cost(start),
        chain: start.clone(),
        damping: FIRST_DAMPING,
    };
    let mut flat = 0;
    for _ in 0..MAX_STEPS {
        let before = descent.cost;
        if !descent.step() {
            break;
        }
        let is_flat = before - descent.cost < FLAT * before;
        flat = if is_flat { flat + 1 } else { 0 };
        if flat == FLAT_STEPS {
            break;
        }
    }
    descent.chain
}

/// A descent on its way.
struct Descent<'a> {
    problem: &'a Problem<'a>,
    free: &'a Unknowns,
    chain: Chain,
    cost: f64,
    damping: f64,
}

impl Descent<'_> {
    /// Takes one step down; returns false if there is none.
    fn step(&mut self) -> bool {
        let linear = self.problem.linear(&self.chain, self.free);
        let equations = Equations::new(&linear, self.free, &self.chain);
        for _ in 0..MAX_TRIES {
            let step = equations.solve(self.damping);
            let next = step.map(|step| self.free.step(&self.chain, &step));
            let next = next.map(|chain| (self.problem.cost(&chain), chain));
            if let Some((cost, chain)) = next.filter(|(cost, _)| *cost < self.cost) {
                (self.cost, self.chain) = (cost, chain);
                self.damping = (self.damping / DAMPING_FACTOR).max(LEAST_DAMPING);
                return true;
            }
            self.damping *= DAMPING_FACTOR;
        }
        false
    }
}

/// The normal equations of a step, in the unknowns that may move.
struct Equations {
    matrix: DMatrix<f64>,
    gradient: DVector<f64>,
    /// The place of each row among all unknowns.
    places: Vec<usize>,
    count: usize,
}

impl Equations {
    fn new(linear: &Linear, free: &Unknowns, chain: &Chain) -> Self {
        let gradient = linear.jacobian.tr_mul(&linear.residuals);
        let may_move = |place: &usize| !free.is_blocked(chain, *place, gradient[*place]);
        let places: Vec<usize> = (0..free.count()).filter(may_move).collect();
        let columns = linear.jacobian.select_columns(&places);
        Self {
            matrix: columns.tr_mul(&columns),
            gradient: gradient.select_rows(&places),
            places,
            count: free.count(),
        }
    }

    /// Returns the step of every unknown; `None` if the equations are singular.
    fn solve(&self, damping: f64) -> Option<Vec<f64>> {
        let mut damped = self.matrix.clone();
        for i in 0..damped.nrows() {
            // A column of zeros keeps its unknown where it is.
            damped[(i, i)] += damping * self.matrix[(i, i)] + f64::MIN_POSITIVE;
        }
        let solved = Cholesky::new(damped)?.solve(&-&self.gradient);
        let mut step = vec![0.0; self.count];
        for (place, value) in self.places.iter().zip(&solved) {
            step[*place] = *value;
        }
        step.iter().all(|value| value.is_finite()).then_some(step)
    }
}
