//! The goal as the judge sees it: what is divided by what, and what must be zero.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use crate::base::units::STANDARD_GRAVITY_MM_S2;
use crate::goal::GoalKind;
use crate::mass::Moments;
use crate::verify::water::Level;
use crate::verify::{BoundProof, FigureName, Setting, Support};

/// Ten coefficients over the moments (1, x, y, z, xy, yz, xz, x², y², z²).
pub(super) type Ten = [f64; 10];

const ONE: usize = 0;
const X: usize = 1;
const Y: usize = 2;
const Z: usize = 3;
const XY: usize = 4;
const YZ: usize = 5;
const XZ: usize = 6;
const XX: usize = 7;
const YY: usize = 8;
const ZZ: usize = 9;

/// Distance by which an edge may cut off a corner of the support, mm: the rounding of its numbers.
const EDGE_MM: f64 = 1e-3;

/// The set of the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weights {
    /// Of length 1 at most.
    Ball,
    /// None negative, and 1 in all.
    Shares,
}

/// A goal: (n·s + max over weights y of yᵀJs)/(e·s) is to be least, while As = b.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Form {
    pub numerator: Ten,
    pub directions: Vec<Ten>,
    pub weights: Weights,
    /// Zero where nothing is divided.
    pub denominator: Ten,
    pub rows: Vec<Ten>,
    pub rhs: Vec<f64>,
}

/// The goal of a kit, with what it needs of the body.
pub(super) struct Ground {
    pub figure: FigureName,
    /// Moments of the body without a void and with its hardware, goal frame.
    pub solid: Moments,
    kind: GoalKind,
    density_g_mm3: f64,
    support: Option<Support>,
    ends_mm: [f64; 2],
    omega_rad_s: f64,
    afloat: Option<Level>,
}

/// Returns ten coefficients, zero but for these.
fn ten(entries: &[(usize, f64)]) -> Ten {
    let mut all = [0.0; 10];
    for &(at, value) in entries {
        all[at] += value;
    }
    all
}

impl Ground {
    /// Returns the goal of a kit for a body without voids (moments in the goal frame).
    pub fn new(setting: &Setting, figure: FigureName, solid: &Moments) -> Self {
        let water = setting.aim.water.as_ref().zip(setting.hull.as_ref());
        let afloat = water.and_then(|(order, hull)| {
            let level = hull.at_waterline(order.waterline_mm)?;
            let ratio = order.liquid_g_cm3 / setting.density_g_cm3;
            Some(Level {
                volume_mm3: level.volume_mm3 * ratio,
                ..level
            })
        });
        let speed_rpm = setting.aim.rotor.map_or(0.0, |order| order.speed_rpm);
        Self {
            figure,
            solid: *solid,
            kind: setting.aim.kind,
            density_g_mm3: setting.density_g_mm3(),
            support: setting.support.clone(),
            ends_mm: setting.ends_mm.unwrap_or([-1.0, 1.0]),
            omega_rad_s: speed_rpm * std::f64::consts::TAU / 60.0,
            afloat,
        }
    }

    /// Returns the form of the goal, for tops with their tensor linear at a height. `None` if the
    /// kit has no such goal, or if an edge of the proof cuts the support.
    pub fn form(&self, proof: &BoundProof, height_mm: f64) -> Option<Form> {
        match self.figure {
            FigureName::CriticalSpeedRpm => Some(critical_speed(height_mm)),
            FigureName::DominanceRatio => Some(self.dominance(height_mm)),
            FigureName::SpinItRatio => Some(self.functional(height_mm)),
            FigureName::TopplesDeg => self.toppling(&proof.edges),
            FigureName::CenterHeightMm => Some(self.center_height()),
            FigureName::MetacentricHeightMm => self.metacentre(),
            FigureName::MassG => Some(Form {
                numerator: ten(&[(ONE, -1.0)]),
                ..axis_form()
            }),
            FigureName::BalanceGradeMmS => Some(self.unbalance()),
            FigureName::InfillChangeRatio => None,
        }
    }

    /// Returns the figure for a ratio of the form; `None` if there is no such figure.
    pub fn figure_of(&self, ratio: f64) -> Option<f64> {
        let value = match self.figure {
            FigureName::CriticalSpeedRpm => {
                (STANDARD_GRAVITY_MM_S2 / -ratio).sqrt() * 60.0 / std::f64::consts::TAU
            }
            FigureName::DominanceRatio | FigureName::CenterHeightMm => ratio,
            FigureName::SpinItRatio => ratio * ratio,
            FigureName::TopplesDeg => -ratio.atan().to_degrees(),
            FigureName::MetacentricHeightMm => self.afloat.as_ref()?.metacenter_mm - ratio,
            FigureName::MassG => -ratio * self.density_g_mm3,
            // The larger of two planes' unbalances is at least their joint length over √2, and the
            // grade counts it twice.
            FigureName::BalanceGradeMmS => 2.0 * FRAC_1_SQRT_2 * ratio * self.omega_rad_s,
            FigureName::InfillChangeRatio => return None,
        };
        value.is_finite().then_some(value)
    }

    /// Returns the share of s_z²/s₁ in the numerator for these weights of a top.
    pub fn bend(&self, weights: &[f64]) -> f64 {
        match (self.figure, weights) {
            (FigureName::SpinItRatio, [across_x, _, across_y]) => across_x + across_y,
            _ => 1.0,
        }
    }

