//! The changes that make the ten moments of a dithered body right.
//!
//! Pixels that the surface cuts belong to the body or not, so its mass and its moments are some
//! hundredths of a per cent off. What lacks is first spread over all shares as a quadratic, the
//! change of least squares. What is left is made up by single pixels.

use nalgebra::{SMatrix, SVector};

use crate::geom::{Aabb, Point};
use crate::mass::Moments;
use crate::raster::{Cell, Grid};

/// Number of moments.
const MOMENTS: usize = Moments::COUNT;
/// About the number of pixels that are kept to be changed.
const SAMPLES: u64 = 20_000;
/// Fewest of them by which shares are nudged.
const FEWEST_SAMPLES: usize = 200;
/// Most pixels that are changed one by one.
pub(super) const MOST_CHANGES: usize = 2000;
/// Shares between which a pixel may have either material without being seen.
const MIXED: std::ops::RangeInclusive<f32> = 0.02..=0.98;
/// Least singular value that counts, over the greatest: plates are flat.
const FLAT_RATIO: f64 = 1e-9;

/// The ten moments in units of pixels and of half the body's longest side.
type Ten = SVector<f64, MOMENTS>;

/// A frame in which the ten monomials are at most 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unit {
    middle: Point,
    half_mm: f64,
    voxel_mm3: f64,
}

impl Unit {
    /// Returns the frame of a body with this box.
    pub(super) fn of(aabb: &Aabb, grid: &Grid) -> Self {
        Self {
            middle: aabb.center(),
            half_mm: 0.5 * aabb.size().max(),
            voxel_mm3: grid.voxel_mm3(),
        }
    }

    fn monomials(&self, at_mm: [f64; 3]) -> Ten {
        let [x, y, z] = [0, 1, 2].map(|axis| (at_mm[axis] - self.middle[axis]) / self.half_mm);
        Ten::from(Moments::monomials(x, y, z))
    }

    /// Returns moments in units of this frame.
    pub(super) fn moments(&self, moments: &Moments) -> Ten {
        let mut ten = Ten::from(moments.translated(&-self.middle.coords).0);
        for (index, moment) in ten.iter_mut().enumerate() {
            let degree = match index {
                0 => 0,
                1..=3 => 1,
                _ => 2,
            };
            *moment /= self.voxel_mm3 * self.half_mm.powi(degree);
        }
        ten
    }
}

/// A pixel that may be changed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    at: usize,
    layer: u32,
    moments: Ten,
    is_heavy: bool,
}

/// A layer with its materials.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawn<'a> {
    pub(super) layer: u32,
    pub(super) cells: &'a [Cell],
    /// The shares that were asked for.
    pub(super) shares: &'a [f32],
}

/// Pixels of a body, taken evenly, whose material may be changed.
#[derive(Debug)]
pub(super) struct Sampler {
    unit: Unit,
    every: u64,
    samples: Vec<Sample>,
}

impl Sampler {
    /// Prepares to take some of about so many pixels.
    pub(super) fn new(unit: Unit, pixels: f64) -> Self {
        let every = (pixels as u64 / SAMPLES).max(1) | 1;
        Self {
            unit,
            every,
            samples: Vec::new(),
        }
    }

    /// Takes every so many pixels of a layer that are mixed.
    pub(super) fn take(&mut self, grid: &Grid, drawn: &Drawn) {
        let Drawn {
            layer,
            cells,
            shares,
        } = *drawn;
        // A multiplicative hash (Knuth, The Art of Computer Programming 3, 6.4) spreads the starts.
        let start = u64::from(layer.wrapping_mul(2_654_435_761)) % self.every;
        let mut at = start as usize;
        while at < cells.len() {
            if MIXED.contains(&shares[at]) {
                self.samples.push(Sample {
                    at,
                    layer,
                    moments: self.unit.monomials(grid.middle_mm(at, layer)),
                    is_heavy: cells[at] == Cell::First,
                });
            }
            at += self.every as usize;
        }
    }

