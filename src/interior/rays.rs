//! The rays of Wu, Kramer and Westermann: on every stretch of a vertical line one solid segment, by
//! its two ends.

use rayon::prelude::*;

use super::choice::Choice;
use super::columns::Columns;
use super::emptied::{Emptied, whole};
use super::moments::{BLOCK, block_sums};
use super::section::mean_on_column;
use crate::geom::Quadric;
use crate::mass::Moments;

/// Length of a segment, as a share of its stretch, below which it has vanished and its place no
/// longer matters.
const VANISHED_RATIO: f64 = 1e-6;
/// Depth of q below zero, in its own unit, from which a segment opens again. The gain that is left
/// is of the order of its square.
const WORTH_OPENING: f64 = 1e-4;
/// Least distance from the top of its stretch at which a segment opens again, as a share of the
/// stretch. The segment then has room to grow upward.
const ROOM_RATIO: f64 = 0.01;

/// Stretches of columns that may be emptied, each with a solid segment z₀ ≤ z ≤ z₁ in it.
///
/// This is the ray-rep of an interior (Wu, Kramer, Westermann, "Shape interior modeling and mass
/// property optimization using ray-reps", 2016). The parts below z₀ and above z₁ are emptied. The
/// bounds z̲ ≤ z₀ ≤ z₁ ≤ z̄ of the stretch (their eq. 11, 13, 14) hold by construction. The numbers
/// are t₀ and t₁ between 0 and 1, with
///
/// ```text
/// z₀ = z̲ + t₀ (z̄ − z̲),    z₁ = z₀ + t₁ (z̄ − z₀)
/// ```
///
/// A line that meets the region in several stretches has a segment in each. One segment is enough
/// for every goal here: the best void is the region in which a quadric is positive. On a line the
/// quadric has two roots and is positive outside of them, since every goal prefers a smaller ∫z².
#[derive(Debug, Clone)]
pub struct Rays<'a> {
    columns: &'a Columns,
    stretches: Vec<Stretch>,
    whole: Moments,
    weights: Vec<f64>,
}

/// An interval and its column.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    column: u32,
    bottom: f64,
    top: f64,
}

impl Stretch {
    /// Returns z₀ and z₁.
    fn segment(&self, t: &[f64]) -> [f64; 2] {
        let z0 = self.bottom + t[0] * (self.top - self.bottom);
        [z0, z0 + t[1] * (self.top - z0)]
    }
}

impl<'a> Rays<'a> {
    /// Returns the rays through the centres of the columns.
    pub fn of(columns: &'a Columns) -> Self {
        let of_column = |column: usize| {
            let stretch = move |&[bottom, top]: &[f64; 2]| Stretch {
                column: column as u32,
                bottom,
                top,
            };
            columns.intervals_of(column).iter().map(stretch)
        };
        let stretches: Vec<Stretch> = (0..columns.len()).flat_map(of_column).collect();
        let whole = columns.moments();
        let area_mm2 = columns.pitch_mm[0] * columns.pitch_mm[1];
        let weight = |stretch: &Stretch| (stretch.top - stretch.bottom) * area_mm2 / whole.volume();
        let weights = stretches
            .iter()
            .flat_map(|stretch| [weight(stretch); 2])
            .collect();
        Self {
            columns,
            stretches,
            whole,
            weights,
        }
    }

    /// Returns the numbers with vanished segments moved to the least q on their stretch; `None` if
    /// no segment would gain by that.
    ///
    /// A vanished segment has no derivative that shows where material is needed, so an optimiser
    /// has to open it explicitly.
    pub fn reopen(&self, x: &[f64], quadric: &Quadric) -> Option<Vec<f64>> {
        let mut moved = x.to_vec();
        for (stretch, t) in self.stretches.iter().zip(moved.chunks_exact_mut(2)) {
            let [z0, z1] = stretch.segment(t);
            let length = stretch.top - stretch.bottom;
            if z1 - z0 > VANISHED_RATIO * length {
                continue;
            }
            let [c0, c1, c2] = mean_on_column(self.columns, stretch.column as usize, quadric);
            let q = |z: f64| c0 + z * (c1 + z * c2);
            let places = [
                stretch.bottom,
                stretch.top - ROOM_RATIO * length,
                (-0.5 * c1 / c2),
            ];
            let inside = places
                .into_iter()
                .filter(|z| *z >= stretch.bottom && *z <= places[1]);
            let Some(best) = inside.min_by(|a, b| q(*a).total_cmp(&q(*b))) else {
                continue;
            };
            if q(best) < -WORTH_OPENING && q(best) < q(z0) {
                t.copy_from_slice(&[(best - stretch.bottom) / length, 0.0]);
            }
        }
        (moved != x).then_some(moved)
    }

