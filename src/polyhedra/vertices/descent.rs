//! Descent with limited memory (L-BFGS).
//!
//! J. Nocedal, "Updating quasi-Newton matrices with limited storage", Mathematics of Computation
//! 35, 1980: the two-loop recursion, with steps that shrink until the energy falls.

use crate::geom::{Point, Vector};

/// Pairs of steps and changes that are remembered.
const MEMORY: usize = 8;
/// The share of the promised fall that a step must keep (Armijo).
const SUFFICIENT: f64 = 1e-4;
/// Halvings of a step before the descent ends.
const HALVINGS: usize = 24;

/// Descends from the corners and returns where it ends, after at most `steps`.
pub(super) fn descend(
    corners: Vec<Point>,
    steps: usize,
    first_step_mm: f64,
    energy: impl Fn(&[Point]) -> (f64, Vec<Vector>),
) -> Vec<Point> {
    let mut here = corners;
    let (mut value, mut gradient) = energy(&here);
    let mut memory: Vec<Pair> = Vec::new();
    for _ in 0..steps {
        let mut way = direction(&gradient, &memory, first_step_mm);
        let mut promise = dot(&way, &gradient);
        if promise >= 0.0 {
            memory.clear();
            way = direction(&gradient, &memory, first_step_mm);
            promise = dot(&way, &gradient);
        }
        let mut length = 1.0;
        let found = (0..HALVINGS).find_map(|_| {
            let next: Vec<Point> = here.iter().zip(&way).map(|(p, w)| p + w * length).collect();
            let (next_value, next_gradient) = energy(&next);
            let falls = next_value < value + SUFFICIENT * length * promise;
            length /= 2.0;
            falls.then_some((next, next_value, next_gradient))
        });
        let Some((next, next_value, next_gradient)) = found else {
            break;
        };
        let step: Vec<Vector> = next.iter().zip(&here).map(|(a, b)| a - b).collect();
        let change: Vec<Vector> = next_gradient
            .iter()
            .zip(&gradient)
            .map(|(a, b)| a - b)
            .collect();
        let curvature = dot(&step, &change);
        if curvature > 0.0 {
            memory.push(Pair {
                step,
                change,
                curvature,
            });
            if memory.len() > MEMORY {
                memory.remove(0);
            }
        }
        (here, value, gradient) = (next, next_value, next_gradient);
    }
    here
}

/// A step and the change of the gradient along it.
struct Pair {
    step: Vec<Vector>,
    change: Vec<Vector>,
    curvature: f64,
}

fn dot(a: &[Vector], b: &[Vector]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}

fn add(to: &mut [Vector], factor: f64, from: &[Vector]) {
    to.iter_mut()
        .zip(from)
        .for_each(|(to, from)| *to += from * factor);
}

/// Returns the direction of descent; without memory the longest part of it has the first length.
fn direction(gradient: &[Vector], memory: &[Pair], first_step_mm: f64) -> Vec<Vector> {
    let mut way: Vec<Vector> = gradient.iter().map(|g| -g).collect();
    let Some(last) = memory.last() else {
        let longest = way
            .iter()
            .map(Vector::norm)
            .fold(f64::MIN_POSITIVE, f64::max);
        return way
            .into_iter()
            .map(|w| w * (first_step_mm / longest))
            .collect();
    };
    let mut shares = Vec::with_capacity(memory.len());
    for pair in memory.iter().rev() {
        let share = dot(&pair.step, &way) / pair.curvature;
        add(&mut way, -share, &pair.change);
        shares.push(share);
    }
    let scale = last.curvature / dot(&last.change, &last.change);
    way.iter_mut().for_each(|w| *w *= scale);
    for (pair, share) in memory.iter().zip(shares.into_iter().rev()) {
        let back = dot(&pair.change, &way) / pair.curvature;
        add(&mut way, share - back, &pair.step);
    }
    way
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_valley_is_descended_to_its_bottom() {
        let rates = Vector::new(1.0, 30.0, 900.0);
        let energy = |corners: &[Point]| {
            let slopes = corners.iter().map(|p| p.coords.component_mul(&rates));
            let value = corners
                .iter()
                .map(|p| p.coords.dot(&p.coords.component_mul(&rates)));
            (value.sum::<f64>() / 2.0, slopes.collect())
        };
        let start = vec![Point::new(5.0, -3.0, 2.0), Point::new(-1.0, 4.0, 1.0)];
        let end = descend(start, 100, 0.1, energy);
        assert!(end.iter().all(|p| p.coords.norm() < 1e-6), "{end:?}");
    }
}
