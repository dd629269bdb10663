//! The bounds of the density at which a body can just meet its rows, with the proof.
//!
//! Put F = A s − b for the shell and an interior of the greatest density everywhere. Then some
//! density between low and high meets A s = b if and only if, for every u,
//!
//! ```text
//! (high − low) ∫ (u·A m)₊ dV ≥ u·F
//! ```
//!
//! So the least span is the greatest u·F/∫(u·A m)₊. It is one concave programme in as many
//! variables as there are rows. The maximum of u·F − ½(∫(u·A m)₊)² is half the square of the span.
//! Any u proves that lesser spans do not do.

use nalgebra::DVector;

use super::graded::{Graded, InUnits, Separation};
use super::newton::{Limits, Local, minimise};
use crate::field::DensityRange;

/// Gradient, in units, at which the span is found: far below what it is rounded to.
const ACCURACY: Limits = Limits {
    residual: 1e-10,
    steps: 100,
};

/// A bound of the density at which the rows can just be met.
#[derive(Debug, Clone, PartialEq)]
pub struct Threshold {
    /// The density. Below 0 or above 1, no density at all does it.
    pub density: f64,
    /// The proof that nothing beyond does it; `None` if the bound is met by one density everywhere.
    pub proof: Option<Separation>,
    /// Relative distance of the proved bound from the one that was found.
    pub gap: f64,
}

/// Returns the greatest least density with which the rows can be met, if the greatest is `high`.
///
/// Negative if not even a hollow interior meets them.
pub fn greatest_low(graded: &Graded, high: f64) -> Threshold {
    let span = least_span(graded, high, 1.0);
    Threshold {
        density: high - span.density,
        ..span
    }
}

/// Returns the least greatest density with which the rows can be met, if the least is `low`.
pub fn least_high(graded: &Graded, low: f64) -> Threshold {
    let span = least_span(graded, low, -1.0);
    Threshold {
        density: low + span.density,
        ..span
    }
}

/// Returns the proof that no density of a range meets the rows; `None` if some density does.
pub(super) fn proof_against(graded: &Graded, range: DensityRange) -> Option<Separation> {
    let least = least_span(graded, range.high(), 1.0);
    least.proof.filter(|_| least.density > range.span())
}

/// Returns the least span from a density to lesser (sign 1) or greater ones (sign −1).
fn least_span(graded: &Graded, from: f64, sign: f64) -> Threshold {
    let units = InUnits::new(graded);
    let excess = units.excess(&(units.shell + units.interior * from));
    let visit = |u: &DVector<f64>| Some(visit(&units, &excess, u * sign).turned(sign));
    let at_start = project(&excess, &units.is_bounded);
    let size = reach(&units, &(&at_start * sign));
    let start = if size > 0.0 {
        &at_start * (at_start.norm_squared() / (size * size))
    } else {
        at_start
    };
    let found = minimise(start, &units.is_bounded, ACCURACY, visit);
    let weights = found.map_or_else(|| DVector::zeros(excess.len()), |found| found.at);
    let size = reach(&units, &(&weights * sign));
    if size <= 0.0 {
        return Threshold {
            density: 0.0,
            proof: None,
            gap: 0.0,
        };
    }
    let span = weights.dot(&excess) / size;
    Threshold {
        density: span,
        proof: Some(units.separation(&weights)),
        gap: (span - size).abs() / span.abs().max(f64::MIN_POSITIVE),
    }
}

fn project(weights: &DVector<f64>, is_bounded: &[bool]) -> DVector<f64> {
    let entry = |i: usize, _| {
        if is_bounded[i] {
            weights[i].max(0.0)
        } else {
            weights[i]
        }
    };
    DVector::from_fn(weights.len(), entry)
}

/// Returns ∫(u·A m)₊.
fn reach(units: &InUnits, weights: &DVector<f64>) -> f64 {
    let moments = units.positive(&units.quadric(weights)).moments;
    weights.dot(&(&units.rows * moments))
}

