//! What is asked of a kit's promises as a whole.

use super::{Cleaning, InfillOrder, Promise, beyond_ratio, infill_share};
use crate::mass::Moments;

/// The process whose voids drain, and need a vent for air.
const VAT: &str = "sla";

impl Promise {
    /// Returns whether a liquid drains from the voids.
    pub(super) fn drains_liquid(&self) -> bool {
        self.printer.process.as_deref() == Some(VAT)
    }

    /// Returns whether holes empty a void of this process: what is broken or dug out needs sight.
    pub(super) fn can_drain(&self, cleaning: &Cleaning) -> bool {
        !cleaning.rule.needs_sight() || self.drains_liquid()
    }

    /// Returns the moments of what a slicer is said to lay beyond surfaces and regions, in the
    /// model frame; `None` if the kit says nothing of it.
    pub(super) fn laid_beyond(&self) -> Option<Moments> {
        let hollow = self.laid.as_ref().map(|laid| Moments(laid.beyond));
        let infill = self
            .infill
            .as_ref()
            .filter(|infill| infill.beyond.is_some());
        match (hollow, infill.map(InfillOrder::beyond)) {
            (Some(hollow), Some(infill)) => Some(hollow + infill),
            (hollow, infill) => hollow.or(infill),
        }
    }

    /// Returns what a slicer is said to lay beyond a written print and beyond the profile's infill,
    /// over the most that slicers lay; `None` if the kit says nothing of it.
    pub(super) fn beyond_ratio(&self, written: &Moments) -> Option<f64> {
        let beyond = self.laid_beyond();
        let beyond = beyond.map(|beyond| beyond_ratio(&beyond.0, written));
        let slicer = self.infill.as_ref().and_then(|infill| infill.slicer_ratio);
        let slicer = slicer.map(infill_share);
        beyond.into_iter().chain(slicer).reduce(f64::max)
    }

    /// Returns the gap ordered between the pins and sockets of a joint, mm; 0 for a joint that is
    /// not in the list.
    pub(super) fn clearance_mm(&self, joint: &str) -> f64 {
        let found = self.joints.iter().find(|known| known.id == joint);
        found.map_or(0.0, |joint| joint.clearance_mm)
    }
}
