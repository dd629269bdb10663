//! The least change of a wished density that meets linear rows: a quadratic density, clamped.
//!
//! ```text
//! minimise ½ ∫ (d − d₀)² dV   over low ≤ d ≤ high   with A s(d) = b, or ≤ b
//! ```
//!
//! The best is d = clamp(d₀ − q, low, high) with q = (Aᵀλ)·m: at most ten unknowns, whatever the
//! resolution. The dual ∫ ½(d − d₀)² + λ·(A s − b) is concave, and its gradient is A s − b. Its
//! Hessian is −A ∫ m mᵀ Aᵀ over { low < d < high }. Newton climbs it in about ten steps.
//! Any λ gives a bound. A dual above the greatest change that the bounds allow proves that no
//! density meets the rows.

use nalgebra::DVector;

use super::dual::units::Vector10;
use super::graded::{Graded, InUnits, Separation};
use super::newton::{Limits, Local, minimise};
use super::range::proof_against;
use crate::base::verdict::Verdict;
use crate::field::{Clamped, DensityRange};
use crate::geom::Quadric;
use crate::interior::{Between, integrals_between};
use crate::mass::Moments;

/// Residual of the rows, in units of the body, at which the ascent ends.
const ACCURACY: Limits = Limits {
    residual: 1e-13,
    steps: 100,
};
/// Residual up to which the rows count as met.
const MET: f64 = 1e-9;
/// Excess of the dual over the greatest change that is more than rounding.
const PROOF_RATIO: f64 = 1e-6;

/// A density that meets the rows with the least change, and its certificate.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// The density is clamp(`wished` − quadric) to the range, in the columns' frame.
    pub quadric: Quadric,
    /// The density it should be near.
    pub wished: f64,
    /// The bounds of the density.
    pub range: DensityRange,
    /// Moments of shell and interior, over the columns.
    pub moments: Moments,
    /// Mean of ½(d − wished)² over the interior.
    pub cost: f64,
    /// Lower bound of that mean for every density that meets the rows.
    pub bound: f64,
    /// Largest error of a row, in units of the body's volume and radius of gyration.
    pub residual: f64,
    /// Multipliers of the rows in these units.
    pub multipliers: Vec<f64>,
    /// Newton steps.
    pub steps: usize,
}

impl Change {
    /// Returns the density as a field in the columns' frame.
    pub fn field(&self) -> Clamped {
        Clamped::new(self.quadric, self.wished, self.range)
    }
}

/// Finds the least change of the density `wished` that meets the rows, or the proof that no density
/// in the range does.
///
/// Exact for the columns: rows are met to about 1e-12 and the gap between cost and bound is of that
/// order. Costs 4 to 15 passes. Within about 1e-6 of the least range that does it, the rows may be
/// met less well: the residual says so.
pub fn least_change(
    graded: &Graded,
    range: DensityRange,
    wished: f64,
) -> Verdict<Change, Separation> {
    let problem = ChangeProblem {
        units: InUnits::new(graded),
        graded,
        range,
        wished,
    };
    let greatest = problem.greatest_cost();
    let mut proof = None;
    let visit = |weights: &DVector<f64>| {
        let state = problem.at(weights);
        if state.dual > greatest * (1.0 + PROOF_RATIO) + PROOF_RATIO * PROOF_RATIO {
            proof = Some(weights.clone());
            return None;
        }
        Some(problem.local(&state))
    };
    let start = DVector::zeros(graded.rows.len());
    let found = minimise(start, &problem.units.is_bounded, ACCURACY, visit);
    match (found, proof) {
        (Some(found), _) => {
            let change = problem.change(&found.at, found.steps);
            // An ascent without an end climbs slowly where almost all is clamped.
            let unmet = Some(change.residual).filter(|residual| *residual > MET);
            let proof = unmet.and_then(|_| proof_against(graded, range));
            proof.map_or(Verdict::Found(change), Verdict::No)
        }
        (None, weights) => {
            let weights = weights.unwrap_or_else(|| DVector::zeros(graded.rows.len()));
            Verdict::No(problem.units.separation(&weights))
        }
    }
}

struct ChangeProblem<'a> {
    units: InUnits<'a>,
    graded: &'a Graded<'a>,
    range: DensityRange,
    wished: f64,
}

/// The density of some multipliers, and the dual there; in units.
struct State {
    quadric: Quadric,
    between: Between,
    moments: Vector10,
    cost: f64,
    dual: f64,
    excess: DVector<f64>,
}

