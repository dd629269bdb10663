//! Joints tried: gaps over the stroke, stops, twist stops, the way back.

use super::contact::Body;
use super::motion::{JointMotion, TelescopeMotion};
use super::promise::JointPromise;

/// Slides at which the gap of a joint is measured, as shares of its free stroke.
const STROKE: [f64; 4] = [0.0, 0.35, 0.7, 1.0];

/// By how much before its stop a shell must be free, mm.
const FREE_MM: f64 = 0.02;
/// By how much beyond its stop a shell must be held, mm: more than the error of facets.
const HELD_MM: f64 = 0.05;
/// Angle beyond the play at which a twist stop must hold, rad: 2°.
const BEYOND_RAD: f64 = 0.034_906_585;

/// The facts about a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointFacts {
    /// Its id.
    pub id: String,
    /// The least gap over the stroke, before seats close, mm.
    pub gap_mm: f64,
    /// The slide at which it is least, mm.
    pub at_mm: f64,
    /// The faults of its stops, in words.
    pub stop_faults: Vec<String>,
    /// The faults of its twist stop, in words.
    pub twist_faults: Vec<String>,
    /// True if the shell can leave backwards.
    pub is_open_behind: bool,
}

/// A joint that is tried.
pub(super) struct Trial<'a> {
    pub motion: &'a TelescopeMotion,
    pub joint: usize,
    pub outer: &'a Body,
    pub inner: &'a Body,
}

impl Trial<'_> {
    fn own(&self) -> &JointMotion {
        &self.motion.joints[self.joint]
    }

    fn touches(&self, slide_mm: f64, turn_rad: f64) -> bool {
        let placed = self.motion.step(self.joint, [slide_mm, turn_rad]);
        self.outer.touches(self.inner, &placed)
    }

    /// Tries everything that a joint promises.
    pub fn facts(&self, promise: &JointPromise) -> JointFacts {
        let from = self.own().closed_mm;
        let slides = STROKE.map(|share| from + share * (promise.free_to_mm - from));
        let gaps = slides.map(|slide| {
            let placed = self.motion.step(self.joint, [slide, 0.0]);
            (self.outer.gap_mm(self.inner, &placed), slide)
        });
        let none = (f64::INFINITY, from);
        let (gap_mm, at_mm) = gaps
            .into_iter()
            .fold(none, |least, one| if one.0 < least.0 { one } else { least });
        JointFacts {
            id: promise.id.clone(),
            gap_mm,
            at_mm,
            stop_faults: self.stop_faults(promise),
            twist_faults: self.twist_faults(promise),
            is_open_behind: !self.touches(promise.back_mm, 0.0),
        }
    }

    fn stop_faults(&self, promise: &JointPromise) -> Vec<String> {
        let stop = promise.stop_mm;
        let id = &promise.id;
        let early = self.touches(stop - FREE_MM, 0.0);
        let late = !self.touches(stop + HELD_MM, 0.0);
        let early = early.then(|| format!("{id} is held before its stop at {stop:.2} mm"));
        let late = late.then(|| format!("{id} goes on beyond its stop at {stop:.2} mm"));
        early.into_iter().chain(late).collect()
    }

    fn twist_faults(&self, promise: &JointPromise) -> Vec<String> {
        let own = self.own();
        let (id, out_mm) = (&promise.id, own.open_mm - FREE_MM);
        let sign = if own.turn_rad < 0.0 { -1.0 } else { 1.0 };
        let beyond = promise.play_rad + BEYOND_RAD;
        let free = [0.0, 0.5 * own.turn_rad, own.turn_rad];
        let held = [own.turn_rad + sign * beyond, -sign * beyond];
        let degrees = f64::to_degrees;
        let bound = free.into_iter().filter(|turn| self.touches(out_mm, *turn));
        let bound = bound.map(|turn| format!("{id} is held at a turn of {:.1}°", degrees(turn)));
        let loose = held.into_iter().filter(|turn| !self.touches(out_mm, *turn));
        let loose = loose.map(|turn| format!("{id} turns on to {:.1}°", degrees(turn)));
        bound.chain(loose).collect()
    }
}
