//! The moments of cells, each emptied by a share: linear in the shares.

use rayon::prelude::*;

use super::moments::{BLOCK, block_sums};
use crate::geom::Quadric;
use crate::mass::Moments;

/// Moments of cells. Each cell has its mean moments and its share of the whole volume.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells {
    /// Moments over weight.
    means: Vec<Moments>,
    weights: Vec<f64>,
}

impl Cells {
    /// Returns the cells with these moments; each volume must be positive.
    pub fn new(moments: Vec<Moments>) -> Self {
        let volume: f64 = moments.iter().map(Moments::volume).sum();
        let weights: Vec<f64> = moments.iter().map(|cell| cell.volume() / volume).collect();
        let means = moments
            .iter()
            .zip(&weights)
            .map(|(cell, weight)| *cell * weight.recip())
            .collect();
        Self { means, weights }
    }

    /// Returns the share of the whole volume that each cell has.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Returns the moments with these shares emptied.
    pub fn moments(&self, x: &[f64]) -> Moments {
        block_sums(x.len(), |i| self.means[i] * (x[i] * self.weights[i]))
    }

    /// Writes the derivative of ∫q with respect to each share, over the cell's weight.
    pub fn derivative(&self, quadric: &Quadric, out: &mut [f64]) {
        let blocks = out.par_chunks_mut(BLOCK).zip(self.means.par_chunks(BLOCK));
        blocks.for_each(|(out, means)| {
            for (out, mean) in out.iter_mut().zip(means) {
                *out = quadric.0.iter().zip(mean.0).map(|(q, s)| q * s).sum();
            }
        });
    }
}
