//! Shells on their way: which pairs come too near.

use rayon::prelude::*;

use super::contact::{Body, seen_from};
use super::motion::TelescopeMotion;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Frame;

/// States looked at in each move besides its ends.
pub(super) const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

/// Share of the clearance that shells must keep that do not slide in each other.
pub(super) const APART_SHARE: f64 = 0.9;

/// Two placements are the same up to this, mm: rounding.
pub(super) const SAME_MM: f64 = 1e-9;

/// Shells that move, and the gap that they keep.
pub(super) struct Course<'a> {
    pub motion: &'a TelescopeMotion,
    pub bodies: &'a [Body],
    pub limit_mm: f64,
}

impl Course<'_> {
    /// Returns the pairs of shells, not neighbours, that come nearer than the limit over some keys,
    /// and the number of states that were looked at.
    pub fn far_pairs(
        &self,
        keys: &[&[[f64; 2]]],
        watch: &Watch,
    ) -> Result<(Vec<String>, usize), Cancelled> {
        let mut looked = Looked::default();
        let mut states = 0;
        for (number, pair) in keys.windows(2).enumerate() {
            let first = (number == 0).then_some(0.0);
            for share in first.into_iter().chain(BETWEEN).chain([1.0]) {
                watch.check()?;
                states += 1;
                let frames = self.motion.frames(&mixed(pair[0], pair[1], share));
                let state = format!("move {}", number + 1);
                looked.look(self.bodies, &frames, self.limit_mm, &state);
            }
        }
        Ok((looked.too_near, states))
    }
}

/// Two shells, from 0, and the frame of the second in that of the first.
struct Pair {
    shells: [usize; 2],
    placed: Frame,
}

/// The pairs that were looked at, each where it was last.
#[derive(Default)]
struct Looked {
    last: Vec<Pair>,
    too_near: Vec<String>,
}

impl Looked {
    fn look(&mut self, bodies: &[Body], frames: &[Frame], limit_mm: f64, state: &str) {
        let count = bodies.len();
        let pairs = (0..count).flat_map(|i| (i + 2..count).map(move |j| [i, j]));
        let placed = pairs.map(|[i, j]| Pair {
            shells: [i, j],
            placed: seen_from(&frames[i], &frames[j]),
        });
        let placed: Vec<Pair> = placed.filter(|pair| !self.is_known(pair)).collect();
        let near = placed.par_iter().filter(|pair| {
            let [i, j] = pair.shells;
            bodies[i].is_nearer(&bodies[j], &pair.placed, limit_mm)
        });
        let words = |pair: &Pair| {
            let [i, j] = pair.shells;
            format!("S{:02} and S{:02} in {state}", i + 1, j + 1)
        };
        let near: Vec<String> = near.map(words).collect();
        self.too_near.extend(near);
        for pair in placed {
            self.last.retain(|last| last.shells != pair.shells);
            self.last.push(pair);
        }
    }

    fn is_known(&self, pair: &Pair) -> bool {
        self.last.iter().any(|last| {
            last.shells == pair.shells
                && (last.placed.origin - pair.placed.origin).norm() < SAME_MM
                && (last.placed.axes - pair.placed.axes).amax() < SAME_MM
        })
    }
}

pub(super) fn mixed(from: &[[f64; 2]], to: &[[f64; 2]], share: f64) -> Vec<[f64; 2]> {
    let ends = from.iter().zip(to);
    ends.map(|(a, b)| [0, 1].map(|i| a[i] + (b[i] - a[i]) * share))
        .collect()
}
