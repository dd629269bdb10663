//! The objective of the papers' methods: a goal's formula as a smooth function of the ten moments,
//! and its constraints.

use nalgebra::{DMatrix, DVector};

use super::method::MethodError;
use crate::goal::{Goal, GoalKind, Objective};
use crate::hollow::Problem;
use crate::hollow::dual::programme::Programme;
use crate::hollow::dual::reach::Reach;
use crate::hollow::dual::units::index;
use crate::hollow::dual::units::{Scale, Vector10};
use crate::mass::Moments;

/// Smoothing of the λ_max of a 2 × 2 tensor, as a part of the solid's own moments; its square is
/// added under the root.
///
/// At equal eigenvalues the root has no gradient. λ_max is too large by this much at most. With a
/// tenth of it the optimiser needs three times as many steps if the best interior has equal
/// eigenvalues.
const SMOOTHING: f64 = 1e-4;

/// The formulas with a gradient.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Formula {
    TopFunctional,
    TopDominance,
    TopCriticalSpeed,
    YoyoDominance,
    YoyoFunctional,
    StandLowestCenter,
}

impl Formula {
    /// Selects the formula of a goal. Refuses objectives without a gradient, and goals that the
    /// papers' methods do not cover.
    fn of(method: &'static str, goal: &Goal) -> Result<Self, MethodError> {
        match (goal.kind, goal.objective) {
            (GoalKind::Top, Objective::SpinIt { .. }) => Ok(Self::TopFunctional),
            (GoalKind::Top, Objective::Dominance) => Ok(Self::TopDominance),
            (GoalKind::Top, _) => Ok(Self::TopCriticalSpeed),
            (GoalKind::Yoyo, Objective::Dominance) => Ok(Self::YoyoDominance),
            (GoalKind::Yoyo, _) => Ok(Self::YoyoFunctional),
            (GoalKind::Stand, objective @ Objective::TopplingAngle) => {
                Err(MethodError::NotSmooth { method, objective })
            }
            (GoalKind::Stand, _) => Ok(Self::StandLowestCenter),
            (kind @ (GoalKind::Float | GoalKind::Balance | GoalKind::Match), _) => {
                Err(MethodError::NotItsGoal { method, kind })
            }
        }
    }
}

/// The objective f and the rows A, in units of the solid's volume and radius of gyration.
pub(super) struct Target<'a> {
    goal: &'a Goal,
    formula: Formula,
    reach: Reach<'a>,
    fixed: Moments,
    rows: DMatrix<f64>,
}

impl<'a> Target<'a> {
    /// Builds the objective. Refuses what [`Formula::of`] refuses, and an empty interior.
    pub fn new(method: &'static str, problem: &Problem<'a>) -> Result<Self, MethodError> {
        let formula = Formula::of(method, problem.goal)?;
        if problem.columns.is_empty() {
            return Err(MethodError::NothingToEmpty { method });
        }
        let reach = Reach::new(
            problem.columns,
            &problem.fixed,
            Scale::of(&problem.goal.solid),
        );
        let mut target = Self {
            goal: problem.goal,
            formula,
            reach,
            fixed: problem.fixed,
            rows: DMatrix::zeros(0, 10),
        };
        target.rows = target.constraints();
        Ok(target)
    }

    pub fn scale(&self) -> &Scale {
        &self.reach.scale
    }

    /// Returns the rows A.
    pub fn rows(&self) -> &DMatrix<f64> {
        &self.rows
    }

    /// Returns the moments of the material that stays when `emptied` is removed.
    pub fn remaining(&self, emptied: &Moments) -> Vector10 {
        self.scale().moments_to_units(&(self.fixed - *emptied))
    }

    /// Returns the residuals As.
    pub fn misses(&self, s: &Vector10) -> DVector<f64> {
        &self.rows * s
    }

    /// Returns the largest constraint residual.
    pub fn residual(&self, moments: &Moments) -> f64 {
        self.misses(&self.scale().moments_to_units(moments)).amax()
    }

    /// Returns f and its gradient. Spin-It's functional is the square of the programme's ratio; the
    /// others are the ratio itself.
    pub fn at(&self, s: &Vector10) -> (f64, Vector10) {
        let (ratio, slope) = ratio_at(&self.programme(s), s);
        let Objective::SpinIt { gamma_c, gamma_i } = self.goal.objective else {
            return (ratio, slope);
        };
        let (value, slope) = (gamma_i * ratio * ratio, slope * (2.0 * gamma_i * ratio));
        if gamma_c == 0.0 || self.goal.kind != GoalKind::Top {
            return (value, slope);
        }
        let solid = self.scale().moments_to_units(&self.goal.solid)[index::Z];
        let lever = s[index::Z] / solid;
        let lowering = Vector10::ith(index::Z, 2.0 * gamma_c * lever / solid);
        (value + gamma_c * lever * lever, slope + lowering)
    }