    /// Returns the change of shares with the least squares that adds these moments; `None` if too
    /// few pixels are mixed.
    pub(super) fn nudge(&self, lacking: &Ten) -> Option<Nudge> {
        if self.samples.len() < FEWEST_SAMPLES {
            return None;
        }
        let mut sums = SMatrix::<f64, MOMENTS, MOMENTS>::zeros();
        for sample in &self.samples {
            sums += sample.moments * sample.moments.transpose() * self.every as f64;
        }
        let svd = sums.svd(true, true);
        let least = svd.singular_values.max() * FLAT_RATIO;
        let factors = svd.solve(lacking, least).ok()?;
        Some(Nudge {
            unit: self.unit,
            factors,
        })
    }

    /// Returns the pixels to change, each with its layer, so that about these moments are added to
    /// those of the heavier material. Each one is the best that is left, until none helps.
    pub(super) fn changes(&self, lacking: &Ten) -> Vec<(u32, usize)> {
        let mut left = *lacking;
        let mut samples: Vec<&Sample> = self.samples.iter().collect();
        let mut changes = Vec::new();
        while changes.len() < MOST_CHANGES {
            let gains = samples.iter().map(|sample| {
                let added = sample.added();
                2.0 * left.dot(&added) - added.norm_squared()
            });
            let best =
                gains.enumerate().fold(
                    (0, 0.0),
                    |best, (index, gain)| {
                        if gain > best.1 { (index, gain) } else { best }
                    },
                );
            if best.1 <= 0.0 {
                break;
            }
            let sample = samples.swap_remove(best.0);
            left -= sample.added();
            changes.push((sample.layer, sample.at));
        }
        changes.sort_unstable();
        changes
    }
}

impl Sample {
    /// Returns what a change of this pixel adds to the heavier material.
    fn added(&self) -> Ten {
        if self.is_heavy {
            -self.moments
        } else {
            self.moments
        }
    }
}

/// A quadratic that is added to shares between 0 and 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Nudge {
    unit: Unit,
    factors: Ten,
}

impl Nudge {
    /// Returns a share with its change. Pure material stays pure.
    pub(super) fn of(&self, share: f64, at_mm: [f64; 3]) -> f64 {
        if share <= 0.0 || share >= 1.0 {
            return share;
        }
        let change = self.factors.dot(&self.unit.monomials(at_mm));
        (share + change).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{Layers, Pixels};

    #[test]
    fn single_pixels_make_up_what_lacks_within_a_pixel_of_each_moment() {
        let aabb = Aabb::of_points(&[Point::origin(), Point::new(4.0, 3.0, 2.0)]);
        let grid = Grid {
            pixels: Pixels::over(&aabb, [0.1; 2]),
            layers: Layers::up_to(&aabb, 0.1),
        };
        let unit = Unit::of(&aabb, &grid);
        let mut sampler = Sampler::new(unit, 24_000.0);
        let shares = vec![0.5; grid.pixels.area()];
        let places = 0..grid.pixels.area();
        let cells: Vec<Cell> = places
            .map(|at| {
                if at % 2 == 0 {
                    Cell::First
                } else {
                    Cell::Second
                }
            })
            .collect();
        for layer in 0..grid.layers.count {
            let drawn = Drawn {
                layer,
                cells: &cells,
                shares: &shares,
            };
            sampler.take(&grid, &drawn);
        }
        let lacking = Ten::from([31.0, -4.0, 7.5, 0.3, 2.0, -3.0, 1.0, 12.0, 5.0, 3.0]);
        let changes = sampler.changes(&lacking);
        assert!(changes.len() >= 31 && changes.is_sorted(), "{changes:?}");
        let added = changes.iter().fold(Ten::zeros(), |sum, (layer, at)| {
            let moments = unit.monomials(grid.middle_mm(*at, *layer));
            if cells[*at] == Cell::First {
                sum - moments
            } else {
                sum + moments
            }
        });
        // Half a pixel is what rounding leaves of one moment; ten share the same pixels.
        assert!((lacking - added).amax() < 1.0, "{}", lacking - added);
        let nudge = sampler.nudge(&lacking).unwrap();
        let spread = (0..grid.layers.count).fold(Ten::zeros(), |sum, layer| {
            (0..grid.pixels.area()).fold(sum, |sum, at| {
                let at_mm = grid.middle_mm(at, layer);
                sum + unit.monomials(at_mm) * (nudge.of(0.5, at_mm) - 0.5)
            })
        });
        assert!((lacking - spread).amax() < 0.5, "{}", lacking - spread);
        assert_eq!(nudge.of(1.0, [0.0; 3]), 1.0);
    }
}
