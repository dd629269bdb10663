//! The fit of smooth fields to rows, as a paper asks for it.

use super::shape::{Family, Shape};
use super::starts::{Fitted, MET, compare, fit_all};
use super::task::Task;
use crate::field::DensityRange;
use crate::hollow::graded::{Graded, InUnits, Row};
use crate::mass::Moments;

/// The end of many fits of a smooth field to rows.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothFit {
    /// The field with the least change among those that meet the rows, or else the nearest.
    pub shape: Shape,
    /// Its greatest miss of a row, in units of the body's volume and radius of gyration.
    pub miss: f64,
    /// Mean of ½(d − wished)² over the interior.
    pub cost: f64,
    /// Moments of shell and interior.
    pub moments: Moments,
    /// Starts.
    pub starts: usize,
    /// Starts that ended at a field that meets the rows.
    pub found: usize,
}

/// Fits the smooth fields of a family between two densities to rows, from many starts.
pub fn fit_smooth(graded: &Graded, family: Family, range: DensityRange, wished: f64) -> SmoothFit {
    let units = InUnits::new(graded);
    let touching = |_: &Moments| -> Vec<Row> { Vec::new() };
    let task = Task {
        graded,
        units: &units,
        touching: &touching,
        family,
        range,
        wished,
    };
    let fits = fit_all(&task);
    let found = fits.iter().filter(|fit| fit.miss <= MET).count();
    let nearest = fits
        .iter()
        .min_by(|a, b| compare([a.miss, a.cost], [b.miss, b.cost]));
    let best = nearest.copied().unwrap_or(Fitted {
        shape: Shape::uniform(wished),
        miss: f64::INFINITY,
        cost: f64::INFINITY,
        moments: units.shell,
    });
    SmoothFit {
        shape: best.shape,
        miss: best.miss,
        cost: best.cost,
        moments: units.to_mm(&best.moments),
        starts: fits.len(),
        found,
    }
}

#[cfg(test)]
mod tests {
    use super::super::shape::Numbers;
    use super::super::smooth::smooth;
    use super::*;
    use crate::geom::{Frame, Quadric, Vector};
    use crate::hollow::change::least_change;
    use crate::hollow::golden::golden_section;
    use crate::hollow::testing::leaning_block;
    use crate::interior::Columns;

    /// Sweeps of Powell's search.
    const SWEEPS: usize = 60;

    fn range() -> DensityRange {
        DensityRange::new(0.15, 1.0).unwrap()
    }

    /// Returns rows for some moments about a point beside the block's centre, in a tilted frame.
    fn rows(columns: &Columns, moments: &[usize]) -> Vec<Row> {
        let one = |index: usize| Quadric(std::array::from_fn(|i| f64::from(u8::from(i == index))));
        let origin = columns.moments().centroid() + Vector::new(0.1, -0.2, 0.3);
        let tilted = Frame::with_axis(origin, &Vector::new(0.3, -0.4, 0.85));
        let row = |index: &usize| Row::zero(one(*index).in_frame(&tilted.inverse()));
        moments.iter().map(row).collect()
    }

    fn graded<'a>(columns: &'a Columns, rows: &'a [Row]) -> Graded<'a> {
        Graded {
            shell: Moments::default(),
            columns,
            rows,
        }
    }

    #[test]
    fn with_only_the_centre_prescribed_the_least_change_is_a_ramp_and_the_fit_finds_it() {
        let columns = leaning_block(0.5);
        let rows = rows(&columns, &[1, 2, 3]);
        let graded = graded(&columns, &rows);
        let least = least_change(&graded, range(), 0.575).found().unwrap();
        let curved = least.quadric.0[4..].iter().map(|c| c.abs());
        assert!(curved.fold(0.0, f64::max) < 1e-12, "{:?}", least.quadric);
        let fit = fit_smooth(&graded, Family::Ramp, range(), 0.575);
        assert!(fit.miss < 1e-9 && fit.found > fit.starts / 2, "{fit:?}");
        assert!(
            (fit.cost - least.cost).abs() < 1e-9,
            "{} {}",
            fit.cost,
            least.cost
        );
    }

    #[test]
    fn with_the_axis_prescribed_too_a_field_of_a_family_costs_more_than_the_least_change() {
        let columns = leaning_block(0.5);
        let rows = rows(&columns, &[1, 2, 6, 5]);
        let graded = graded(&columns, &rows);
        let least = least_change(&graded, range(), 0.575).found().unwrap();
        let fit = fit_smooth(&graded, Family::Ramp, range(), 0.575);
        assert!(fit.miss >= 1e-7 || fit.cost > 1.001 * least.cost, "{fit:?}");
        let fit = fit_smooth(&graded, Family::Sine, DensityRange::FULL, 0.5);
        let least = least_change(&graded, DensityRange::FULL, 0.5)
            .found()
            .unwrap();
        assert!(fit.miss >= 1e-7 || fit.cost > 1.001 * least.cost, "{fit:?}");
    }

