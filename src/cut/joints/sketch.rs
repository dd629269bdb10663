//! Sketches of jigs: their outlines, before any surface is made, and the play of what they hold.

use std::cmp::Ordering;

use super::cradle::View;
use crate::geom::play::{Play, Spot};

/// The outlines of a jig in the view along its joint.
#[derive(Clone)]
pub(super) struct Sketch {
    pub(super) view: View,
    /// The outlines of the ribs below and above the joint.
    pub(super) ribs: [Vec<Spot>; 2],
    /// The distances of the ribs' faces from the joint, mm.
    pub(super) ribs_mm: [f64; 2],
    /// The heights of the plate's two faces, mm.
    pub(super) plate: [f64; 2],
}

/// A sketch that holds its parts.
#[derive(Clone)]
pub(super) struct Held {
    pub(super) sketch: Sketch,
    pub(super) play: Play,
}

impl Sketch {
    /// Returns an upper bound of its volume, mm³.
    pub(super) fn volume_mm3(&self) -> f64 {
        let [low, _] = self.plate;
        let area = |rib: &Vec<Spot>| {
            let sides = rib.windows(2);
            let areas = sides.map(|s| (s[1].x - s[0].x) * (0.5 * (s[0].y + s[1].y) - low));
            areas.sum::<f64>()
        };
        self.ribs.iter().map(area).sum::<f64>() * (self.ribs_mm[1] - self.ribs_mm[0])
    }
}

impl Held {
    /// Returns the order of two jigs, the better first: the tighter one if either is not tight,
    /// else the smaller one.
    pub(super) fn compare(&self, other: &Self, tight_mm: f64) -> Ordering {
        let [step_mm, other_mm] = [self, other].map(|held| held.play.step_mm.max(tight_mm));
        let volumes = || [self, other].map(|held| held.sketch.volume_mm3());
        let by_volume = || volumes()[0].total_cmp(&volumes()[1]);
        step_mm.total_cmp(&other_mm).then_with(by_volume)
    }
}

/// Returns the least and the greatest of some values.
pub(super) fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}
