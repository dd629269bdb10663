//! The trade between the number of pieces and the deviation.

use super::request::{FitError, FitRequest};
use super::{Fit, fit};
use crate::curve::deviation::frechet_mm;
use crate::curve::points::Curve;

/// Points for each piece between which the Fréchet distance is taken.
const FRECHET_SAMPLES: usize = 20;

/// A number of pieces, and how near they come.
#[derive(Debug, Clone, PartialEq)]
pub struct TradeRow {
    /// Number of pieces.
    pub pieces: usize,
    /// The fit.
    pub fit: Fit,
    /// The Fréchet distance between the chain and the curve, mm.
    pub frechet_mm: f64,
}

/// Fits chains of several numbers of pieces. `request` says what each must be like; it is called
/// with the number.
pub fn trade(
    curve: &Curve,
    pieces: &[usize],
    request: impl Fn(usize) -> FitRequest,
) -> Result<Vec<TradeRow>, FitError> {
    let row = |count: &usize| {
        let fit = fit(curve, &request(*count))?;
        let chain = fit.chain.samples(FRECHET_SAMPLES);
        let target = curve.samples(count * FRECHET_SAMPLES);
        Ok(TradeRow {
            pieces: *count,
            frechet_mm: frechet_mm(&chain, &target),
            fit,
        })
    };
    pieces.iter().map(row).collect()
}
