//! The chain of helices nearest to a curve, by positions.
//!
//! A fit of the torsion alone drifts: small errors of angle add up over the length. So it is only
//! a start. From it and others, Levenberg–Marquardt goes down on the distances between samples at
//! equal shares of the length. The problem has many local minima, and some are coils near the curve
//! that no tube could follow. So the best answer without overlap is kept.

mod descent;
mod request;
mod residuals;
mod starts;
mod trade;
mod unknowns;

#[cfg(test)]
mod tests;

use rayon::prelude::*;

use super::chain::Chain;
use super::deviation::Deviation;
use super::embedding::least_gap_mm;
use super::points::Curve;
use crate::geom::Point;

pub use request::{Ends, FitError, FitRequest, Freedom, TurnBound};
pub use starts::first_guess;
pub use trade::{TradeRow, trade};

use descent::descend;
use request::FIT_SAMPLES;
use residuals::{OFFSET_WEIGHTS, Problem};
use unknowns::Unknowns;

/// Edges for each piece on which the noise of the curve is smoothed: over an eighth of a piece.
const NOISE_EDGES: usize = 40;

/// Samples of each piece for the figures of the answer.
const JUDGED_SAMPLES: usize = 20;

/// The turn below which a joint does without its own, if turns have a price, rad.
const SMALL_TURN_RAD: f64 = 0.02;

/// A chain fitted to a curve, and how near it comes.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The chain.
    pub chain: Chain,
    /// The distance at equal shares of the length.
    pub deviation: Deviation,
    /// The least gap between strands of the tube, mm; infinite without radii. Negative if no start
    /// led to a chain that is free of itself.
    pub least_gap_mm: f64,
    /// Sum of squares that was minimised, mm²: the mean square and the prices.
    pub cost_mm2: f64,
}

impl Fit {
    /// Returns true if no strand of the tube overlaps another.
    pub fn is_embedded(&self) -> bool {
        self.least_gap_mm >= 0.0
    }
}

/// Fits a chain to a curve: the best that was found, not proved the best there is.
pub fn fit(curve: &Curve, request: &FitRequest) -> Result<Fit, FitError> {
    request.check()?;
    curve.refuse_corners(request.pieces * JUDGED_SAMPLES)?;
    Ok(fit_checked(curve, request))
}

fn fit_checked(curve: &Curve, request: &FitRequest) -> Fit {
    let smooth = curve.without_noise(request.pieces * NOISE_EDGES);
    let mut starts = starts::all(&smooth, request);
    if let Some(coarse) = request.halved() {
        starts.push(fit_checked(curve, &coarse).chain.halved());
    }
    let target = smooth.samples(request.pieces * FIT_SAMPLES);
    // In the order of the starts, so the answer does not depend on the number of threads.
    let fits: Vec<Fit> = starts
        .par_iter()
        .map(|start| judge(curve, request, &refine(&target, request, start)))
        .collect();
    let is_better = |a: &Fit, b: &Fit| {
        let by_gap = b.is_embedded().cmp(&a.is_embedded());
        by_gap.then(a.cost_mm2.total_cmp(&b.cost_mm2))
    };
    let best = fits.into_iter().min_by(is_better);
    best.unwrap_or_else(|| judge(curve, request, &first_guess(curve, request, 0.0)))
}

/// Goes down from a start. Small turns are then left out, if turns have a price.
fn refine(target: &[Point], request: &FitRequest, start: &Chain) -> Chain {
    let free = Unknowns::of(request, start);
    let [soft, firm] = OFFSET_WEIGHTS;
    let problem = |weight| Problem::new(target, request).with_offset_weight(weight);
    let mut chain = descend(&problem(soft), &free, start);
    let problem = problem(firm);
    if request.turn_bound.is_some() {
        chain = descend(&problem, &free, &chain);
    }
    let chain = free.wrapped(&chain);
    if request.impulse_price == 0.0 {
        return chain;
    }
    let sparse = free.without_small_turns(&chain, SMALL_TURN_RAD);
    let cleared = sparse.cleared(&chain);
    sparse.wrapped(&descend(&problem, &sparse, &cleared))
}

fn judge(curve: &Curve, request: &FitRequest, chain: &Chain) -> Fit {
    let samples = chain.samples(JUDGED_SAMPLES);
    let target = curve.samples(request.pieces * JUDGED_SAMPLES);
    let radius = |i: usize| {
        let piece = i.saturating_sub(1) / JUDGED_SAMPLES;
        request.body_mm.get(piece).copied()
    };
    let radii: Option<Vec<f64>> = (0..samples.len()).map(radius).collect();
    Fit {
        deviation: Deviation::between(&samples, &target),
        least_gap_mm: radii.map_or(f64::INFINITY, |radii| least_gap_mm(&samples, &radii)),
        cost_mm2: Problem::new(&target, request).cost(chain),
        chain: chain.clone(),
    }
}
