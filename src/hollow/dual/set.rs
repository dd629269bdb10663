//! The sets Y of dual weights, and minimisation of a small convex quadratic over them.

use nalgebra::{DMatrix, DVector};

/// Round limit of the secular equation, which converges quadratically from one side within about
/// ten.
const SECULAR_ROUNDS: usize = 60;
/// Distance to the sphere at which the secular equation ends; below 1e-15 rounding decides.
const SECULAR_TOLERANCE: f64 = 1e-14;
/// Least derivative of a weight worth adding, as a part of the largest slope.
const ACTIVE_TOLERANCE: f64 = 1e-13;

/// The set of the dual weights y; its support function is the convex part of a goal's numerator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DualSet {
    /// ‖y‖ ≤ 1: the numerator has a Euclidean norm, or in two dimensions the λ_max of a 2 × 2
    /// tensor.
    Ball,
    /// y ≥ 0, Σy = 1: the numerator is the largest of several linear functions.
    Simplex,
}

impl DualSet {
    /// Returns the support function max yᵀv.
    pub fn support(self, v: &DVector<f64>) -> f64 {
        match self {
            Self::Ball => v.norm(), // zero where there are no weights
            Self::Simplex => v.max(),
        }
    }

    /// Returns a y at which the support is reached.
    pub fn maximiser(self, v: &DVector<f64>) -> DVector<f64> {
        match self {
            Self::Ball if v.norm() > 0.0 => v.normalize(),
            Self::Ball => DVector::zeros(v.len()),
            Self::Simplex => vertex(v.len(), v.imax()),
        }
    }

    /// Minimises ½ yᵀSy − cᵀy over the set, for a positive definite S; `from` is a point of the
    /// set.
    pub fn minimise(self, s: &DMatrix<f64>, c: &DVector<f64>, from: &DVector<f64>) -> DVector<f64> {
        match self {
            Self::Ball if c.is_empty() => from.clone(),
            Self::Ball => minimise_over_ball(s, c),
            Self::Simplex => minimise_over_simplex(s, c, from),
        }
    }
}

/// Returns the vertex of the simplex with all weight on one entry.
fn vertex(count: usize, at: usize) -> DVector<f64> {
    DVector::from_fn(count, |i, _| if i == at { 1.0 } else { 0.0 })
}

/// Solves the secular equation (S + νI) y = c for the ν ≥ 0 that brings y into the ball.
///
/// Moré and Sorensen, "Computing a trust region step", SIAM J. Sci. Stat. Comput. 4, 1983.
fn minimise_over_ball(s: &DMatrix<f64>, c: &DVector<f64>) -> DVector<f64> {
    let eigen = s.clone().symmetric_eigen();
    let along = eigen.eigenvectors.tr_mul(c);
    let at = |shift: f64| along.zip_map(&eigen.eigenvalues, |c, lambda| c / (lambda + shift));
    let mut shift = 0.0;
    let mut y = at(shift);
    for _ in 0..SECULAR_ROUNDS {
        let norm = y.norm();
        if norm <= 1.0 + SECULAR_TOLERANCE {
            break;
        }
        let slope: f64 = y.zip_fold(&eigen.eigenvalues, 0.0, |sum, y, lambda| {
            sum + y * y / (lambda + shift)
        });
        shift += (norm - 1.0) * norm * norm / slope;
        y = at(shift);
    }
    let y = eigen.eigenvectors * y;
    let norm = y.norm();
    if norm > 1.0 { y / norm } else { y }
}

/// Minimises over the simplex by a primal active-set method.
///
/// Each round minimises over the active weights and drops those that reach zero. Then it adds the
/// weight with the steepest descent, until none descends.
fn minimise_over_simplex(s: &DMatrix<f64>, c: &DVector<f64>, from: &DVector<f64>) -> DVector<f64> {
    let mut y = from.clone();
    let mut active: Vec<usize> = (0..y.len()).filter(|&i| y[i] > 0.0).collect();
    // Each round lowers the value, so no active set repeats; the limit only guards against
    // rounding.
    for _ in 0..10 * y.len() + 10 {
        while !step_within(s, c, &mut y, &mut active) {}
        let slope = s * &y - c;
        let level = slope.dot(&y);
        let best = slope.imin();
        if slope[best] >= level - ACTIVE_TOLERANCE * slope.amax() || active.contains(&best) {
            break;
        }
        active.push(best);
        active.sort_unstable();
    }
    y
}

