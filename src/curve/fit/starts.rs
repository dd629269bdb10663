//! The chains from which the descent begins.

use nalgebra::Matrix3;

use super::request::{FIT_SAMPLES, FitRequest, Freedom};
use super::unknowns::wrap;
use crate::curve::chain::Chain;
use crate::curve::frames::DiscreteFrames;
use crate::curve::helix::Helix;
use crate::curve::points::{Curve, smooth};
use crate::curve::steps::{StepFit, TurnSample};
use crate::geom::{Frame, Matrix, Point, Vector};

/// The prices of a jump of torsion, rad·mm. Without one torsion is followed, noise and all; with a
/// high one only great jumps remain.
const PRICES: [f64; 4] = [0.0, 3.0, 10.0, 30.0];

/// Factors of the measured curvature. The chain between two samples is longer than the curve where
/// torsion is left out, so more curvature is often nearer.
const CURVATURE_FACTORS: [f64; 3] = [1.0, 1.2, 1.4];

/// Edges for each piece on which bends and twists are measured.
const MEASURED_EDGES: usize = 40;

/// Heat flow over these edges before, in edges²: curvature asks for more of it than positions.
const MEASURED_FLOW: f64 = 30.0;

/// A curve by its bends and twists, piece by piece.
struct Measured {
    piece_mm: f64,
    /// Mean curvature of each piece, 1/mm.
    curvatures: Vec<f64>,
    /// Torsion from the start.
    torsion: Vec<TurnSample>,
    /// The turn from the plane in which a piece bends to that of the next, rad.
    plane_turns: Vec<f64>,
}

/// Returns the chain of Yu, Crane and Coros (2017), with turns at a price (rad·mm) for each rad.
///
/// All pieces have the mean curvature and one torsion. The chain is laid on the curve by the rigid
/// motion that is best in least squares.
pub fn first_guess(curve: &Curve, request: &FitRequest, price: f64) -> Chain {
    let measured = Measured::of(curve, request.pieces);
    let count = measured.curvatures.len().max(1) as f64;
    let mean = measured.curvatures.iter().sum::<f64>() / count;
    let steps = measured.steps(price);
    let pieces = vec![
        Helix {
            curvature: mean,
            torsion: steps.slope,
        };
        request.pieces
    ];
    let chain = measured.chain(pieces, steps.jumps_rad);
    laid_on(curve, &within(&chain, request))
}

/// Returns every start, the likeliest first.
pub(super) fn all(curve: &Curve, request: &FitRequest) -> Vec<Chain> {
    let measured = Measured::of(curve, request.pieces);
    let mut starts = Vec::new();
    for factor in CURVATURE_FACTORS {
        starts.push(measured.start(factor, 0.0, measured.plane_turns.clone()));
        for steps in PRICES.map(|price| measured.steps(price)) {
            starts.push(measured.start(factor, steps.slope, steps.jumps_rad.clone()));
            starts.push(measured.start(factor, 0.0, steps.jumps_rad));
        }
    }
    let lay = |start: &Chain| laid_on(curve, &within(start, request));
    starts.iter().map(lay).collect()
}

impl Measured {
    fn of(curve: &Curve, pieces: usize) -> Self {
        let edges = pieces * MEASURED_EDGES;
        let points = smooth(&curve.samples(edges), MEASURED_FLOW);
        let frames = DiscreteFrames::of(&points);
        let edge_mm = curve.length_mm() / edges as f64;
        let piece_mm = curve.length_mm() / pieces as f64;
        let sums = frames.bend_rad.chunks(MEASURED_EDGES);
        let curvatures: Vec<f64> = sums
            .map(|bends| bends.iter().sum::<f64>() / piece_mm)
            .collect();
        let twists = frames.cumulative_twist().into_iter().enumerate();
        let torsion = twists.map(|(i, turn_rad)| TurnSample {
            arc_mm: edge_mm * (i + 1) as f64,
            turn_rad,
        });
        Self {
            piece_mm,
            curvatures,
            torsion: torsion.collect(),
            plane_turns: plane_turns(&points),
        }
    }

