//! The least change with a few printable densities: nested level sets of one quadric.
//!
//! Between the levels l₁ < … < l_N the cost ½(d − d₀)² is replaced by its chords. Then the best is
//! d = lᵢ where cᵢ₋₁ < −q < cᵢ, with cᵢ = (lᵢ + lᵢ₊₁)/2 − d₀. Nothing is rounded, and the rows are
//! met exactly. It costs at most (lᵢ₊₁ − lᵢ)²/8 a unit of volume more than the smooth best.

use nalgebra::DVector;

use super::change::{Change, least_change};
use super::dual::units::Vector10;
use super::graded::{Graded, InUnits, Separation};
use super::newton::{Limits, Local, minimise};
use crate::base::verdict::Verdict;
use crate::field::{DensityRange, Levels, LevelsError, RangeError};
use crate::geom::Quadric;
use crate::interior::Matrix10;
use crate::mass::Moments;

/// Residual of the rows, in units of the body, at which the ascent ends.
const ACCURACY: Limits = Limits {
    residual: 1e-11,
    steps: 100,
};
/// Excess of the dual over the greatest change that is more than rounding.
const PROOF_RATIO: f64 = 1e-6;
/// Fewest levels: two have no scale, and their best is that of the two densities.
const MIN_LEVELS: usize = 3;
/// Most levels: slicers take a modifier for each.
const MAX_LEVELS: usize = 12;

/// A few densities that meet the rows with the least change, and the certificate.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelChange {
    /// The quadric q: the density rises as q falls. In the columns' frame.
    pub quadric: Quadric,
    /// The densities, ascending.
    pub densities: Vec<f64>,
    /// Values of −q between them, ascending.
    pub cuts: Vec<f64>,
    /// Moments of shell and interior, over the columns.
    pub moments: Moments,
    /// Mean over the interior of ½(d − wished)².
    pub cost: f64,
    /// Lower bound of that mean for every mixture of these densities that meets the rows.
    pub bound: f64,
    /// Largest error of a row, in units of the body's volume and radius of gyration.
    pub residual: f64,
    /// Newton steps after those of the smooth change.
    pub steps: usize,
}

/// A reason why densities are no levels.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LevelCountError {
    /// There are too few or too many.
    #[error("{0} levels; remedy: use {MIN_LEVELS} to {MAX_LEVELS}, or two densities at their best")]
    Count(usize),
    /// They do not ascend.
    #[error("the levels do not ascend; remedy: sort them")]
    Order,
    /// They are not densities.
    #[error(transparent)]
    Range(#[from] RangeError),
}

/// Levels, proved to ascend within [0, 1] and to be three to twelve.
#[derive(Debug, Clone, PartialEq)]
pub struct PrintLevels {
    densities: Vec<f64>,
    range: DensityRange,
}

impl PrintLevels {
    /// Checks the densities.
    ///
    /// # Errors
    /// There are fewer than three or more than twelve, they do not ascend, or one is no density.
    pub fn new(densities: Vec<f64>) -> Result<Self, LevelCountError> {
        if !(MIN_LEVELS..=MAX_LEVELS).contains(&densities.len()) {
            return Err(LevelCountError::Count(densities.len()));
        }
        // Numbers that are none do not ascend either.
        if !densities.windows(2).all(|pair| pair[0] < pair[1]) {
            return Err(LevelCountError::Order);
        }
        let range = DensityRange::new(densities[0], densities[densities.len() - 1])?;
        Ok(Self { densities, range })
    }

    /// Returns `count` densities at equal steps over a range.
    ///
    /// # Errors
    /// The count is below three or above twelve.
    pub fn even(range: DensityRange, count: usize) -> Result<Self, LevelCountError> {
        let steps = count.saturating_sub(1).max(1) as f64;
        let level = |i: usize| range.low() + range.span() * i as f64 / steps;
        Self::new(
            (0..count)
                .map(|i| {
                    if i + 1 == count {
                        range.high()
                    } else {
                        level(i)
                    }
                })
                .collect(),
        )
    }

    /// Returns the densities, ascending.
    pub fn densities(&self) -> &[f64] {
        &self.densities
    }

    /// Returns the least and the greatest.
    pub fn range(&self) -> DensityRange {
        self.range
    }
}

impl LevelChange {
    /// Returns the density as a field in the columns' frame.
    ///
    /// # Errors
    /// A coefficient is not finite.
    pub fn field(&self) -> Result<Levels, LevelsError> {
        let turned = Quadric(self.quadric.0.map(|coefficient| -coefficient));
        Levels::new(turned, self.cuts.clone(), self.densities.clone())
    }
}

/// Finds the least change of the density `wished` with these levels, or the proof that none does.
///
/// Starts from the smooth change. The rows are met to about 1e-11, unless whole columns change at
/// once. That happens if a level set is upright in the columns' frame, and the residual says so.
/// Columns in a tilted frame have no such level sets.
pub fn least_level_change(
    graded: &Graded,
    levels: &PrintLevels,
    wished: f64,
) -> Verdict<LevelChange, Separation> {
    let smooth = match least_change(graded, levels.range(), wished) {
        Verdict::Found(smooth) => smooth,
        Verdict::No(proof) => return Verdict::No(proof),
    };
    let problem = LevelProblem::new(graded, levels, wished);
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
    let Change { multipliers, .. } = smooth;
    let start = DVector::from_vec(multipliers);
    let found = minimise(start, &problem.units.is_bounded, ACCURACY, visit);
    match (found, proof) {
        (Some(found), _) => Verdict::Found(problem.change(&found.at, found.steps)),
        (None, weights) => {
            let weights = weights.unwrap_or_else(|| DVector::zeros(graded.rows.len()));
            Verdict::No(problem.units.separation(&weights))
        }
    }
}

