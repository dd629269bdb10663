//! The residuals of a chain against samples of a curve, with their derivatives.

use nalgebra::{DMatrix, DVector};

use super::request::{Ends, FitRequest};
use super::unknowns::{POSE, Unknowns, wrap};
use crate::curve::chain::{Chain, nesting_terms};
use crate::curve::helix::{Helix, Twist};
use crate::geom::{Frame, Point, Vector};

/// Weight of an end that is pinned, against a sample of the curve.
const PIN_WEIGHT: f64 = 1e3;

/// The angle over which the price of a turn is rounded off at zero, rad.
const ROUNDING_RAD: f64 = 1e-2;

/// Weights of an offset beyond its bound, against a distance from the curve. The first is for a
/// chain far from its place, the last is so great that the bound holds.
pub(super) const OFFSET_WEIGHTS: [f64; 2] = [30.0, 1000.0];

/// Share of its bound at which an offset begins to cost. The rest is more than what is left over
/// at the last weight, and than the offset differs from its formula.
const OFFSET_SHARE: f64 = 0.97;

/// Places and weights of the three-node rule of Gauss and Legendre on 0 to 1.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 4.0 / 9.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// A curve, sampled at equal shares of its length, that a chain is to come near to.
pub(super) struct Problem<'a> {
    target: &'a [Point],
    /// Samples for each piece.
    steps: usize,
    request: &'a FitRequest,
    /// The length of a piece in the price of nesting, mm.
    nominal_mm: f64,
    offset_weight: f64,
}

/// Residuals, and their derivatives by row and unknown.
pub(super) struct Linear {
    pub residuals: DVector<f64>,
    pub jacobian: DMatrix<f64>,
}

/// The twists with which everything beyond a place moves, for each unit of a piece's unknowns.
#[derive(Clone, Copy)]
struct PieceTwists {
    curvature: Twist,
    torsion: Twist,
    length: Twist,
}

