//! The goals as programmes: the rows of the table in [`crate::hollow`].

use nalgebra::DMatrix;

use super::programme::Programme;
use super::reach::Reach;
use super::set::DualSet;
use super::units::Vector10;
use super::units::index::*;
use crate::goal::{FloatConditions, Goal, support_edges};
use crate::hollow::log::Stage;

/// Returns a vector with these entries, zero elsewhere.
fn row(entries: &[(usize, f64)]) -> Vector10 {
    let mut row = Vector10::zeros();
    entries.iter().for_each(|&(at, value)| row[at] += value);
    row
}

fn stack(rows: &[Vector10]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), 10, |i, j| rows[i][j])
}

/// I_xx, I_yy and I_zz as functions of the moments.
const I_XX: [(usize, f64); 2] = [(YY, 1.0), (ZZ, 1.0)];
const I_YY: [(usize, f64); 2] = [(XX, 1.0), (ZZ, 1.0)];
const I_ZZ: [(usize, f64); 2] = [(XX, 1.0), (YY, 1.0)];

/// Returns s_z²/s₁ linearised at s_z = height·s₁: 2·height·s_z − height²·s₁.
fn steiner(height: f64) -> Vector10 {
    row(&[(Z, 2.0 * height), (ONE, -height * height)])
}

/// Returns the rows of Spin-It's functional (eq. 2): (I_xx, √2 I_xy, I_yy) about the centre at this
/// height.
fn functional_rows(height: f64) -> DMatrix<f64> {
    let lowered = steiner(height);
    let cross = row(&[(XY, -std::f64::consts::SQRT_2)]);
    stack(&[row(&I_XX) - lowered, cross, row(&I_YY) - lowered])
}

/// Returns rows whose norm, added to half the trace, is λ_max of the upper 2 × 2 of the tensor.
/// Shifting the tensor does not change them.
fn spread_rows() -> DMatrix<f64> {
    stack(&[row(&[(YY, 0.5), (XX, -0.5)]), row(&[(XY, 1.0)])])
}

/// Returns half the trace of the upper 2 × 2 of the tensor about the centre at this height.
fn mean_across(height: f64) -> Vector10 {
    (row(&I_XX) + row(&I_YY)) * 0.5 - steiner(height)
}

/// Index of the row that fixes the lever s_z in a top's programme with a lever.
pub(crate) const LEVER_ROW: usize = 4;

/// Returns the rows that put the centre on the axis and make the axis principal.
fn axis_rows() -> DMatrix<f64> {
    let row_of = |moment| row(&[(moment, 1.0)]);
    stack(&[X, Y, XZ, YZ].map(row_of))
}

impl Programme {
    fn at_height(mut self, reach: &Reach, height: f64) -> Self {
        self.stage = Stage::AtHeight {
            height_mm: height * reach.scale.length_mm,
        };
        self
    }

    fn with_stage(self, stage: Stage) -> Self {
        Self { stage, ..self }
    }

    /// Yo-yo (Spin-It eq. 2, 5, 6): ‖(I_xx, √2 I_xy, I_yy)‖/I_zz, the square root of the
    /// functional.
    pub fn yoyo_functional(reach: &Reach) -> Self {
        Self::new(
            Vector10::zeros(),
            functional_rows(0.0),
            row(&I_ZZ),
            yoyo_rows(),
        )
        .with_denominator_bounds(reach)
    }

    /// Yo-yo: λ_max of the tensor across the axis, over I_zz.
    pub fn yoyo_dominance(reach: &Reach) -> Self {
        Self::new(mean_across(0.0), spread_rows(), row(&I_ZZ), yoyo_rows())
            .with_denominator_bounds(reach)
            .with_stage(Stage::Dominance)
    }

    /// Top, with the tensor linearised at a height ℓ: (λ_max(I′) − I_zz)/s_z = −g/ω² (Spin-It eq.
    /// 1).
    ///
    /// Every interior that meets the rows has its centre in the given range of heights, which
    /// bounds s_z by the mass.
    pub fn top_critical_speed(reach: &Reach, height: f64, [lowest, highest]: [f64; 2]) -> Self {
        let numerator = mean_across(height) - row(&I_ZZ);
        let mut programme = Self::new(numerator, spread_rows(), row(&[(Z, 1.0)]), axis_rows());
        programme.denominator_floor = lowest * reach.shell[ONE];
        programme.denominator_ceiling = highest * reach.fullest[ONE];
        programme.at_height(reach, height)
    }

    /// Top, with the tensor linearised at a height: λ_max(I′)/I_zz. Some speed makes the top stable
    /// only if it is below 1.
    pub fn top_dominance(reach: &Reach, height: f64) -> Self {
        Self::new(mean_across(height), spread_rows(), row(&I_ZZ), axis_rows())
            .with_denominator_bounds(reach)
            .at_height(reach, height)
    }

    /// Top, with the tensor linearised at a height: the square root of the inertia part of
    /// Spin-It's functional (eq. 7).
    pub fn top_functional(reach: &Reach, height: f64) -> Self {
        Self::new(
            Vector10::zeros(),
            functional_rows(height),
            row(&I_ZZ),
            axis_rows(),
        )
        .with_denominator_bounds(reach)
        .at_height(reach, height)
    }

    /// Restricts the programme to interiors with this lever s_z.
    pub fn with_lever(mut self, reach: &Reach, lever: f64) -> Self {
        let last = self.rows.nrows();
        self.rows = self.rows.insert_row(last, 0.0);
        self.rows[(last, Z)] = 1.0;
        self.rhs = self.rhs.insert_row(last, lever);
        if let Stage::AtHeight { height_mm } = self.stage {
            let lever_mm4 = lever * reach.scale.volume_mm3 * reach.scale.length_mm;
            self.stage = Stage::AtLever {
                height_mm,
                lever_mm4,
            };
        }
        self
    }