struct LevelProblem<'a> {
    units: InUnits<'a>,
    densities: &'a [f64],
    cuts: Vec<f64>,
    wished: f64,
}

/// The levels of some multipliers, and the dual there; in units.
struct State {
    quadric: Quadric,
    moments: Vector10,
    curvature: Matrix10,
    cost: f64,
    dual: f64,
    excess: DVector<f64>,
}

impl<'a> LevelProblem<'a> {
    fn new(graded: &'a Graded, levels: &'a PrintLevels, wished: f64) -> Self {
        let densities = levels.densities();
        let cut = |pair: &[f64]| 0.5 * (pair[0] + pair[1]) - wished;
        let cuts = densities.windows(2).map(cut).collect();
        Self {
            units: InUnits::new(graded),
            densities,
            cuts,
            wished,
        }
    }

    fn change_of(&self, density: f64) -> f64 {
        0.5 * (density - self.wished).powi(2)
    }

    /// Returns the greatest change that the levels allow.
    fn greatest_cost(&self) -> f64 {
        let costs = self
            .densities
            .iter()
            .map(|density| self.change_of(*density));
        costs.fold(0.0, f64::max) * self.units.interior[0]
    }

    fn at(&self, weights: &DVector<f64>) -> State {
        let quadric = self.units.quadric(weights);
        let first = self.densities[0];
        let mut moments = self.units.shell + self.units.interior * first;
        let mut cost = self.change_of(first) * self.units.interior[0];
        let mut curvature = Matrix10::zeros();
        for (pair, cut) in self.densities.windows(2).zip(&self.cuts) {
            let mut beyond = quadric.0.map(|coefficient| -coefficient);
            beyond[0] -= cut;
            let found = self.units.positive(&Quadric(beyond));
            let step = pair[1] - pair[0];
            moments += found.moments * step;
            curvature += found.derivative * step;
            cost += (self.change_of(pair[1]) - self.change_of(pair[0])) * found.moments[0];
        }
        let excess = self.units.excess(&moments);
        let dual = cost + weights.dot(&excess);
        State {
            quadric,
            moments,
            curvature,
            cost,
            dual,
            excess,
        }
    }

    fn local(&self, state: &State) -> Local {
        self.units
            .negated(state.dual, &state.excess, &state.curvature)
    }

    fn change(&self, weights: &DVector<f64>, steps: usize) -> LevelChange {
        let state = self.at(weights);
        let volume = self.units.interior[0];
        let bounded = state.excess.iter().zip(&self.units.is_bounded);
        let errors = bounded.map(|(excess, is_bounded)| match is_bounded {
            true => excess.max(0.0),
            false => excess.abs(),
        });
        LevelChange {
            quadric: state.quadric,
            densities: self.densities.to_vec(),
            cuts: self.cuts.clone(),
            moments: self.units.to_mm(&state.moments),
            cost: state.cost / volume,
            bound: state.dual / volume,
            residual: errors.fold(0.0, f64::max),
            steps,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Frame, Vector};
    use crate::hollow::graded::Row;
    use crate::hollow::testing::leaning_block;
    use crate::interior::Columns;

    /// Returns rows for a centre beside the block's own, seen from a tilted frame.
    fn rows(columns: &Columns) -> [Row; 3] {
        let one = |index: usize| Quadric(std::array::from_fn(|i| f64::from(u8::from(i == index))));
        let origin = columns.moments().centroid() + Vector::new(0.1, -0.2, 0.3);
        let tilted = Frame::with_axis(origin, &Vector::new(0.3, -0.4, 0.85));
        [1, 2, 3].map(|index| Row::zero(one(index).in_frame(&tilted.inverse())))
    }

    #[test]
    fn a_few_levels_meet_the_rows_and_cost_at_most_an_eighth_of_the_square_of_a_step() {
        let columns = leaning_block(0.25);
        let rows = rows(&columns);
        let graded = Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &rows,
        };
        let range = DensityRange::new(0.15, 1.0).unwrap();
        let smooth = least_change(&graded, range, 0.575).found().unwrap();
        assert!(smooth.residual < 1e-10, "{}", smooth.residual);
        for count in [3, 4, 6, 8, 12] {
            let levels = PrintLevels::even(range, count).unwrap();
            let found = least_level_change(&graded, &levels, 0.575).found().unwrap();
            assert!(found.residual <= 1e-7, "{count}: {}", found.residual);
            let step = range.span() / (count - 1) as f64;
            assert!(found.cost >= smooth.bound - 1e-9, "{count}");
            assert!(
                found.cost <= smooth.cost + step * step / 8.0 + 1e-9,
                "{count}"
            );
            assert!((found.cost - found.bound).abs() <= 1e-6, "{count}");
        }
    }

    #[test]
    fn levels_that_are_none_are_refused() {
        let new = |densities: &[f64]| PrintLevels::new(densities.to_vec());
        assert_eq!(new(&[0.1, 1.0]), Err(LevelCountError::Count(2)));
        assert_eq!(new(&[0.1; 13]), Err(LevelCountError::Count(13)));
        assert_eq!(new(&[0.1, 0.5, 0.5]), Err(LevelCountError::Order));
        assert!(matches!(
            new(&[0.1, 0.5, 1.5]),
            Err(LevelCountError::Range(_))
        ));
        assert_eq!(new(&[0.1, f64::NAN, 1.0]), Err(LevelCountError::Order));
    }
}
