//! How long the stages take.

use std::time::Instant;

use crate::sheet::Timing;

/// Adds up the time of each stage.
#[derive(Debug, Clone)]
pub struct Stopwatch {
    last: Instant,
    timing: Timing,
}

impl Stopwatch {
    /// Starts now.
    pub fn start() -> Self {
        Self {
            last: Instant::now(),
            timing: Timing::default(),
        }
    }

    /// Gives the time since the last lap to `stage`.
    pub fn lap(&mut self, stage: &str) {
        let now = Instant::now();
        let seconds = (now - self.last).as_secs_f64();
        self.last = now;
        match self.timing.0.iter_mut().find(|(name, _)| name == stage) {
            Some((_, total)) => *total += seconds,
            None => self.timing.push(stage, seconds),
        }
    }

    /// The stages and their seconds.
    pub fn timing(&self) -> Timing {
        self.timing.clone()
    }
}
