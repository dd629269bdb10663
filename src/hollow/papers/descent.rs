//! Minimisation of a smooth function of many variables between 0 and 1: projected L-BFGS.

use std::collections::VecDeque;

use crate::base::watch::Watch;

/// Number of remembered curvature pairs. Fewer than 5 slow it down; more than 20 cost more than
/// they gain.
const MEMORY: usize = 10;
/// Least share of the gain promised by the slope for a step to be accepted (Armijo).
const LEAST_GAIN_RATIO: f64 = 1e-4;
/// Least and greatest factor by which a rejected trial is shortened.
const SHORTEST_CUT: f64 = 0.1;
const LONGEST_CUT: f64 = 0.5;
/// Trial limit of a line search, whose last step is a millionth or less.
const TRIALS: usize = 20;
/// Curvature, as a part of a pair's lengths, below which the pair is dropped: the function bends
/// the wrong way there.
const LEAST_CURVATURE_RATIO: f64 = 1e-10;
/// Distance from a bound within which a variable counts as on it (Bertsekas's ε), unless a gradient
/// step moves less.
const NEAR_BOUND: f64 = 1e-6;
/// Largest change of a variable in a first step, before any curvature is known.
const FIRST_STEP: f64 = 0.3;
/// Number of steps whose joint gain is watched, and the part of the value below which it counts as
/// none.
const PROGRESS_STEPS: usize = 30;
const LEAST_PROGRESS_RATIO: f64 = 1e-8;

/// A function of many variables between 0 and 1, each with a weight.
pub(super) trait Function {
    /// Returns the positive weights of the inner product that measures lengths and slopes.
    fn weights(&self) -> &[f64];
    /// Returns the value; writes the derivative by each variable, over its weight, to `slope`.
    fn evaluate(&self, x: &[f64], slope: &mut [f64]) -> f64;
}

/// The end criteria.
#[derive(Clone, Copy)]
pub(super) struct Limits<'a> {
    /// Projected slope at which it ends.
    pub slope: f64,
    pub evaluations: usize,
    pub watch: &'a Watch,
}

/// An evaluated point of a descent.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub x: Vec<f64>,
    pub value: f64,
    slope: Vec<f64>,
    pub evaluations: usize,
}

/// A step, and the change of the slope along it.
struct Pair {
    step: Vec<f64>,
    turn: Vec<f64>,
}

/// Descends from `x` until the projected slope is below the limit, nothing is gained, or the
/// evaluations are used up.
///
/// Each step follows the quasi-Newton direction of the free variables (Bertsekas 1982), projected
/// onto the bounds.
pub(super) fn descend(function: &dyn Function, x: Vec<f64>, limits: &Limits) -> Place {
    let mut place = Place {
        value: 0.0,
        slope: vec![0.0; x.len()],
        x,
        evaluations: 1,
    };
    place.value = function.evaluate(&place.x, &mut place.slope);
    let mut pairs = VecDeque::with_capacity(MEMORY + 1);
    let mut values = VecDeque::from([place.value]);
    while place.evaluations < limits.evaluations && limits.watch.check().is_ok() {
        let projected = projected_slope(&place, function.weights());
        if projected <= limits.slope {
            break;
        }
        let free = free_weights(&place, function.weights(), NEAR_BOUND.min(projected));
        let direction = newton_direction(&place.slope, &pairs, &free);
        let Some(next) = line_search(function, &place, &direction, limits.evaluations) else {
            if pairs.is_empty() {
                break;
            }
            pairs.clear();
            continue;
        };
        remember(&mut pairs, &place, &next);
        place = next;
        if has_stalled(&mut values, place.value) {
            break;
        }
    }
    place
}

/// Returns true if the last steps together gained practically nothing.
fn has_stalled(values: &mut VecDeque<f64>, value: f64) -> bool {
    values.push_back(value);
    if values.len() <= PROGRESS_STEPS {
        return false;
    }
    let before = values.pop_front().unwrap_or(value);
    before - value <= LEAST_PROGRESS_RATIO * value.abs()
}

/// Returns the length of the step x → P(x − slope), which is zero at a first-order optimum.
fn projected_slope(place: &Place, weights: &[f64]) -> f64 {
    let squares = place
        .x
        .iter()
        .zip(&place.slope)
        .zip(weights)
        .map(|((x, slope), weight)| {
            let moved = x - (x - slope).clamp(0.0, 1.0);
            weight * moved * moved
        });
    squares.sum::<f64>().sqrt()
}