impl<'a> Problem<'a> {
    /// Takes samples of which every piece has the same number, and one more for the first.
    pub fn new(target: &'a [Point], request: &'a FitRequest) -> Self {
        let edges = target.len().saturating_sub(1);
        let length_mm: f64 = target
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).norm())
            .sum();
        Self {
            target,
            steps: edges / request.pieces,
            request,
            nominal_mm: length_mm / request.pieces as f64,
            offset_weight: OFFSET_WEIGHTS[1],
        }
    }

    /// Returns the problem with another weight of offsets beyond their bound.
    pub fn with_offset_weight(self, offset_weight: f64) -> Self {
        Self {
            offset_weight,
            ..self
        }
    }

    /// Returns the sum of the squares, mm².
    pub fn cost(&self, chain: &Chain) -> f64 {
        self.residuals(chain).norm_squared()
    }

    /// Returns the residuals: distances, pins, misfits of neighbours, offsets, turns.
    pub fn residuals(&self, chain: &Chain) -> DVector<f64> {
        let samples = chain.samples(self.steps);
        let weight = self.sample_weight();
        let offset = |i: usize| (samples[i] - self.target[i]) * weight;
        let offsets = (0..samples.len()).map(offset);
        let pins = self.pins().into_iter().map(|i| offset(i) * PIN_WEIGHT);
        let spatial = offsets.chain(pins).flat_map(|v| [v.x, v.y, v.z]);
        let misfits = chain.pieces.windows(2).flat_map(|pair| {
            nesting_terms(&pair[0], &pair[1], self.nominal_mm).map(|t| t * self.nesting_weight())
        });
        let price = self.request.impulse_price;
        let turns = chain
            .turns_rad
            .iter()
            .map(|turn| rounded_root(*turn, price).value);
        let offsets = self.offsets(chain).into_iter().map(|offset| offset.value);
        let all = spatial.chain(misfits).chain(offsets).chain(turns);
        DVector::from_vec(all.collect())
    }

    /// Returns the residuals with their derivatives by every unknown.
    pub fn linear(&self, chain: &Chain, free: &Unknowns) -> Linear {
        let residuals = self.residuals(chain);
        let mut jacobian = DMatrix::zeros(residuals.len(), free.count());
        self.fill_samples(chain, free, &mut jacobian);
        self.fill_pins(&mut jacobian);
        self.fill_nesting(chain, free, &mut jacobian);
        self.fill_offsets(chain, free, &mut jacobian);
        self.fill_turns(chain, free, &mut jacobian);
        Linear {
            residuals,
            jacobian,
        }
    }

    /// Fills the rows of the samples: each is moved by the twists of all pieces before it.
    fn fill_samples(&self, chain: &Chain, free: &Unknowns, jacobian: &mut DMatrix<f64>) {
        let weight = self.sample_weight();
        let samples = chain.samples(self.steps);
        let mut beyond: Vec<Twist> = pose_twists(&free.centre());
        beyond.resize(free.count(), Twist::ZERO);
        put(jacobian, 0, &moves(&beyond, &samples[0], weight));
        for (i, (piece, start)) in chain.pieces.iter().zip(chain.starts()).enumerate() {
            if let Some(place) = free.turn(i) {
                let tangent: Vector = start.axes.column(0).into();
                beyond[place] = Twist::about(&tangent, &start.origin);
            }
            let within = self.piece_twists(piece, &start, chain.piece_mm);
            let before = beyond.clone();
            for (step, twists) in within.iter().enumerate() {
                beyond.clone_from(&before);
                let places = [
                    (free.curvature(i), twists.curvature),
                    (free.torsion(i), twists.torsion),
                    (Some(free.length()), twists.length),
                ];
                for (place, twist) in places {
                    if let Some(place) = place {
                        beyond[place] = beyond[place].plus(&twist, 1.0);
                    }
                }
                let sample = i * self.steps + step + 1;
                put(
                    jacobian,
                    3 * sample,
                    &moves(&beyond, &samples[sample], weight),
                );
            }
        }
    }

    /// Returns the twists of a piece's unknowns at each of its samples.
    ///
    /// They are integrals over what lies before: curvature turns about every binormal, torsion
    /// about every tangent.
    fn piece_twists(&self, piece: &Helix, start: &Frame, length_mm: f64) -> Vec<PieceTwists> {
        let step_mm = length_mm / self.steps as f64;
        let slide = piece.slide().from_frame(start);
        let mut sum = PieceTwists {
            curvature: Twist::ZERO,
            torsion: Twist::ZERO,
            length: Twist::ZERO,
        };
        let twists = (0..self.steps).map(|step| {
            for [share, weight] in GAUSS {
                let at = start.frame_to_model(&piece.frame_at(step_mm * (step as f64 + share)));
                let about = |axis: usize| {
                    let axis: Vector = at.axes.column(axis).into();
                    Twist::about(&axis, &at.origin)
                };
                sum.curvature = sum.curvature.plus(&about(2), weight * step_mm);
                sum.torsion = sum.torsion.plus(&about(0), weight * step_mm);
            }
            sum.length = sum.length.plus(&slide, 1.0 / self.steps as f64);
            sum
        });
        twists.collect()
    }

    /// Copies the rows of the end samples, with the weight of pins.
    fn fill_pins(&self, jacobian: &mut DMatrix<f64>) {
        let first = 3 * self.target.len();
        for (pin, sample) in self.pins().into_iter().enumerate() {
            for axis in 0..3 {
                let row = jacobian.row(3 * sample + axis) * PIN_WEIGHT;
                jacobian.set_row(first + 3 * pin + axis, &row);
            }
        }
    }

    fn fill_nesting(&self, chain: &Chain, free: &Unknowns, jacobian: &mut DMatrix<f64>) {
        let first = 3 * (self.target.len() + self.pins().len());
        let weight = self.nesting_weight();
        let (square, cube) = (self.nominal_mm.powi(2), self.nominal_mm.powi(3));
        for (joint, pair) in chain.pieces.windows(2).enumerate() {
            let row = first + 2 * joint;
            let mean = 0.5 * (pair[0].curvature + pair[1].curvature);
            let jump = pair[1].torsion - pair[0].torsion;
            for (piece, sign) in [(joint, -1.0), (joint + 1, 1.0)] {
                if let Some(place) = free.curvature(piece) {
                    jacobian[(row, place)] += weight * sign * 0.5 * square;
                    jacobian[(row + 1, place)] += weight * jump * cube / 12.0;
                }
                if let Some(place) = free.torsion(piece) {
                    jacobian[(row + 1, place)] += weight * sign * mean * cube / 6.0;
                }
            }
        }
    }

    /// Returns the residual of every joint's offset beyond its bound; none without a bound.
    fn offsets(&self, chain: &Chain) -> Vec<Offset> {
        let Some(bound) = self.request.turn_bound else {
            return Vec::new();
        };
        let joints = chain.turns_rad.iter().zip(&chain.pieces[1..]);
        let offset = |(turn, piece): (&f64, &Helix)| {
            let (sine, cosine) = (0.5 * turn).sin_cos();
            let lever = bound.lever_mm2();
            let offset_mm = lever * piece.curvature * sine.abs();
            let excess_mm = offset_mm - OFFSET_SHARE * bound.offset_mm;
            if excess_mm <= 0.0 {
                return Offset::default();
            }
            let scale = self.offset_weight * lever;
            Offset {
                value: self.offset_weight * excess_mm,
                by_curvature: scale * sine.abs(),
                by_turn: scale * piece.curvature * 0.5 * cosine * sine.signum(),
            }
        };
        joints.map(offset).collect()
    }

    fn fill_offsets(&self, chain: &Chain, free: &Unknowns, jacobian: &mut DMatrix<f64>) {
        let offsets = self.offsets(chain);
        let first = jacobian.nrows() - chain.turns_rad.len() - offsets.len();
        for (joint, offset) in offsets.iter().enumerate() {
            if let Some(place) = free.curvature(joint + 1) {
                jacobian[(first + joint, place)] += offset.by_curvature;
            }
            if let Some(place) = free.turn(joint + 1) {
                jacobian[(first + joint, place)] += offset.by_turn;
            }
        }
    }

    fn fill_turns(&self, chain: &Chain, free: &Unknowns, jacobian: &mut DMatrix<f64>) {
        let first = jacobian.nrows() - chain.turns_rad.len();
        for (joint, turn) in chain.turns_rad.iter().enumerate() {
            if let Some(place) = free.turn(joint + 1) {
                let slope = rounded_root(*turn, self.request.impulse_price).slope;
                jacobian[(first + joint, place)] = slope;
            }
        }
    }

    fn sample_weight(&self) -> f64 {
        1.0 / (self.target.len() as f64).sqrt()
    }

    fn nesting_weight(&self) -> f64 {
        self.request.nesting_price
    }

    /// Returns the samples that are pinned.
    fn pins(&self) -> Vec<usize> {
        match self.request.ends {
            Ends::Free => Vec::new(),
            Ends::Pinned => vec![0, self.target.len() - 1],
        }
    }
}