    fn area_mm2(&self) -> f64 {
        self.columns.pitch_mm[0] * self.columns.pitch_mm[1]
    }

    /// Returns the derivative of ∫q over the void with respect to t₀ and t₁, over the weight: from
    /// q at both ends.
    fn derivative_of(&self, stretch: &Stretch, t: &[f64], quadric: &Quadric) -> [f64; 2] {
        let [c0, c1, c2] = mean_on_column(self.columns, stretch.column as usize, quadric);
        let [q0, q1] = stretch.segment(t).map(|z| c0 + z * (c1 + z * c2));
        let volume = self.whole.volume();
        [
            (q0 - (1.0 - t[1]) * q1) * volume,
            -(1.0 - t[0]) * q1 * volume,
        ]
    }
}

impl Choice for Rays<'_> {
    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn nothing(&self) -> Vec<f64> {
        [0.0, 1.0].repeat(self.stretches.len())
    }

    fn moments(&self, x: &[f64]) -> Moments {
        let kept = block_sums(self.stretches.len(), |i| {
            let stretch = &self.stretches[i];
            self.columns.moments_between(
                stretch.column as usize,
                stretch.segment(&x[2 * i..2 * i + 2]),
            )
        });
        self.whole - kept * self.area_mm2()
    }

    fn derivative(&self, x: &[f64], quadric: &Quadric, out: &mut [f64]) {
        let blocks = out.par_chunks_mut(2 * BLOCK).zip(x.par_chunks(2 * BLOCK));
        blocks
            .zip(self.stretches.par_chunks(BLOCK))
            .for_each(|((out, x), stretches)| {
                for ((out, t), stretch) in out
                    .chunks_exact_mut(2)
                    .zip(x.chunks_exact(2))
                    .zip(stretches)
                {
                    out.copy_from_slice(&self.derivative_of(stretch, t, quadric));
                }
            });
    }

    fn emptied(&self, x: &[f64]) -> Emptied {
        let mut pieces = vec![Vec::new(); self.columns.len()];
        for (stretch, t) in self.stretches.iter().zip(x.chunks_exact(2)) {
            let [z0, z1] = stretch.segment(t);
            pieces[stretch.column as usize]
                .extend([[stretch.bottom, z0], [z1, stretch.top]].map(whole));
        }
        Emptied::of_columns(pieces.into_iter())
    }
}

#[cfg(test)]
mod tests {
    use super::super::choice::testing;
    use super::*;

    #[test]
    fn rays_have_the_moments_of_their_pieces_and_the_slopes_of_differences() {
        let columns = testing::uneven_columns();
        testing::check_choice(&Rays::of(&columns), &columns);
    }

    #[test]
    fn a_vanished_segment_opens_again_only_if_material_is_needed_there() {
        let columns = testing::uneven_columns();
        let rays = Rays::of(&columns);
        let wanted = Quadric([-1.0, 0., 0., 0., 0., 0., 0., 0., 0., 1.0]);
        let all_vanished = [1.0, 0.0].repeat(rays.count() / 2);
        let moved = rays.reopen(&all_vanished, &wanted).unwrap();
        for (stretch, t) in rays.stretches.iter().zip(moved.chunks_exact(2)) {
            let reaches = stretch.bottom < 1.0 && stretch.top > -1.0;
            let z = stretch.segment(t)[0];
            assert_eq!(z.abs() < 1.0, reaches, "{stretch:?} at {z}");
        }
        assert_eq!(rays.reopen(&moved, &wanted), None);
        assert_eq!(rays.reopen(&rays.nothing(), &wanted), None);
    }

    #[test]
    fn a_segment_never_leaves_its_stretch_nor_turns_over() {
        let stretch = Stretch {
            column: 0,
            bottom: -2.0,
            top: 5.0,
        };
        for t in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.3, 0.8]] {
            let [z0, z1] = stretch.segment(&t);
            assert!(stretch.bottom <= z0 && z0 <= z1 && z1 <= stretch.top);
        }
    }
}
