//! The lowest place of a telescope along its opening, against the ground under its root.

use super::balance::{STATES, Standing, drop_mm, ground};
use crate::telescope::motion::{Opening, between};
use crate::telescope::nest::JointState;

/// Places along each shell at which its height is taken, from its tail to its mouth.
const PLACES: usize = 64;

/// Depth below the ground that is rounding, mm.
const ROUNDING_MM: f64 = 1e-6;

/// The lowest place of a telescope over the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lowest {
    /// The shell, from 0.
    pub shell: usize,
    /// Its height over the plane of the root's tail, mm: negative below.
    pub height_mm: f64,
}

impl Standing<'_> {
    /// Returns the lowest place of all shells in a state.
    ///
    /// A tube reaches below its centre line by its radius times the sine of its slope: the lowest
    /// point of the disc square to it.
    pub fn lowest(&self, states: &[JointState]) -> Lowest {
        let telescope = self.telescope;
        let to_ground = ground(telescope).inverse();
        let [tail, mouth] = telescope.ends_mm();
        let frames = telescope.frames(states);
        let places = frames.iter().enumerate().flat_map(|(shell, frame)| {
            let placed = to_ground.frame_to_model(frame);
            let own = &telescope.shells[shell];
            (0..=PLACES).map(move |i| {
                let arc = tail + (mouth - tail) * i as f64 / PLACES as f64;
                let at = placed.frame_to_model(&own.helix.frame_at(arc));
                let slope = at.axes[(0, 0)];
                let reach_mm = own.body_mm * (1.0 - slope * slope).max(0.0).sqrt();
                Lowest {
                    shell,
                    height_mm: at.origin.x - reach_mm,
                }
            })
        });
        let first = Lowest {
            shell: 0,
            height_mm: 0.0,
        };
        places.fold(first, |lowest, place| {
            let is_lower = place.height_mm < lowest.height_mm - ROUNDING_MM;
            if is_lower { place } else { lowest }
        })
    }

    /// Returns the lowest place over an opening, with 20 states of each move.
    pub fn lowest_over(&self, opening: &Opening) -> Option<Lowest> {
        let first = opening.keys.first().map(|key| self.lowest(key));
        let moves = opening.keys.windows(2);
        let states = moves.flat_map(|pair| {
            (1..=STATES).map(|i| between(&pair[0], &pair[1], i as f64 / STATES as f64))
        });
        let places = states.map(|state| self.lowest(&state));
        let all = first.into_iter().chain(places);
        all.min_by(|a, b| a.height_mm.total_cmp(&b.height_mm))
    }

    /// Returns true if nothing reaches below the ground in a state: it may stand on its root.
    pub fn is_clear(&self, lowest: &Lowest) -> bool {
        lowest.height_mm >= -drop_mm(self.telescope, &self.foot) - ROUNDING_MM
    }
}