/// The residual of an offset beyond its bound, and its derivatives.
#[derive(Default)]
struct Offset {
    value: f64,
    by_curvature: f64,
    by_turn: f64,
}

/// A residual and its derivative.
struct Root {
    value: f64,
    slope: f64,
}

/// Returns the residual whose square is the price of a turn: |θ|, rounded off near zero.
fn rounded_root(turn_rad: f64, price: f64) -> Root {
    let turn = wrap(turn_rad);
    let far = turn.hypot(ROUNDING_RAD);
    // √(√(θ² + ε²) − ε), written so that nothing cancels near zero.
    let root = (price / (far + ROUNDING_RAD)).sqrt();
    Root {
        value: root * turn,
        slope: root * (1.0 - 0.5 * turn * turn / (far * (far + ROUNDING_RAD))),
    }
}

/// Returns the twists of the pose: turns about three axes through the centre, and three shifts.
fn pose_twists(centre: &Point) -> Vec<Twist> {
    let turn = |axis: usize| Twist::about(&Vector::ith(axis, 1.0), centre);
    let shift = |axis: usize| Twist {
        turn: Vector::zeros(),
        shift: Vector::ith(axis, 1.0),
    };
    let twists: Vec<Twist> = (0..3).map(turn).chain((0..3).map(shift)).collect();
    debug_assert_eq!(twists.len(), POSE);
    twists
}

/// Returns the velocities of a point with each of the twists.
fn moves(twists: &[Twist], point: &Point, weight: f64) -> Vec<Vector> {
    twists
        .iter()
        .map(|twist| twist.at(point) * weight)
        .collect()
}

/// Writes velocities into three rows.
fn put(jacobian: &mut DMatrix<f64>, row: usize, velocities: &[Vector]) {
    for (column, velocity) in velocities.iter().enumerate() {
        for axis in 0..3 {
            jacobian[(row + axis, column)] = velocity[axis];
        }
    }
}
