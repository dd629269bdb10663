//! Levenberg's and Marquardt's method: the least sum of squared misses near a start.

use nalgebra::{Matrix4, Vector4};

use super::shape::Numbers;
use super::state::Misses;

/// Most steps from a start.
const MOST_STEPS: usize = 60;
/// Most dampings of a step.
const MOST_DAMPINGS: usize = 12;
/// The damping at first, as a share of the squares of the slopes.
const FIRST_DAMPING: f64 = 1e-3;
/// The factor of the damping after a step that does not help, and its inverse after one that does.
const DAMPING_FACTOR: f64 = 8.0;
/// Least damping.
const LEAST_DAMPING: f64 = 1e-12;
/// Greatest miss at which a descent ends.
const ACCURACY: f64 = 1e-12;
/// Share by which a step must lessen the sum of squares, or the descent ends.
const LEAST_GAIN: f64 = 1e-9;

/// Returns the numbers with the least sum of squared misses near a start.
///
/// `visit` returns `None` for numbers that are none of a field.
pub(super) fn descend(start: Numbers, visit: impl Fn(&Numbers) -> Option<Misses>) -> Numbers {
    let mut at = start;
    let Some(mut misses) = visit(&at) else {
        return at;
    };
    let mut damping = FIRST_DAMPING;
    for _ in 0..MOST_STEPS {
        let sum = misses.values.norm_squared();
        if misses.values.is_empty() || misses.values.amax() <= ACCURACY {
            break;
        }
        let Some(next) = step(&at, &misses, &mut damping, &visit) else {
            break;
        };
        (at, misses) = next;
        let gain = sum - misses.values.norm_squared();
        if gain <= LEAST_GAIN * sum {
            break;
        }
    }
    at
}

/// Returns the first step that lessens the misses; `None` if none does.
fn step(
    at: &Numbers,
    misses: &Misses,
    damping: &mut f64,
    visit: &impl Fn(&Numbers) -> Option<Misses>,
) -> Option<(Numbers, Misses)> {
    let gradient: Vector4<f64> = misses
        .slopes
        .tr_mul(&misses.values)
        .fixed_rows::<4>(0)
        .into();
    let squares = misses.slopes.tr_mul(&misses.slopes);
    let squares: Matrix4<f64> = squares.fixed_view::<4, 4>(0, 0).into();
    let trace = squares.trace().max(f64::MIN_POSITIVE);
    for _ in 0..MOST_DAMPINGS {
        let mut damped = squares;
        for i in 0..4 {
            damped[(i, i)] += *damping * (squares[(i, i)] + 1e-6 * trace);
        }
        let moved = damped.cholesky().map(|root| at - root.solve(&gradient));
        let found = moved.and_then(|moved| visit(&moved).map(|misses| (moved, misses)));
        let is_less = |found: &(Numbers, Misses)| {
            found.1.values.norm_squared() < misses.values.norm_squared()
        };
        if let Some(found) = found.filter(is_less) {
            *damping = (*damping / DAMPING_FACTOR).max(LEAST_DAMPING);
            return Some(found);
        }
        *damping *= DAMPING_FACTOR;
    }
    None
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        // Rosenbrock's valley twice: (1 − a, 10(b − a²)) and the same for c and d.
        let visit = |at: &Numbers| {
            let [a, b, c, d] = (*at).into();
            let values = vec![1.0 - a, 10.0 * (b - a * a), 1.0 - c, 10.0 * (d - c * c)];
            let slopes = [
                [-1.0, 0.0, 0.0, 0.0],
                [-20.0 * a, 10.0, 0.0, 0.0],
                [0.0, 0.0, -1.0, 0.0],
                [0.0, 0.0, -20.0 * c, 10.0],
            ];
            Some(Misses {
                values: DVector::from_vec(values),
                slopes: DMatrix::from_fn(4, 4, |i, j| slopes[i][j]),
            })
        };
        let found = descend(Numbers::new(-1.2, 1.0, 2.0, -3.0), visit);
        assert!((found - Numbers::repeat(1.0)).amax() < 1e-9, "{found}");
    }
}
