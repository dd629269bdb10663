//! Networks: telescopes that grow from junctures and carry others.
//!
//! All is given where it is when all is out. A juncture then lies in the model's frame. The root of
//! a telescope is fixed in the juncture it grows from, and its last shell carries the next one.

use super::motion::{Key, Opening};
use super::nest::{JointState, Telescope};
use crate::geom::Frame;

/// A telescope between two junctures.
#[derive(Debug, Clone, PartialEq)]
pub struct Limb {
    /// Its name on the sheet, such as `A`.
    pub id: String,
    /// The juncture that holds its root, counted from 0.
    pub from: usize,
    /// The juncture that its last shell carries.
    pub to: usize,
    /// The shells.
    pub telescope: Telescope,
    /// A free way to open it alone.
    pub opening: Opening,
}

/// A tree of junctures and telescopes. The first juncture stands still.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    /// The number of junctures.
    pub junctures: usize,
    /// The telescopes, each after the one that carries it.
    pub limbs: Vec<Limb>,
}

/// The places of all bodies in a state.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkFrames {
    /// The motion of each juncture from where it is when all is out.
    pub junctures: Vec<Frame>,
    /// The frames of the shells of each telescope.
    pub shells: Vec<Vec<Frame>>,
}

impl Network {
    /// Returns a single telescope on bare ends.
    pub fn alone(telescope: Telescope, opening: Opening) -> Self {
        let limb = Limb {
            id: String::new(),
            from: 0,
            to: 1,
            telescope,
            opening,
        };
        Self {
            junctures: 2,
            limbs: vec![limb],
        }
    }

    /// Returns the state with all shells in.
    pub fn closed(&self) -> Vec<Key> {
        let closed = self.limbs.iter().map(|limb| limb.telescope.closed());
        closed.collect()
    }

    /// Returns the places of all bodies in a state of every telescope's joints.
    pub fn frames(&self, state: &[Vec<JointState>]) -> NetworkFrames {
        let mut frames = NetworkFrames {
            junctures: vec![Frame::identity(); self.junctures],
            shells: Vec::new(),
        };
        for (limb, state) in self.limbs.iter().zip(state) {
            let base = frames.junctures[limb.from];
            let own = limb.telescope.frames(state);
            let end = |frames: &[Frame]| frames.last().copied().unwrap_or(limb.telescope.start);
            let open = end(&limb.telescope.frames(&limb.telescope.open()));
            let carried = end(&own).frame_to_model(&open.inverse());
            frames.junctures[limb.to] = base.frame_to_model(&carried);
            let placed = own.iter().map(|frame| base.frame_to_model(frame));
            frames.shells.push(placed.collect());
        }
        frames
    }

    /// Returns the states between moves if the telescopes open one after the other, each in its own
    /// order.
    pub fn keys(&self, sequence: &[usize]) -> Vec<Vec<Key>> {
        let mut state = self.closed();
        let mut keys = vec![state.clone()];
        for limb in sequence {
            for key in self.limbs[*limb].opening.keys.iter().skip(1) {
                state[*limb].clone_from(key);
                keys.push(state.clone());
            }
        }
        keys
    }

    /// Returns true for every juncture that moves with a telescope: beyond it, or beyond one that
    /// is carried by it.
    pub fn carried_by(&self, limb: usize) -> Vec<bool> {
        let mut carried = vec![false; self.junctures];
        carried[self.limbs[limb].to] = true;
        for next in self.limbs.iter().skip(limb + 1) {
            if carried[next.from] {
                carried[next.to] = true;
            }
        }
        carried
    }
}
