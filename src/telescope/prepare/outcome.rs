//! The end of a run: a kit, or the reason why there is none.

use serde::Serialize;

use crate::base::setting::Setting;
use crate::kit::Kit;
use crate::sheet::Verdict;
use crate::sheet::telescope::{TelescopeSheet, TradeRow};

/// The end of a run.
#[derive(Debug)]
pub enum Outcome {
    /// A kit, whose checks may still have failed.
    Prepared(Box<Prepared>),
    /// No telescope follows the curve as asked.
    Impossible(Box<Impossible>),
}

/// A kit in memory.
#[derive(Debug)]
pub struct Prepared {
    /// The files.
    pub kit: Kit,
    /// The checklist.
    pub checklist: TelescopeSheet,
}

impl Prepared {
    /// Returns whether every promise is kept.
    pub fn passes(&self) -> bool {
        self.checklist.verdict == Verdict::Pass
    }
}

/// The answer that there is no such telescope, for people and for machines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Impossible {
    /// Always `impossible`.
    pub verdict: &'static str,
    /// True if it is proved; false if a search found none.
    pub is_proved: bool,
    /// The reason in a sentence, with its numbers.
    pub reason: String,
    /// Remedies, each confirmed by a design.
    pub remedies: Vec<Remedy>,
    /// Changes that were tried in vain.
    pub tried: Vec<String>,
    /// The numbers of shells that were tried.
    pub rows: Vec<TradeRow>,
}

/// A change that helps, confirmed by a design with it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// The options to set.
    pub settings: Vec<Setting>,
    /// The design that it gives, in words.
    pub words: String,
}