    /// Returns the steps fitted to the torsion, with jumps at the joints.
    fn steps(&self, price: f64) -> StepFit {
        let joints = 1..self.curvatures.len();
        let knots: Vec<f64> = joints.map(|joint| self.piece_mm * joint as f64).collect();
        StepFit::of(&self.torsion, &knots, price)
    }

    /// Returns a chain of the measured curvatures times a factor.
    fn start(&self, factor: f64, torsion: f64, turns_rad: Vec<f64>) -> Chain {
        let piece = |curvature: &f64| Helix {
            curvature: factor * curvature,
            torsion,
        };
        self.chain(self.curvatures.iter().map(piece).collect(), turns_rad)
    }

    fn chain(&self, pieces: Vec<Helix>, turns_rad: Vec<f64>) -> Chain {
        Chain {
            start: Frame::identity(),
            piece_mm: self.piece_mm,
            pieces,
            turns_rad: turns_rad.into_iter().map(wrap).collect(),
        }
    }
}

/// Returns the turns between the planes in which neighbouring stretches of the points bend.
fn plane_turns(points: &[Point]) -> Vec<f64> {
    let edges: Vec<Vector> = points
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).normalize())
        .collect();
    let bend = |piece: &[Vector]| {
        let crosses = piece.windows(2).map(|pair| pair[0].cross(&pair[1]));
        crosses.sum::<Vector>()
    };
    let bends: Vec<Vector> = edges.chunks(MEASURED_EDGES).map(bend).collect();
    let joints = bends.windows(2).enumerate().map(|(joint, pair)| {
        let tangent = edges[(joint + 1) * MEASURED_EDGES];
        let [a, b] = [pair[0], pair[1]].map(|bend| bend - tangent * tangent.dot(&bend));
        a.cross(&b).dot(&tangent).atan2(a.dot(&b))
    });
    joints.collect()
}

/// Returns the chain within the bounds, with one value for all pieces where that is asked.
fn within(chain: &Chain, request: &FitRequest) -> Chain {
    let count = chain.pieces.len().max(1) as f64;
    let mean = |of: fn(&Helix) -> f64| chain.pieces.iter().map(of).sum::<f64>() / count;
    let (curvature, torsion) = (mean(|p| p.curvature), mean(|p| p.torsion));
    let choose = |freedom: Freedom, own: f64, mean: f64| match freedom {
        Freedom::Zero => 0.0,
        Freedom::One => mean,
        Freedom::Each => own,
    };
    let (bend, twist) = (request.max_curvature, request.max_torsion);
    let piece = |piece: &Helix| Helix {
        curvature: choose(request.curvature, piece.curvature, curvature).clamp(0.0, bend),
        torsion: choose(request.torsion, piece.torsion, torsion).clamp(-twist, twist),
    };
    Chain {
        pieces: chain.pieces.iter().map(piece).collect(),
        ..chain.clone()
    }
}

/// Returns the chain laid on the curve by the best rigid motion.
///
/// Kabsch, "A solution for the best rotation to relate two sets of vectors", 1976.
fn laid_on(curve: &Curve, chain: &Chain) -> Chain {
    let from = chain.samples(FIT_SAMPLES);
    let to = curve.samples(chain.pieces.len() * FIT_SAMPLES);
    let (a, b) = (centre(&from), centre(&to));
    let pairs = from.iter().zip(&to);
    let covariance: Matrix3<f64> = pairs.map(|(p, q)| (q - b) * (p - a).transpose()).sum();
    let axes = nearest_rotation(&covariance);
    chain.moved(&Frame {
        origin: b - axes * a.coords,
        axes,
    })
}

fn nearest_rotation(matrix: &Matrix) -> Matrix {
    let decomposed = matrix.svd(true, true);
    let (Some(u), Some(v)) = (decomposed.u, decomposed.v_t) else {
        return Matrix::identity();
    };
    let side = (u * v).determinant().signum();
    // The singular values come in falling order, so the last axis is the one to turn back.
    u * Matrix::from_diagonal(&Vector::new(1.0, 1.0, side)) * v
}

fn centre(points: &[Point]) -> Point {
    let sum: Vector = points.iter().map(|p| p.coords).sum();
    Point::from(sum / points.len().max(1) as f64)
}