/// Returns ½(∫(v·A m)₊)² − v·F and its derivatives by v, where F turns its sign with v.
fn visit(units: &InUnits, excess: &DVector<f64>, v: DVector<f64>) -> Signed {
    let positive = units.positive(&units.quadric(&v));
    let slope = &units.rows * positive.moments;
    let size = v.dot(&slope);
    let hessian = &slope * slope.transpose() + units.between_rows(&positive.derivative) * size;
    Signed {
        size,
        slope,
        hessian,
        v,
        excess: excess.clone(),
        trace: units.full_trace(),
    }
}

/// The parts of the programme before the sign of u is put in.
struct Signed {
    size: f64,
    slope: DVector<f64>,
    hessian: nalgebra::DMatrix<f64>,
    v: DVector<f64>,
    excess: DVector<f64>,
    trace: f64,
}

impl Signed {
    /// Returns the function of u = sign · v.
    fn turned(self, sign: f64) -> Local {
        let u = self.v * sign;
        Local {
            value: 0.5 * self.size * self.size - u.dot(&self.excess),
            gradient: self.slope * (self.size * sign) - self.excess,
            hessian: self.hessian,
            full_trace: self.trace,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::verdict::Verdict;
    use crate::geom::Quadric;
    use crate::hollow::change::least_change;
    use crate::hollow::graded::Row;
    use crate::interior::Columns;
    use crate::mass::Moments;

    /// Returns a rod along z of these ends.
    fn rod(ends: [f64; 2]) -> Columns {
        Columns {
            pitch_mm: [1.0; 2],
            centers: vec![[0.5, 0.5]],
            starts: vec![0, 1],
            intervals: vec![ends],
        }
    }

    fn centered() -> [Row; 1] {
        [Row::zero(Quadric([0., 0., 0., 1., 0., 0., 0., 0., 0., 0.]))]
    }

    #[test]
    fn a_rod_balances_about_a_point_by_the_ratio_of_the_squares_of_its_arms() {
        // Arms 1 and 3: low · 9/2 = high · 1/2 at the least.
        let columns = rod([-1.0, 3.0]);
        let rows = centered();
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        let low = greatest_low(&graded, 0.9);
        assert!(
            (low.density - 0.1).abs() < 1e-9 && low.gap < 1e-9,
            "{low:?}"
        );
        let high = least_high(&graded, 0.05);
        assert!((high.density - 0.45).abs() < 1e-9, "{high:?}");
        let solves = |low, high| {
            let range = DensityRange::new(low, high).unwrap();
            matches!(least_change(&graded, range, 0.5), Verdict::Found(_))
        };
        assert!(solves(0.0999, 0.9) && !solves(0.1001, 0.9));
        assert!(solves(0.05, 0.4501) && !solves(0.05, 0.4499));
    }

    #[test]
    fn a_rod_with_a_heavy_shell_has_no_density_that_balances_it() {
        // A shell mass of 10 at z = 1: even with the long arm empty, the short one is too light.
        let columns = rod([-1.0, 3.0]);
        let rows = centered();
        let mut shell = Moments::default();
        shell.0[..4].copy_from_slice(&[10.0, 5.0, 5.0, 10.0]);
        let graded = Graded {
            shell,
            columns: &columns,
            rows: &rows,
        };
        let low = greatest_low(&graded, 1.0);
        assert!(low.density < 0.0, "{low:?}");
        // F = 10 + (9 − 1)/2 = 14 and ∫(u z)₊ = 9/2 a unit of u: the span is 28/9.
        assert!((low.density - (1.0 - 28.0 / 9.0)).abs() < 1e-9);
    }

    #[test]
    fn a_body_that_is_balanced_needs_no_range() {
        let columns = rod([-2.0, 2.0]);
        let rows = centered();
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        assert_eq!(greatest_low(&graded, 0.8).density, 0.8);
    }
}