/// Returns the weights, zero for variables that are on a bound and pushed against it.
fn free_weights(place: &Place, weights: &[f64], near: f64) -> Vec<f64> {
    let is_on_bound =
        |x: f64, slope: f64| (x <= near && slope > 0.0) || (x >= 1.0 - near && slope < 0.0);
    let free = place.x.iter().zip(&place.slope).zip(weights);
    free.map(|((&x, &slope), &weight)| if is_on_bound(x, slope) { 0.0 } else { weight })
        .collect()
}

/// Returns −H·slope over the free variables, zero for the others, by the two-loop recursion.
///
/// All products are over the free variables alone (Nocedal, "Updating quasi-Newton matrices with
/// limited storage", Math. Comput. 35, 1980).
fn newton_direction(slope: &[f64], pairs: &VecDeque<Pair>, free: &[f64]) -> Vec<f64> {
    let mut direction: Vec<f64> = slope
        .iter()
        .zip(free)
        .map(|(slope, &weight)| if weight > 0.0 { -slope } else { 0.0 })
        .collect();
    let curved: Vec<(&Pair, f64, f64)> = pairs
        .iter()
        .filter_map(|pair| curvature(pair, free))
        .collect();
    let Some((_, bend, turning)) = curved.last() else {
        let longest = direction
            .iter()
            .fold(0.0, |longest: f64, d| longest.max(d.abs()));
        direction
            .iter_mut()
            .for_each(|d| *d *= FIRST_STEP / longest.max(f64::MIN_POSITIVE));
        return direction;
    };
    let mut parts = Vec::with_capacity(curved.len());
    for (pair, bend, _) in curved.iter().rev() {
        let part = dot(&pair.step, &direction, free) / bend;
        add(&mut direction, -part, &pair.turn);
        parts.push(part);
    }
    direction.iter_mut().for_each(|d| *d *= bend / turning);
    for ((pair, bend, _), part) in curved.iter().zip(parts.into_iter().rev()) {
        let other = dot(&pair.turn, &direction, free) / bend;
        add(&mut direction, part - other, &pair.step);
    }
    direction
        .iter_mut()
        .zip(free)
        .filter(|(_, weight)| **weight == 0.0)
        .for_each(|(d, _)| *d = 0.0);
    direction
}

/// Returns a pair with step·turn and turn·turn over the free variables; `None` if the function does
/// not curve up along it.
fn curvature<'a>(pair: &'a Pair, free: &[f64]) -> Option<(&'a Pair, f64, f64)> {
    let bend = dot(&pair.step, &pair.turn, free);
    let turning = dot(&pair.turn, &pair.turn, free);
    let length = dot(&pair.step, &pair.step, free);
    (bend > LEAST_CURVATURE_RATIO * (turning * length).sqrt()).then_some((pair, bend, turning))
}

/// Searches a direction, projected onto the bounds, for the first point that gains enough; `None`
/// if no step does.
fn line_search(
    function: &dyn Function,
    from: &Place,
    direction: &[f64],
    evaluations: usize,
) -> Option<Place> {
    let mut length = 1.0;
    let mut next = from.clone();
    for _ in 0..TRIALS {
        if next.evaluations >= evaluations {
            return None;
        }
        for ((x, from), d) in next.x.iter_mut().zip(&from.x).zip(direction) {
            *x = (from + length * d).clamp(0.0, 1.0);
        }
        next.value = function.evaluate(&next.x, &mut next.slope);
        next.evaluations += 1;
        let promised = promised_gain(from, &next.x, function.weights());
        let gain = from.value - next.value;
        if promised > 0.0 && gain >= LEAST_GAIN_RATIO * promised {
            return Some(next);
        }
        // The minimum of the parabola through the value, its slope and the trial.
        let least = 0.5 * promised / (promised - gain);
        length *= if least.is_finite() {
            least.clamp(SHORTEST_CUT, LONGEST_CUT)
        } else {
            SHORTEST_CUT
        };
    }
    None
}

/// Returns the gain of a move to first order.
fn promised_gain(from: &Place, x: &[f64], weights: &[f64]) -> f64 {
    let moves = from.x.iter().zip(x).zip(&from.slope).zip(weights);
    moves
        .map(|(((from, to), slope), weight)| weight * slope * (from - to))
        .sum()
}

fn remember(pairs: &mut VecDeque<Pair>, from: &Place, to: &Place) {
    let mut pair = if pairs.len() == MEMORY {
        pairs.pop_front()
    } else {
        None
    }
    .unwrap_or_else(|| Pair {
        step: vec![0.0; from.x.len()],
        turn: vec![0.0; from.x.len()],
    });
    subtract(&mut pair.step, &to.x, &from.x);
    subtract(&mut pair.turn, &to.slope, &from.slope);
    pairs.push_back(pair);
}

