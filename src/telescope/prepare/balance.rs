//! Mass and centre of a telescope in every state, and the lean at which it topples.

use crate::geom::{Frame, Point, Vector};
use crate::telescope::balance::DiscFoot;
use crate::telescope::motion::{Opening, between};
use crate::telescope::nest::{JointState, Telescope};
use crate::telescope::sizes::JointSizes;
use crate::telescope::tube::TubeMass;

/// States of each move at which the balance is taken.
pub(super) const STATES: usize = 20;

/// The balance in a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balanced {
    /// The centre of volume, mm, model frame.
    pub centre: Point,
    /// The distance from the centre's foot to the edge of the foot, mm, with all play taken up.
    pub margin_mm: f64,
    /// The lean at which it topples, rad.
    pub toppling_rad: f64,
    /// The same with all play taken up, rad.
    pub sagged_rad: f64,
}

/// A telescope with the masses of its shells, on a foot.
pub struct Standing<'a> {
    pub telescope: &'a Telescope,
    /// Volume and centre of every shell with its cap, in the shell's frame.
    pub masses: &'a [TubeMass],
    pub foot: DiscFoot,
}

impl Standing<'_> {
    /// Returns the balance in a state.
    pub fn at(&self, states: &[JointState]) -> Balanced {
        let frames = self.telescope.frames(states);
        let placed: Vec<TubeMass> = self
            .masses
            .iter()
            .zip(&frames)
            .map(|(mass, frame)| TubeMass {
                centre: frame.to_model(&mass.centre),
                ..*mass
            })
            .collect();
        let centre = centre(&placed);
        let local = ground(self.telescope).to_local(&centre);
        // The edge on which it rests is chamfered.
        let edge_mm = self.foot.radius_mm - self.telescope.sizes.chamfer_mm;
        let margin_mm = edge_mm - local.y.hypot(local.z);
        let height_mm = local.x + drop_mm(self.telescope, &self.foot);
        let sagged_mm = margin_mm - self.sag_mm(&placed, &frames);
        Balanced {
            centre,
            margin_mm: sagged_mm,
            toppling_rad: margin_mm.atan2(height_mm),
            sagged_rad: sagged_mm.atan2(height_mm),
        }
    }

    /// Returns how far the centre moves if all joints that are out tilt to the limit of their play
    /// the same way, mm.
    fn sag_mm(&self, placed: &[TubeMass], frames: &[Frame]) -> f64 {
        let whole: f64 = placed.iter().map(|mass| mass.volume_mm3).sum();
        let joints = self.telescope.joints.iter().enumerate();
        let sags = joints.map(|(joint, own)| {
            let beyond = &placed[joint + 1..];
            let volume: f64 = beyond.iter().map(|mass| mass.volume_mm3).sum();
            let lever = (centre(beyond) - frames[joint + 1].origin).norm();
            tilt_rad(own.seat_mm, &self.telescope.sizes) * lever * volume / whole
        });
        sags.sum()
    }

    /// Returns the state of an opening in which it topples first, with its balance.
    pub fn worst(&self, opening: &Opening) -> (Vec<JointState>, Balanced) {
        let first = opening.keys.first().cloned().unwrap_or_default();
        let start = (first.clone(), self.at(&first));
        let moves = opening.keys.windows(2);
        let states = moves.flat_map(|pair| {
            (1..=STATES).map(|i| between(&pair[0], &pair[1], i as f64 / STATES as f64))
        });
        states.fold(start, |worst, state| {
            let found = self.at(&state);
            let is_worse = found.sagged_rad < worst.1.sagged_rad;
            if is_worse { (state, found) } else { worst }
        })
    }
}

/// Returns the tilt that the play of a seat allows, rad: two rings an overlap apart.
pub fn tilt_rad(seat_mm: f64, sizes: &JointSizes) -> f64 {
    2.0 * seat_mm / sizes.overlap_mm()
}

pub(super) fn centre(placed: &[TubeMass]) -> Point {
    let volume: f64 = placed.iter().map(|mass| mass.volume_mm3).sum();
    let weighed = placed
        .iter()
        .map(|mass| mass.centre.coords * mass.volume_mm3);
    Point::from(weighed.sum::<Vector>() / volume)
}

/// Returns the frame of the root's tail in the model frame: its x axis is up.
pub fn ground(telescope: &Telescope) -> Frame {
    telescope.start.frame_to_model(&tail(telescope))
}

/// Returns the frame of the root's tail in that of the root.
pub(super) fn tail(telescope: &Telescope) -> Frame {
    let helix = &telescope.shells[0].helix;
    helix.frame_at(telescope.ends_mm()[0])
}

/// Returns how far a foot reaches below the root's tail, mm. In place it lies around the root.
pub(super) fn drop_mm(telescope: &Telescope, foot: &DiscFoot) -> f64 {
    match telescope.sizes.is_in_place() {
        true => 0.0,
        false => foot.height_mm,
    }
}
