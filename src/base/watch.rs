//! Watch of a long run: named phases reported to the caller, and a flag by which the caller stops
//! it.

use std::sync::atomic::{AtomicBool, Ordering};

/// Called with a phase's name and how far it has come, 0 to 1.
pub type Observer = dyn Fn(&str, f64) + Sync;

/// What a long run tells its caller, and how the caller stops it.
///
/// The library never prints: the command line draws bars from these calls, tests pass
/// [`Watch::silent`].
pub struct Watch<'a> {
    observer: Option<&'a Observer>,
    cancelled: AtomicBool,
}

impl<'a> Watch<'a> {
    /// Reports nothing.
    pub fn silent() -> Self {
        Self {
            observer: None,
            cancelled: AtomicBool::new(false),
        }
    }

    /// Calls `observer(phase, done_ratio)` at the start of each phase (ratio 0) and as it advances
    /// (up to 1).
    pub fn observed(observer: &'a Observer) -> Self {
        Self {
            observer: Some(observer),
            cancelled: AtomicBool::new(false),
        }
    }

    /// Tells the observer how far the named phase has come, 0 to 1.
    pub fn report(&self, phase: &str, done_ratio: f64) {
        if let Some(observer) = self.observer {
            observer(phase, done_ratio);
        }
    }

    /// Asks the run to stop at its next check.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the caller has asked the run to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}
