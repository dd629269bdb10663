//! The rounds of a run whose kits are sliced, and the best kit of them.

use super::judge::Draft;
use super::load::infill_ratio;
use super::outcome::Outcome;
use super::weighed::Weighed;
use crate::job::SlicedRound;
use crate::run::Placed;

/// The end of a run whose kits were sliced.
#[derive(Debug)]
pub struct SlicedOutcome {
    /// The kit whose toolpaths came nearest to its promise.
    pub outcome: Outcome,
    /// The distance between the centre of the toolpaths and the promised one in every round, mm.
    pub misses_mm: Vec<f64>,
    /// The infill that the slicer lays, over what the printer's profile says; `None` for as much.
    pub infill_ratio: Option<f64>,
    /// The promises that the toolpaths of the kit break, in words; empty if they keep all.
    pub broken: Vec<String>,
}

/// The kit of a round, and the weight of its toolpaths.
pub struct Kept {
    pub round: Placed,
    pub draft: Draft,
    pub weighed: Weighed,
}

/// The rounds so far.
#[derive(Default)]
pub struct Rounds {
    pub sliced: Vec<SlicedRound>,
    pub misses_mm: Vec<f64>,
    pub best: Option<Box<Kept>>,
    pub broken: Vec<String>,
}

impl Rounds {
    /// Adds a round; returns true if it is near enough to be the last.
    pub fn add(&mut self, round: Placed, draft: Draft, weighed: Weighed) -> bool {
        self.misses_mm.push(weighed.miss_mm);
        self.sliced.push(weighed.round(infill_ratio(&self.sliced)));
        let is_near = weighed.is_near();
        let best = self.best.as_ref();
        if best.is_none_or(|best| weighed.is_better_than(&best.weighed)) {
            self.best = Some(Box::new(Kept {
                round,
                draft,
                weighed,
            }));
        }
        is_near
    }

    /// Returns the end of the run with its kit, or with the proof that there is none.
    pub fn end(self, outcome: Outcome) -> SlicedOutcome {
        SlicedOutcome {
            outcome,
            infill_ratio: infill_ratio(&self.sliced),
            misses_mm: self.misses_mm,
            broken: self.broken,
        }
    }
}
