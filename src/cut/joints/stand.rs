//! A body beside a joint as a jig would hold it, and the play that is left.

use super::cradle::{Cradle, View};
use super::sketch::{Held, Sketch};
use super::stops::stops_at;
use crate::geom::play::{Seat, Spot, Stop};

/// Distance within which a corner of the body counts as stopped by the cradle, mm.
pub(super) const REACH_MM: f64 = 1.0;

/// The body beside a joint, seen along one way out, over ribs of one thickness.
pub(super) struct Stand {
    pub(super) view: View,
    /// The distances of the ribs' faces from the joint, mm.
    pub(super) ribs_mm: [f64; 2],
    /// The corners of the joint's rim.
    pub(super) rim: Vec<Spot>,
    /// The least and the greatest height of the rim, mm.
    pub(super) heights: [f64; 2],
    /// The points of the body over either rib that its cradle may stop.
    pub(super) points: [Vec<Spot>; 2],
    pub(super) cradles: [Cradle; 2],
    /// The least height of the body beside the joint, mm.
    pub(super) under_seam_mm: f64,
    /// The stop by which the parts are pressed into it.
    pub(super) press: Stop,
    /// The middle of the motions that are compared.
    pub(super) middle: Spot,
}

impl Stand {
    /// Estimates the play of the parts in a jig; `None` if they slide or turn even so.
    pub(super) fn hold_roughly(&self, sketch: &Sketch) -> Option<Held> {
        self.hold(sketch, |side| {
            stops_at(&self.points[side], &sketch.ribs[side], REACH_MM)
        })
    }

    /// Measures the play of the parts in a jig with some stops on either side.
    pub(super) fn hold(&self, sketch: &Sketch, stops: impl Fn(usize) -> Vec<Stop>) -> Option<Held> {
        let seat = |side: usize| Seat::pressed(&stops(side), &self.press, self.middle);
        let play = seat(0)?.play_between(&seat(1)?, self.middle, &self.rim);
        Some(Held {
            sketch: sketch.clone(),
            play,
        })
    }
}

/// Returns the heights of the ribs on either side of a joint, from below, mm.
pub(super) fn heights_of([near, far]: [f64; 2]) -> [[f64; 2]; 2] {
    [[-far, -near], [near, far]]
}
