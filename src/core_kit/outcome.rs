//! The end of a run: a kit, or the reason why there is none.

use serde::Serialize;

use crate::base::setting::Setting;
use crate::kit::Kit;
use crate::sheet::Verdict;
use crate::sheet::core_kit::CoreSheet;

/// The end of a run.
#[derive(Debug)]
pub enum Outcome {
    /// A kit, whose checks may still have failed.
    Prepared(Box<Prepared>),
    /// There is no such object on a base as asked.
    Impossible(Box<Impossible>),
}

/// A kit in memory.
#[derive(Debug)]
pub struct Prepared {
    /// The files.
    pub kit: Kit,
    /// The checklist.
    pub checklist: CoreSheet,
}

impl Prepared {
    /// Returns whether every promise is kept.
    pub fn passes(&self) -> bool {
        self.checklist.verdict == Verdict::Pass
    }
}

/// The answer that there is no such object, for people and for machines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Impossible {
    /// Always `impossible`.
    pub verdict: &'static str,
    /// True if it is proved; false if a search or a design does not reach it.
    pub is_proved: bool,
    /// The reason in a sentence, with its numbers.
    pub reason: String,
    /// Remedies with their settings.
    pub remedies: Vec<Remedy>,
    /// Remedies that are no settings, in words.
    pub hints: Vec<String>,
}

/// A change that helps.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// The options to set.
    pub settings: Vec<Setting>,
    /// The gain, in words.
    pub words: String,
}