/// Moves y to the minimum over the active weights, or to the first weight that reaches zero, which
/// is dropped. Returns true if the minimum was reached.
fn step_within(
    s: &DMatrix<f64>,
    c: &DVector<f64>,
    y: &mut DVector<f64>,
    active: &mut Vec<usize>,
) -> bool {
    let Some(target) = least_with_sum_one(s, c, active) else {
        return true;
    };
    let mut part = 1.0;
    let mut blocking = None;
    for (slot, &i) in active.iter().enumerate() {
        let limit = y[i] / (y[i] - target[slot]);
        if target[slot] < 0.0 && limit < part {
            (part, blocking) = (limit, Some(slot));
        }
    }
    for (slot, &i) in active.iter().enumerate() {
        y[i] += part * (target[slot] - y[i]);
    }
    if let Some(slot) = blocking {
        y[active.remove(slot)] = 0.0;
    }
    blocking.is_none()
}

/// Minimises the quadratic over the active weights of any sign with sum one.
fn least_with_sum_one(
    s: &DMatrix<f64>,
    c: &DVector<f64>,
    active: &[usize],
) -> Option<DVector<f64>> {
    let n = active.len();
    let factor = DMatrix::from_fn(n, n, |i, j| s[(active[i], active[j])]).cholesky()?;
    let free = factor.solve(&DVector::from_fn(n, |i, _| c[active[i]]));
    let ones = factor.solve(&DVector::repeat(n, 1.0));
    let excess = (free.sum() - 1.0) / ones.sum();
    Some(free - ones * excess)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a fixed positive definite matrix and a slope.
    fn quadratic(n: usize, seed: f64) -> (DMatrix<f64>, DVector<f64>) {
        let root = DMatrix::from_fn(n, n, |i, j| ((i * 7 + j * 3 + 1) as f64 * seed).sin());
        (
            &root * root.transpose() + DMatrix::identity(n, n) * 0.01,
            DVector::from_fn(n, |i, _| 3.0 * (i as f64 * seed).cos()),
        )
    }

    fn value(s: &DMatrix<f64>, c: &DVector<f64>, y: &DVector<f64>) -> f64 {
        0.5 * y.dot(&(s * y)) - c.dot(y)
    }

    #[test]
    fn at_the_least_over_the_ball_the_slope_points_straight_out() {
        for seed in [0.3, 0.9, 1.7, 2.9] {
            let (s, c) = quadratic(3, seed);
            let y = DualSet::Ball.minimise(&s, &c, &DVector::zeros(3));
            let descent = &c - &s * &y;
            assert!(y.norm() <= 1.0 + 1e-12);
            assert!(
                (descent.norm() - descent.dot(&y)).abs() < 1e-9 * (1.0 + descent.norm())
                    || descent.norm() < 1e-9
            );
        }
    }

    #[test]
    fn the_least_inside_the_ball_is_the_free_one() {
        let (s, c) = (
            DMatrix::identity(2, 2) * 4.0,
            DVector::from_vec(vec![1.0, -2.0]),
        );
        let y = DualSet::Ball.minimise(&s, &c, &DVector::zeros(2));
        assert!((y - DVector::from_vec(vec![0.25, -0.5])).norm() < 1e-15);
    }

    #[test]
    fn no_mixture_beats_the_least_over_the_simplex() {
        for (n, seed) in [(1, 0.4), (4, 0.3), (7, 1.1), (30, 0.7)] {
            let (s, c) = quadratic(n, seed);
            let y = DualSet::Simplex.minimise(&s, &c, &vertex(n, 0));
            assert!((y.sum() - 1.0).abs() < 1e-12 && y.min() >= 0.0);
            // First-order condition: no vertex descends, so by convexity no point does.
            let slope = &s * &y - &c;
            assert!(
                slope.min() >= slope.dot(&y) - 1e-10 * slope.amax(),
                "{n} {seed}"
            );
            assert!(
                value(&s, &c, &y) <= value(&s, &c, &DVector::repeat(n, 1.0 / n as f64)) + 1e-12
            );
        }
    }
}
