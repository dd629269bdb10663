//! The moments of a field with their slopes, and the misses of rows with theirs.

use nalgebra::{DMatrix, DVector, SMatrix};

use super::regions::Region;
use super::shape::Shape;
use crate::geom::Quadric;
use crate::hollow::dual::units::Vector10;
use crate::hollow::graded::{InUnits, Row, Sense};
use crate::mass::Moments;

/// The moments of a body in the solver's units, and their derivatives by the four numbers.
#[derive(Debug, Clone)]
pub(in crate::hollow) struct State {
    pub moments: Vector10,
    pub slopes: SMatrix<f64, 10, 4>,
}

/// The misses of rows: how far equations are off, and by how much bounds are broken.
#[derive(Debug, Clone)]
pub(super) struct Misses {
    pub values: DVector<f64>,
    pub slopes: DMatrix<f64>,
}

/// Rows, in the columns' frame: some that are fixed, and some that touch convex limits.
pub(in crate::hollow) struct Rows<'a> {
    /// The fixed rows.
    pub fixed: &'a [Row],
    /// The rows that touch the limits at some moments.
    pub touching: &'a (dyn Fn(&Moments) -> Vec<Row> + Sync),
}

impl State {
    pub fn without_slopes(moments: Vector10) -> Self {
        Self {
            moments,
            slopes: SMatrix::zeros(),
        }
    }
}

impl Rows<'_> {
    /// Returns the misses of some moments, in the units of the body.
    pub(super) fn misses(&self, units: &InUnits, state: &State) -> Misses {
        let touching = (self.touching)(&units.to_mm(&state.moments));
        let all: Vec<&Row> = self.fixed.iter().chain(&touching).collect();
        let mut values = DVector::zeros(all.len());
        let mut slopes = DMatrix::zeros(all.len(), 4);
        for (index, row) in all.into_iter().enumerate() {
            let (weights, wanted) = units.row_to_units(row);
            let excess = weights.dot(&state.moments) - wanted;
            if row.sense == Sense::AtMost && excess <= 0.0 {
                continue;
            }
            values[index] = excess;
            slopes.set_row(index, &(weights.transpose() * state.slopes));
        }
        Misses { values, slopes }
    }

    /// Returns the greatest miss of some moments, in the units of the body.
    pub fn greatest_miss(&self, units: &InUnits, moments: &Vector10) -> f64 {
        let state = State::without_slopes(*moments);
        self.misses(units, &state).values.amax()
    }
}

/// Returns the moments of a field that is printed in regions, the outermost first.
pub(in crate::hollow) fn stepped(units: &InUnits, shape: &Shape, regions: &[Region]) -> State {
    let quadric = shape.quadric();
    let slopes = quadric_slopes(units, shape);
    let mut state = State::without_slopes(units.shell);
    let mut around = 0.0;
    for region in regions {
        let step = region.density - around;
        around = region.density;
        let Some(above) = region.above else {
            state.moments += units.interior * step;
            continue;
        };
        let mut beyond = quadric.0;
        beyond[0] -= above;
        let found = units.positive(&Quadric(beyond));
        state.moments += found.moments * step;
        state.slopes += found.derivative * slopes * step;
    }
    state
}

/// Returns the derivatives of a field's quadric by its numbers, in units.
pub(super) fn quadric_slopes(units: &InUnits, shape: &Shape) -> SMatrix<f64, 10, 4> {
    let slopes = shape.quadric_slopes(units.length_mm());
    let columns = slopes.map(|slope| units.quadric_to_units(&slope));
    SMatrix::from_columns(&columns)
}

#[cfg(test)]
mod tests {
    use super::super::regions::regions;
    use super::super::shape::Family;
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::hollow::graded::Graded;
    use crate::hollow::testing::leaning_block;

    #[test]
    fn the_slopes_of_printed_steps_are_differences_of_their_moments() {
        const STEP: f64 = 1e-6;
        let columns = leaning_block(0.25);
        let units = InUnits::new(&Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &[],
        });
        let ramp = Shape::Ramp {
            at_origin: 0.5,
            gradient: Vector::new(0.02, -0.03, 0.08),
        };
        let sine = Shape::Sine {
            center: Point::new(1.0, 2.0, -9.0),
            wave_mm: 11.0,
        };
        for shape in [ramp, sine] {
            let regions = regions(&shape, &[0.2, 0.5, 0.8], &columns);
            let state = stepped(&units, &shape, &regions);
            let numbers = shape.numbers(units.length_mm());
            for index in 0..4 {
                let moved = |sign: f64| {
                    let mut moved = numbers;
                    moved[index] += sign * STEP;
                    let family: Family = shape.family();
                    let shape = Shape::of_numbers(family, &moved, units.length_mm());
                    stepped(&units, &shape, &regions).moments
                };
                let difference = (moved(1.0) - moved(-1.0)) / (2.0 * STEP);
                let off = (difference - state.slopes.column(index)).amax();
                let scale = state.slopes.column(index).amax().max(0.1);
                assert!(off < 1e-2 * scale, "{shape:?} {index}: {off} of {scale}");
            }
        }
    }
}