    #[test]
    fn what_weighs_nothing_does_not_count_as_balanced() {
        let columns = leaning_block(1.0);
        // The centre far outside: only a body of nothing has it there.
        let mut row = Quadric([0.0; 10]);
        (row.0[0], row.0[1]) = (-90.0, 1.0);
        let rows = [Row::zero(row)];
        let graded = graded(&columns, &rows);
        let fit = fit_smooth(&graded, Family::Ramp, DensityRange::FULL, 0.5);
        assert!(fit.found == 0 && fit.miss > 1e-7, "{fit:?}");
    }

    #[test]
    fn the_slopes_of_smooth_fields_are_differences_of_their_moments() {
        const STEP: f64 = 1e-5;
        let columns = leaning_block(0.5);
        let graded = graded(&columns, &[]);
        let units = InUnits::new(&graded);
        let touching = |_: &Moments| -> Vec<Row> { Vec::new() };
        for (family, numbers) in [
            (Family::Ramp, Numbers::new(0.5, 0.3, -0.2, 0.4)),
            (Family::Sine, Numbers::new(0.3, -0.4, 1.2, 3.0)),
        ] {
            let task = Task {
                graded: &graded,
                units: &units,
                touching: &touching,
                family,
                range: range(),
                wished: 0.5,
            };
            let state = |numbers: &Numbers| {
                let shape = Shape::of_numbers(family, numbers, units.length_mm());
                smooth(&units, &task, &shape).0
            };
            let slopes = state(&numbers).slopes;
            for index in 0..4 {
                let moved = |sign: f64| {
                    let mut moved = numbers;
                    moved[index] += sign * STEP;
                    state(&moved).moments
                };
                let difference = (moved(1.0) - moved(-1.0)) / (2.0 * STEP);
                let off = (difference - slopes.column(index)).amax();
                assert!(off < 1e-6, "{family:?} {index}: {off}");
            }
        }
    }

    /// Returns the least value that Powell's search finds from a start: line searches along
    /// directions, the last of which is that of the whole sweep.
    fn powell(start: Numbers, value: impl Fn(&Numbers) -> f64) -> f64 {
        let mut at = start;
        let mut directions: Vec<Numbers> = (0..4).map(|i| Numbers::ith(i, 0.3)).collect();
        for _ in 0..SWEEPS {
            let before = at;
            for direction in &directions {
                at = along(&at, direction, &value);
            }
            let whole = at - before;
            if whole.norm() < 1e-12 {
                break;
            }
            directions.remove(0);
            directions.push(whole);
            at = along(&at, &whole, &value);
        }
        value(&at)
    }

    /// Returns the best place on a line, or the start if none is better.
    fn along(at: &Numbers, direction: &Numbers, value: &impl Fn(&Numbers) -> f64) -> Numbers {
        let sample = |t: f64| (t, value(&(at + direction * t)));
        let is_better = |a: &(f64, f64), b: &(f64, f64)| a.1 < b.1;
        let mut best = (0.0, value(at));
        for ends in [[-4.0, 4.0], [-0.3, 0.3], [-0.01, 0.01]] {
            let found = golden_section(ends, 40, sample, is_better);
            for found in found {
                if is_better(&found, &best) {
                    best = found;
                }
            }
        }
        at + direction * best.0
    }

    #[test]
    fn powells_search_of_the_paper_ends_nowhere_below_the_best_fit() {
        let columns = leaning_block(0.5);
        let rows = rows(&columns, &[1, 2, 6, 5]);
        let graded = graded(&columns, &rows);
        let units = InUnits::new(&graded);
        let touching = |_: &Moments| -> Vec<Row> { Vec::new() };
        for family in [Family::Ramp, Family::Sine] {
            let task = Task {
                graded: &graded,
                units: &units,
                touching: &touching,
                family,
                range: range(),
                wished: 0.575,
            };
            let fit = fit_smooth(&graded, family, range(), 0.575);
            let sum = |numbers: &Numbers| {
                let shape = Shape::of_numbers(family, numbers, units.length_mm());
                let state = smooth(&units, &task, &shape).0;
                units.excess(&state.moments).norm()
            };
            // From the fit it finds nothing better, and from elsewhere nothing much lower.
            let own = fit.shape.numbers(units.length_mm());
            let best = sum(&own);
            assert!(powell(own, sum) > best - 1e-6, "{family:?}");
            let nearby = own + Numbers::new(0.05, -0.05, 0.04, 0.06);
            let found = powell(nearby, sum);
            assert!(
                found > best - 1e-6 && found < best + 0.02,
                "{family:?} {best} {found}"
            );
        }
    }
}