    /// Turns the programme into that of the margin over a target ratio: (n·s + max yᵀJs −
    /// target·e·s)/s₁.
    pub fn margin(mut self, reach: &Reach, target: f64) -> Self {
        self.numerator -= self.denominator * target;
        self.denominator = row(&[(ONE, 1.0)]);
        self.with_denominator_bounds(reach)
    }

    /// Top: the least (`sense` 1) or greatest (`sense` −1) height of the centre, as a ratio.
    pub fn top_height(reach: &Reach, sense: f64) -> Self {
        let nothing = DMatrix::zeros(0, 10);
        Self::new(row(&[(Z, sense)]), nothing, row(&[(ONE, 1.0)]), axis_rows())
            .with_denominator_bounds(reach)
            .with_stage(Stage::HeightRange)
    }

    /// Stand: −tan of the toppling angle, the largest over the support's edges of (d s₁ −
    /// n·s_xy)/s_z.
    pub fn stand_toppling(reach: &Reach, goal: &Goal) -> Self {
        let length = reach.scale.length_mm;
        let edge = |(n, d): &([f64; 2], f64)| row(&[(ONE, d / length), (X, -n[0]), (Y, -n[1])]);
        let edges: Vec<Vector10> = support_edges(&goal.support).iter().map(edge).collect();
        let none = DMatrix::zeros(0, 10);
        let mut programme = Self::new(Vector10::zeros(), stack(&edges), row(&[(Z, 1.0)]), none)
            .with_denominator_bounds(reach);
        programme.set = DualSet::Simplex;
        programme
    }

    /// Stand: the height of the centre, which lies above the middle of the support.
    pub fn stand_lowest_center(reach: &Reach) -> Self {
        let (height, mass) = (row(&[(Z, 1.0)]), row(&[(ONE, 1.0)]));
        let rows = stack(&[row(&[(X, 1.0)]), row(&[(Y, 1.0)])]);
        Self::new(height, DMatrix::zeros(0, 10), mass, rows).with_denominator_bounds(reach)
    }

    /// Float: the height of the centre; no ratio.
    ///
    /// The rows fix the mass to that of the displaced water, and put the centre above that of
    /// buoyancy.
    pub fn float_lowest_center(reach: &Reach, afloat: &FloatConditions) -> Self {
        let mass = afloat.material_mm3 / reach.scale.volume_mm3;
        let [x, y] = offset_from_buoyancy(reach, afloat);
        let rows = stack(&[x, y, row(&[(ONE, 1.0)])]);
        let height = row(&[(Z, 1.0 / mass)]);
        let mut programme = Self::new(height, DMatrix::zeros(0, 10), Vector10::zeros(), rows);
        programme.rhs[2] = mass;
        programme
    }

    /// Float: the horizontal offset of the centre from that of buoyancy, at the right mass; no
    /// ratio.
    pub fn float_offset(reach: &Reach, afloat: &FloatConditions) -> Self {
        let mass = afloat.material_mm3 / reach.scale.volume_mm3;
        let offset = stack(&offset_from_buoyancy(reach, afloat)) / mass;
        let mut programme = Self::new(
            Vector10::zeros(),
            offset,
            Vector10::zeros(),
            stack(&[row(&[(ONE, 1.0)])]),
        );
        programme.rhs[0] = mass;
        programme
    }

    /// The least (`sense` 1) or greatest (`sense` −1) mass of any interior; no ratio.
    pub fn extreme_mass(sense: f64) -> Self {
        let none = DMatrix::zeros(0, 10);
        Self::new(row(&[(ONE, sense)]), none.clone(), Vector10::zeros(), none)
    }

    /// Balance: the least material removed, as the most that stays; no ratio.
    pub fn balance_least_removed() -> Self {
        let kept = row(&[(ONE, -1.0)]);
        Self::new(kept, DMatrix::zeros(0, 10), Vector10::zeros(), axis_rows())
    }

    /// Balance: ‖(U_A, U_B)‖/s₁ with the unbalances U in the planes at the two ends a, b of the
    /// axis.
    ///
    /// Together they have the static unbalance and the couple of the body: U_A + U_B = s_xy, a U_A
    /// + b U_B = (s_xz, s_yz).
    pub fn balance_unbalance(reach: &Reach, [a, b]: [f64; 2]) -> Self {
        let span = b - a;
        let at_a = |first, product| row(&[(first, b / span), (product, -1.0 / span)]);
        let at_b = |first, product| row(&[(first, -a / span), (product, 1.0 / span)]);
        let planes = [at_a(X, XZ), at_a(Y, YZ), at_b(X, XZ), at_b(Y, YZ)];
        let none = DMatrix::zeros(0, 10);
        Self::new(Vector10::zeros(), stack(&planes), row(&[(ONE, 1.0)]), none)
            .with_denominator_bounds(reach)
    }
}

/// Returns the mass times the horizontal offset of the centre from that of buoyancy, along x and y.
fn offset_from_buoyancy(reach: &Reach, afloat: &FloatConditions) -> [Vector10; 2] {
    let place = afloat.buoyancy / reach.scale.length_mm;
    [
        row(&[(X, 1.0), (ONE, -place.x)]),
        row(&[(Y, 1.0), (ONE, -place.y)]),
    ]
}

fn yoyo_rows() -> DMatrix<f64> {
    let rows = axis_rows();
    let last = rows.nrows();
    let mut rows = rows.insert_row(last, 0.0);
    rows[(last, Z)] = 1.0;
    rows
}