    /// Returns the programme whose ratio at s is f.
    ///
    /// A top's programme depends on the height ℓ of the centre only through 2ℓs_z − ℓ²s₁. The
    /// derivative of that by ℓ vanishes at ℓ = s_z/s₁. So its gradient there is that of the true
    /// tensor.
    fn programme(&self, s: &Vector10) -> Programme {
        let height = s[index::Z] / s[index::ONE];
        match self.formula {
            Formula::TopFunctional => Programme::top_functional(&self.reach, height),
            Formula::TopDominance => Programme::top_dominance(&self.reach, height),
            Formula::TopCriticalSpeed => {
                Programme::top_critical_speed(&self.reach, height, [height; 2])
            }
            Formula::YoyoDominance => Programme::yoyo_dominance(&self.reach),
            Formula::YoyoFunctional => Programme::yoyo_functional(&self.reach),
            Formula::StandLowestCenter => Programme::stand_lowest_center(&self.reach),
        }
    }

    /// Returns the rows of the goal's programme.
    fn constraints(&self) -> DMatrix<f64> {
        self.programme(&self.reach.solid).rows
    }
}

/// Converts ten numbers of dynamic size.
pub(super) fn as_vector10(vector: &DVector<f64>) -> Vector10 {
    Vector10::from_column_slice(vector.as_slice())
}

/// Returns (n·s + √(‖Js‖² + ε²))/(e·s) and its gradient.
fn ratio_at(programme: &Programme, s: &Vector10) -> (f64, Vector10) {
    let along = &programme.directions * s;
    let norm = (along.norm_squared() + SMOOTHING * SMOOTHING).sqrt();
    let slope_of_norm = programme.directions.tr_mul(&along) / norm;
    let length = if along.is_empty() { 0.0 } else { norm };
    let denominator = programme.denominator.dot(s);
    let ratio = (programme.numerator.dot(s) + length) / denominator;
    let rising = programme.numerator + as_vector10(&slope_of_norm);
    (
        ratio,
        (rising - programme.denominator * ratio) / denominator,
    )
}

#[cfg(test)]
mod tests {
    use super::super::measure::value_of;
    use super::*;
    use crate::base::units::STANDARD_GRAVITY_MM_S2;
    use crate::goal::to_rpm;
    use crate::hollow::worlds::{self, World};

    fn smooth_worlds() -> Vec<World> {
        let spin_it = |gamma_c| Objective::SpinIt {
            gamma_c,
            gamma_i: 1.3,
        };
        let tops =
            [Objective::CriticalSpeed, spin_it(0.0), spin_it(0.8)].map(worlds::egg_on_its_side);
        let yoyos = [Objective::Dominance, spin_it(0.0)].map(worlds::egg);
        tops.into_iter()
            .chain(yoyos)
            .chain([worlds::bottle()])
            .collect()
    }

    #[test]
    fn the_gradient_is_that_of_finite_differences() {
        for world in smooth_worlds() {
            let problem = world.problem();
            let target = Target::new("test", &problem).unwrap();
            let s = (target.reach.solid * 2.0 + target.reach.shell) / 3.0;
            let slope = target.at(&s).1;
            for i in 0..10 {
                let step = Vector10::ith(i, 1e-6);
                let difference = (target.at(&(s + step)).0 - target.at(&(s - step)).0) / 2e-6;
                assert!(
                    (slope[i] - difference).abs() < 1e-6,
                    "{i}: {} {difference}",
                    slope[i]
                );
            }
        }
    }

    #[test]
    fn what_is_minimised_is_the_figure_that_is_reported() {
        for world in smooth_worlds() {
            let problem = world.problem();
            let target = Target::new("test", &problem).unwrap();
            let f = target.at(&target.reach.solid).0;
            let length = target.scale().length_mm;
            let figure = match world.goal.objective {
                Objective::CriticalSpeed if f > 0.0 => f64::NAN,
                Objective::CriticalSpeed => to_rpm((STANDARD_GRAVITY_MM_S2 / (-f * length)).sqrt()),
                Objective::LowestCenter => f * length,
                _ => f,
            };
            let value = value_of(&problem, &world.fixed);
            // The smoothing adds at most its own size to λ_max, here of order 0.1 or more. Speeds
            // are square roots of it.
            let agrees = (figure / value - 1.0).abs() < 2e-3 || (figure.is_nan() && value.is_nan());
            assert!(agrees, "{:?} {figure} {value}", world.goal.objective);
        }
    }

    #[test]
    fn the_largest_over_the_edges_of_a_support_is_refused_by_name() {
        let world = worlds::blocks_on_a_slope();
        let refused = Target::new("rays", &world.problem()).err().unwrap();
        assert!(
            refused
                .to_string()
                .contains("rays cannot optimise `toppling-angle`"),
            "{refused}"
        );
    }
}
