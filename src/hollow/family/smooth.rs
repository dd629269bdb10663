//! The smooth fields themselves, over the columns.

use std::f64::consts::TAU;

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use super::shape::Shape;
use super::state::{State, quadric_slopes};
use super::task::Task;
use crate::field::DensityRange;
use crate::geom::{Point, Vector};
use crate::hollow::dual::units::Vector10;
use crate::hollow::graded::InUnits;
use crate::interior::{Columns, integrals_between};
use crate::mass::{Moments, gauss_jacobi};

/// Stretches of a column over a length of a wave.
const STRETCHES_A_WAVE: f64 = 3.0;
/// Points of the Gauss rule over a stretch.
const POINTS: usize = 4;
/// Columns that are summed in one go; the bits do not depend on the number of threads.
const BLOCK_COLUMNS: usize = 256;

/// Returns the moments of a body with a smooth field inside, and the mean change of its interior.
pub(super) fn smooth(units: &InUnits, task: &Task, shape: &Shape) -> (State, f64) {
    match *shape {
        Shape::Ramp { .. } => ramp(units, task, shape),
        Shape::Sine { center, wave_mm } => sine(units, task, &center, wave_mm),
    }
}

/// As for the least change: the quadric is minus the density, and the wished density is 0.
fn ramp(units: &InUnits, task: &Task, shape: &Shape) -> (State, f64) {
    let (low, high) = (task.range.low(), task.range.high());
    let quadric = shape.quadric();
    let between = integrals_between(task.graded.columns, &quadric, [-high, -low]);
    let coefficients = Vector10::from(quadric.0);
    let inside = between.gram * coefficients;
    let interior = between.below * high + between.above * low - Moments(inside.into());
    let gram = units.pairs_to_units(&between.gram);
    // ∫ (d − w)² over the slab, with d = −q.
    let w = task.wished;
    let squares = coefficients.dot(&inside) + 2.0 * w * inside[0] + w * w * between.inside.0[0];
    let beyond = (high - w).powi(2) * between.below.0[0] + (low - w).powi(2) * between.above.0[0];
    let volume = task.graded.columns.moments().0[0].max(f64::MIN_POSITIVE);
    let state = State {
        moments: units.shell + units.to_units(&interior),
        slopes: -gram * quadric_slopes(units, shape),
    };
    (state, 0.5 * (squares + beyond) / volume)
}

/// Sums over a column: ten moments, their slopes by centre and number, and the change.
type Sums = SMatrix<f64, 11, 5>;

fn sine(units: &InUnits, task: &Task, center: &Point, wave_mm: f64) -> (State, f64) {
    let columns = task.graded.columns;
    let rule = gauss_jacobi(POINTS, 0);
    let wave = Wave {
        center,
        number: TAU / wave_mm,
        range: task.range,
        wished: task.wished,
    };
    let block = |first: usize| {
        let last = columns.len().min(first + BLOCK_COLUMNS);
        (first..last).fold(Sums::zeros(), |sums, index| {
            sums + wave.over_column(columns, index, &rule)
        })
    };
    let firsts: Vec<usize> = (0..columns.len()).step_by(BLOCK_COLUMNS).collect();
    let blocks: Vec<Sums> = firsts.into_par_iter().map(block).collect();
    let sums = blocks
        .iter()
        .fold(Sums::zeros(), |sums, block| sums + block);
    let area = columns.pitch_mm[0] * columns.pitch_mm[1];
    let moments = |column: usize| {
        let own: [f64; 10] = std::array::from_fn(|i| sums[(i, column)] * area);
        units.to_units(&Moments(own))
    };
    let length_mm = units.length_mm();
    let slopes = [1, 2, 3, 4].map(|column| match column {
        4 => moments(column) / length_mm,
        _ => moments(column) * length_mm,
    });
    let state = State {
        moments: units.shell + moments(0),
        slopes: SMatrix::from_columns(&slopes),
    };
    let volume = columns.moments().0[0].max(f64::MIN_POSITIVE);
    (state, sums[(10, 0)] * area / volume)
}

/// A wave about a centre.
struct Wave<'a> {
    center: &'a Point,
    /// 2π over its length, 1/mm.
    number: f64,
    range: DensityRange,
    wished: f64,
}

impl Wave<'_> {
    fn over_column(&self, columns: &Columns, index: usize, rule: &[[f64; 2]]) -> Sums {
        let [x, y] = columns.centers[index];
        let spread = columns.pitch_mm.map(|pitch| pitch * pitch / 12.0);
        let mut sums = Sums::zeros();
        for &[bottom, top] in columns.intervals_of(index) {
            let stretches = (top - bottom) * self.number * STRETCHES_A_WAVE / TAU;
            let count = stretches.ceil().max(1.0);
            let length = (top - bottom) / count;
            for stretch in 0..count as usize {
                let from = bottom + length * stretch as f64;
                for [share, weight] in rule {
                    let at = Point::new(x, y, from + length * share);
                    let mut monomials = Moments::monomials(at.x, at.y, at.z);
                    monomials[7] += spread[0];
                    monomials[8] += spread[1];
                    self.add(&at, &monomials, weight * length, &mut sums);
                }
            }
        }
        sums
    }

    /// Adds a point with its weight.
    fn add(&self, at: &Point, monomials: &[f64; 10], weight: f64, sums: &mut Sums) {
        let from = at - self.center;
        let distance = from.norm();
        let (sin, cos) = (self.number * distance).sin_cos();
        let swing = 0.5 * self.range.span();
        let density = self.range.low() + swing * (1.0 + sin);
        let inward: Vector = from * (-swing * cos * self.number / distance.max(f64::MIN_POSITIVE));
        let values = SVector::<f64, 5>::new(
            density,
            inward.x,
            inward.y,
            inward.z,
            swing * cos * distance,
        );
        for (i, monomial) in monomials.iter().enumerate() {
            for (j, value) in values.iter().enumerate() {
                sums[(i, j)] += weight * monomial * value;
            }
        }
        sums[(10, 0)] += weight * 0.5 * (density - self.wished).powi(2);
    }
}