/// Number of parallel partial sums, for vector instructions; their order is fixed.
const LANES: usize = 8;

/// Returns Σ weight·a·b.
fn dot(a: &[f64], b: &[f64], weights: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let chunks = a
        .chunks_exact(LANES)
        .zip(b.chunks_exact(LANES))
        .zip(weights.chunks_exact(LANES));
    for ((a, b), w) in chunks {
        for (lane, sum) in lanes.iter_mut().enumerate() {
            *sum += a[lane] * b[lane] * w[lane];
        }
    }
    let rest = a.len() / LANES * LANES;
    let tail = a[rest..]
        .iter()
        .zip(&b[rest..])
        .zip(&weights[rest..])
        .map(|((a, b), w)| a * b * w);
    lanes.iter().sum::<f64>() + tail.sum::<f64>()
}

/// Adds factor·b to a.
fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
}

/// Writes a − b to `out`.
fn subtract(out: &mut [f64], a: &[f64], b: &[f64]) {
    out.iter_mut()
        .zip(a.iter().zip(b))
        .for_each(|(out, (a, b))| *out = a - b);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The function ½(x − c)ᵀD(x − c) + ½k(Σw(x − c))². For k = 0 its minimum between the bounds is
    /// c clamped to them.
    struct Bowl {
        weights: Vec<f64>,
        middle: Vec<f64>,
        stiffness: Vec<f64>,
        coupling: f64,
    }

    impl Bowl {
        fn new(count: usize, coupling: f64) -> Self {
            let wave = |seed: f64| (0..count).map(move |i| (i as f64 * seed + 1.0).sin());
            Self {
                weights: wave(0.7).map(|w| (1.2 + w) / count as f64).collect(),
                middle: wave(1.3).map(|m| 0.5 + m).collect(),
                stiffness: wave(2.1).map(|s| 10f64.powf(1.5 * s)).collect(),
                coupling,
            }
        }
    }

    impl Function for Bowl {
        fn weights(&self) -> &[f64] {
            &self.weights
        }

        fn evaluate(&self, x: &[f64], slope: &mut [f64]) -> f64 {
            let off: Vec<f64> = x.iter().zip(&self.middle).map(|(x, m)| x - m).collect();
            let sum: f64 = off.iter().zip(&self.weights).map(|(off, w)| off * w).sum();
            let mut value = 0.5 * self.coupling * sum * sum;
            for i in 0..x.len() {
                slope[i] = self.stiffness[i] * off[i] + self.coupling * sum;
                value += 0.5 * self.weights[i] * self.stiffness[i] * off[i] * off[i];
            }
            value
        }
    }

    fn descend_into(bowl: &Bowl) -> Place {
        let limits = Limits {
            slope: 1e-9,
            evaluations: 2000,
            watch: &Watch::silent(),
        };
        descend(bowl, vec![0.5; bowl.middle.len()], &limits)
    }

    #[test]
    fn uncoupled_variables_end_at_their_minima_clamped_to_the_bounds() {
        let bowl = Bowl::new(203, 0.0);
        let place = descend_into(&bowl);
        let cut: Vec<f64> = bowl
            .middle
            .iter()
            .map(|middle| middle.clamp(0.0, 1.0))
            .collect();
        let least = bowl.evaluate(&cut, &mut vec![0.0; cut.len()]);
        // It ends when thirty steps gain 1e-8 of the value; the remaining error is a few times
        // that.
        assert!(
            place.value >= least && place.value <= least * (1.0 + 1e-6),
            "{} {least}",
            place.value
        );
    }

    #[test]
    fn at_the_end_no_small_move_between_the_bounds_gains() {
        let bowl = Bowl::new(203, 40.0);
        let place = descend_into(&bowl);
        assert!(place.evaluations < 1000, "{}", place.evaluations);
        assert!(place.x.iter().all(|x| (0.0..=1.0).contains(x)));
        // Within δ of the minimum of a function with curvature at most L, the slope is at most
        // √(2Lδ). Here L ≤ 32 + 2·40, and δ ≤ 1e-6 of a value of order one.
        assert!(
            projected_slope(&place, &bowl.weights) < 0.015,
            "{}",
            projected_slope(&place, &bowl.weights)
        );
        assert!(place.value < bowl.evaluate(&vec![0.5; 203], &mut vec![0.0; 203]));
    }

    #[test]
    fn sums_in_lanes_are_sums() {
        let a: Vec<f64> = (0..21).map(f64::from).collect();
        assert_eq!(dot(&a, &a, &[1.0; 21]), 2870.0);
    }
}