impl ChangeProblem<'_> {
    /// Returns the greatest change that the bounds allow.
    fn greatest_cost(&self) -> f64 {
        let change = |end: f64| 0.5 * (end - self.wished).powi(2);
        change(self.range.low()).max(change(self.range.high())) * self.units.interior[0]
    }

    fn at(&self, weights: &DVector<f64>) -> State {
        let quadric = self.units.quadric(weights);
        let levels = [self.range.high(), self.range.low()].map(|end| self.wished - end);
        let between = integrals_between(self.graded.columns, &quadric, levels);
        let gradient = Vector10::from(quadric.0);
        let changed = between.gram * gradient;
        let inside = between.inside * self.wished - Moments(changed.into());
        let interior =
            between.below * self.range.high() + between.above * self.range.low() + inside;
        let moments = self.units.shell + self.units.to_units(&interior);
        let clamped = |part: &Moments, end: f64| {
            0.5 * (end - self.wished).powi(2) * self.units.to_units(part)[0]
        };
        let within = self.units.to_units(&Moments([gradient.dot(&changed); 10]))[0];
        let cost = 0.5 * within
            + clamped(&between.above, self.range.low())
            + clamped(&between.below, self.range.high());
        let excess = self.units.excess(&moments);
        let dual = cost + weights.dot(&excess);
        State {
            quadric,
            between,
            moments,
            cost,
            dual,
            excess,
        }
    }

    fn local(&self, state: &State) -> Local {
        let gram = self.units.pairs_to_units(&state.between.gram);
        self.units.negated(state.dual, &state.excess, &gram)
    }

    fn change(&self, weights: &DVector<f64>, steps: usize) -> Change {
        let state = self.at(weights);
        let volume = self.units.interior[0];
        let bounded = state.excess.iter().zip(&self.units.is_bounded);
        let errors = bounded.map(|(excess, is_bounded)| match is_bounded {
            true => excess.max(0.0),
            false => excess.abs(),
        });
        Change {
            quadric: state.quadric,
            wished: self.wished,
            range: self.range,
            moments: self.units.to_mm(&state.moments),
            cost: state.cost / volume,
            bound: state.dual / volume,
            residual: errors.fold(0.0, f64::max),
            multipliers: weights.iter().copied().collect(),
            steps,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::geom::{Frame, Point, Vector};
    use crate::hollow::graded::{Row, Sense};
    use crate::hollow::range::greatest_low;
    use crate::hollow::testing::leaning_block;
    use crate::interior::Columns;

    /// Returns the row of one moment.
    pub(crate) fn moment(index: usize) -> Quadric {
        Quadric(std::array::from_fn(|i| if i == index { 1.0 } else { 0.0 }))
    }

    fn range(low: f64, high: f64) -> DensityRange {
        DensityRange::new(low, high).unwrap()
    }

    /// Returns the integrals of m, ½(d − wished)² and 1 over the columns, for a density of the
    /// cell means, by slices.
    fn by_slices(columns: &Columns, wished: f64, density: impl Fn(&Point) -> f64) -> [f64; 12] {
        const SLICES: u32 = 400;
        let mut sums = [0.0; 12];
        for index in 0..columns.len() {
            let [x, y] = columns.centers[index];
            for &[bottom, top] in columns.intervals_of(index) {
                let height = (top - bottom) / f64::from(SLICES);
                for slice in 0..SLICES {
                    let at = Point::new(x, y, bottom + (f64::from(slice) + 0.5) * height);
                    let (density, volume) = (density(&at), 0.25 * height);
                    let mut monomials = Moments::monomials(at.x, at.y, at.z);
                    monomials[7] += 0.25 / 12.0;
                    monomials[8] += 0.25 / 12.0;
                    for (sum, monomial) in sums.iter_mut().zip(monomials) {
                        *sum += monomial * volume * density;
                    }
                    sums[10] += 0.5 * (density - wished).powi(2) * volume;
                    sums[11] += volume;
                }
            }
        }
        sums
    }

    #[test]
    fn the_least_change_meets_its_rows_and_its_bound() {
        let columns = leaning_block(0.5);
        let rows = [1, 2, 6, 5].map(|index| Row::zero(moment(index)));
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        let change = least_change(&graded, range(0.15, 1.0), 0.575)
            .found()
            .unwrap();
        assert!(change.residual <= 1e-10, "{}", change.residual);
        assert!((change.cost - change.bound).abs() <= 1e-9 * change.cost.max(1.0));
        assert!(
            change.cost > 1e-3 && change.steps <= 15,
            "{} {}",
            change.cost,
            change.steps
        );
        // The conditions of Karush, Kuhn and Tucker: the density is the clamped quadric itself.
        // Slices of 0.013 mm integrate it to 1e-5.
        let [xx, yy] = [change.quadric.0[7], change.quadric.0[8]];
        let density = |at: &Point| {
            let mean = change.quadric.value(at) + (xx + yy) * 0.25 / 12.0;
            (0.575 - mean).clamp(0.15, 1.0)
        };
        let sums = by_slices(&columns, 0.575, density);
        for (got, want) in change.moments.0.iter().zip(sums) {
            assert!((got - want).abs() < 1e-4 * sums[11], "{got} {want}");
        }
        assert!((change.cost - sums[10] / sums[11]).abs() < 1e-5);
    }

    #[test]
    fn no_other_density_that_meets_the_rows_is_nearer() {
        // Other densities: clamped sums of the best and random waves, with their own rows as
        // wanted values. Each is dearer than the least change for those values.
        let columns = leaning_block(0.5);
        let mut random = Random::new(23);
        for _ in 0..10 {
            let wave: [f64; 4] = std::array::from_fn(|_| random.between(-1.0, 1.0));
            let density = |at: &Point| {
                let value = wave[0] * at.x + wave[1] * at.y + wave[2] * at.z + 3.0 * wave[3];
                (0.5 + 0.5 * value.sin()).clamp(0.2, 0.9)
            };
            let sums = by_slices(&columns, 0.6, density);
            let rows = [0, 1, 2, 3, 5, 6].map(|index| Row {
                quadric: moment(index),
                wanted: sums[index],
                sense: Sense::Equal,
            });
            let graded = Graded {
                shell: Moments::default(),
                columns: &columns,
                rows: &rows,
            };
            let change = least_change(&graded, range(0.2, 0.9), 0.6).found().unwrap();
            assert!(change.residual <= 1e-10, "{}", change.residual);
            assert!(change.bound <= sums[10] / sums[11] + 1e-6);
        }
    }

    #[test]
    fn rows_that_are_met_change_nothing_and_inequalities_hold_with_their_signs() {
        let columns = leaning_block(0.5);
        let whole = columns.moments();
        let at_most = |wanted| Row {
            quadric: moment(0),
            wanted,
            sense: Sense::AtMost,
        };
        let rows = [at_most(0.7 * whole.volume())];
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        let slack = least_change(&graded, range(0.1, 1.0), 0.6).found().unwrap();
        assert!(slack.cost < 1e-20 && slack.multipliers == [0.0]);
        let rows = [at_most(0.5 * whole.volume()), Row::zero(moment(1))];
        let graded = Graded {
            rows: &rows,
            ..graded
        };
        let tight = least_change(&graded, range(0.1, 1.0), 0.6).found().unwrap();
        assert!((tight.moments.volume() / whole.volume() - 0.5).abs() < 1e-10);
        assert!(tight.multipliers[0] > 0.0 && tight.residual < 1e-10);
        assert!((tight.cost - tight.bound).abs() <= 1e-9);
    }

    #[test]
    fn rows_out_of_reach_are_refused_with_a_proof() {
        let columns = leaning_block(0.5);
        let whole = columns.moments();
        // The centre two millimetres outside the block.
        let mut row = moment(1);
        row.0[0] = -9.0;
        let rows = [Row::zero(row)];
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        let Verdict::No(proof) = least_change(&graded, range(0.1, 1.0), 0.5) else {
            unreachable!("no density has its centre outside")
        };
        // The quadric has one sign all over the block, so no positive density integrates to zero.
        let signs = columns
            .centers
            .iter()
            .map(|&[x, y]| proof.quadric.value(&Point::new(x, y, 0.)));
        assert!(signs.clone().all(|value| value > 0.0) && whole.volume() > 0.0);
    }

    #[test]
    fn rows_barely_out_of_reach_are_refused_and_barely_within_are_met() {
        let columns = leaning_block(0.5);
        let origin = columns.moments().centroid() + Vector::new(0.1, -0.2, 0.3);
        let tilted = Frame::with_axis(origin, &Vector::new(0.3, -0.4, 0.85));
        let rows = [1, 2, 3, 6].map(|index| Row::zero(moment(index).in_frame(&tilted.inverse())));
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        let low = greatest_low(&graded, 1.0).density;
        assert!(low > 0.1, "{low}");
        for shift in [1e-4, 1e-2, 0.1] {
            let verdict = |low| least_change(&graded, range(low, 1.0), 0.5 + 0.5 * low);
            assert!(
                matches!(verdict(low + shift), Verdict::No(_)),
                "{low} + {shift}"
            );
            if low > shift {
                let change = verdict(low - shift).found().unwrap();
                assert!(
                    change.residual < 1e-9,
                    "{low} − {shift}: {}",
                    change.residual
                );
            }
        }
    }

    #[test]
    fn a_wished_density_at_a_bound_is_no_hindrance() {
        let columns = leaning_block(0.5);
        let rows = [1, 2].map(|index| Row::zero(moment(index)));
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        for wished in [1.0, 0.1, 1.2] {
            let change = least_change(&graded, range(0.1, 1.0), wished)
                .found()
                .unwrap();
            assert!(change.residual <= 1e-10, "{wished}: {}", change.residual);
            assert!((change.cost - change.bound).abs() <= 1e-9, "{wished}");
        }
    }
}