    fn dominance(&self, height_mm: f64) -> Form {
        Form {
            numerator: mean_across(height_mm),
            directions: spread(),
            denominator: ten(&[(XX, 1.0), (YY, 1.0)]),
            ..self.spinning()
        }
    }

    fn functional(&self, height_mm: f64) -> Form {
        let lowered = |axis: usize| {
            ten(&[
                (axis, 1.0),
                (ZZ, 1.0),
                (Z, -2.0 * height_mm),
                (ONE, height_mm * height_mm),
            ])
        };
        Form {
            directions: vec![lowered(YY), ten(&[(XY, -SQRT_2)]), lowered(XX)],
            denominator: ten(&[(XX, 1.0), (YY, 1.0)]),
            ..self.spinning()
        }
    }

    /// Returns the constraints of what spins; a yo-yo's centre lies in its origin.
    fn spinning(&self) -> Form {
        let mut form = axis_form();
        if self.kind == GoalKind::Yoyo {
            form.rows.push(ten(&[(Z, 1.0)]));
            form.rhs.push(0.0);
        }
        form
    }

    fn toppling(&self, edges: &[[f64; 3]]) -> Option<Form> {
        let support = self.support.as_ref()?;
        let holds = |&[x, y, offset]: &[f64; 3]| {
            let corners = &support.corners_mm;
            let is_unit = (x.hypot(y) - 1.0).abs() < 1e-6;
            is_unit
                && corners
                    .iter()
                    .all(|at| x * at[0] + y * at[1] >= offset - EDGE_MM)
        };
        let edge = |&[x, y, offset]: &[f64; 3]| ten(&[(ONE, offset), (X, -x), (Y, -y)]);
        edges.iter().all(holds).then(|| Form {
            directions: edges.iter().map(edge).collect(),
            weights: Weights::Shares,
            denominator: ten(&[(Z, 1.0), (ONE, -support.ground_mm)]),
            ..free_form()
        })
    }

    fn center_height(&self) -> Form {
        let ground_mm = self
            .support
            .as_ref()
            .map_or(0.0, |support| support.ground_mm);
        Form {
            numerator: ten(&[(Z, 1.0), (ONE, -ground_mm)]),
            denominator: ten(&[(ONE, 1.0)]),
            rows: vec![ten(&[(X, 1.0)]), ten(&[(Y, 1.0)])],
            rhs: vec![0.0; 2],
            ..free_form()
        }
    }

    fn metacentre(&self) -> Option<Form> {
        let Level {
            volume_mm3,
            center_mm: [x, y],
            ..
        } = *self.afloat.as_ref()?;
        Some(Form {
            numerator: ten(&[(Z, volume_mm3.recip())]),
            rows: vec![
                ten(&[(X, 1.0), (ONE, -x)]),
                ten(&[(Y, 1.0), (ONE, -y)]),
                ten(&[(ONE, 1.0)]),
            ],
            rhs: vec![0.0, 0.0, volume_mm3],
            ..free_form()
        })
    }

    fn unbalance(&self) -> Form {
        let [a, b] = self.ends_mm;
        let span = b - a;
        let at_a = |first, product| ten(&[(first, b / span), (product, -1.0 / span)]);
        let at_b = |first, product| ten(&[(first, -a / span), (product, 1.0 / span)]);
        Form {
            directions: vec![at_a(X, XZ), at_a(Y, YZ), at_b(X, XZ), at_b(Y, YZ)],
            denominator: ten(&[(ONE, 1.0)]),
            ..free_form()
        }
    }
}

/// Returns a form without a goal and without constraints.
fn free_form() -> Form {
    Form {
        numerator: [0.0; 10],
        directions: Vec::new(),
        weights: Weights::Ball,
        denominator: [0.0; 10],
        rows: Vec::new(),
        rhs: Vec::new(),
    }
}

/// Returns the constraints of an axis: the centre on it, and principal.
pub(super) fn axis_form() -> Form {
    let row = |moment: usize| ten(&[(moment, 1.0)]);
    Form {
        rows: [X, Y, XZ, YZ].map(row).to_vec(),
        rhs: vec![0.0; 4],
        ..free_form()
    }
}

/// Returns the form of the height of the centre, up or down, under the constraints of an axis.
pub(super) fn height_form(sense: f64) -> Form {
    Form {
        numerator: ten(&[(Z, sense)]),
        denominator: ten(&[(ONE, 1.0)]),
        ..axis_form()
    }
}

/// Returns the mass, as a function of the moments.
pub(super) fn mass() -> Ten {
    ten(&[(ONE, 1.0)])
}

fn critical_speed(height_mm: f64) -> Form {
    let mut numerator = mean_across(height_mm);
    numerator[XX] -= 1.0;
    numerator[YY] -= 1.0;
    Form {
        numerator,
        directions: spread(),
        denominator: ten(&[(Z, 1.0)]),
        ..axis_form()
    }
}

/// Returns half the trace of the tensor across the axis about the centre, if that is at a height.
fn mean_across(height_mm: f64) -> Ten {
    ten(&[
        (XX, 0.5),
        (YY, 0.5),
        (ZZ, 1.0),
        (Z, -2.0 * height_mm),
        (ONE, height_mm * height_mm),
    ])
}

/// Returns the rows whose length is half the difference of the moments across the axis.
fn spread() -> Vec<Ten> {
    vec![ten(&[(YY, 0.5), (XX, -0.5)]), ten(&[(XY, 1.0)])]
}
