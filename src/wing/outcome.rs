//! The end of a line: a kit, or the reason why there is none.

use serde::Serialize;

use crate::base::setting::Setting;
use crate::kit::Kit;
use crate::sheet::{KindSheet, Verdict};

/// The end of a line. `S` is the checklist of the kind, `M` what else its answer tells.
#[derive(Debug)]
pub enum Outcome<S, M = NoMore> {
    /// A kit, whose checks may still have failed.
    Prepared(Box<Prepared<S>>),
    /// There is no such kit as asked.
    Impossible(Box<Impossible<M>>),
}

impl<S, M> Outcome<S, M> {
    /// Applies a function to the checklist of a kit.
    pub fn map<T>(self, map: impl FnOnce(S) -> T) -> Outcome<T, M> {
        match self {
            Self::Prepared(prepared) => Outcome::Prepared(Box::new(Prepared {
                kit: prepared.kit,
                checklist: map(prepared.checklist),
            })),
            Self::Impossible(why) => Outcome::Impossible(why),
        }
    }
}

/// A kit in memory.
#[derive(Debug)]
pub struct Prepared<S> {
    /// The files.
    pub kit: Kit,
    /// The checklist.
    pub checklist: S,
}

impl<S: KindSheet> Prepared<S> {
    /// Returns whether every promise is kept.
    pub fn passes(&self) -> bool {
        self.checklist.verdict() == Verdict::Pass
    }
}

/// The answer that there is no such kit, for people and for machines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Impossible<M = NoMore> {
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
    /// Changes that were tried in vain.
    pub tried: Vec<String>,
    /// More that this kind of kit tells.
    #[serde(flatten)]
    pub more: M,
}

impl<M: Default> Impossible<M> {
    /// Returns the answer with a reason, without proof and remedies.
    pub fn new(reason: String) -> Self {
        Self {
            verdict: "impossible",
            is_proved: false,
            reason,
            remedies: Vec::new(),
            hints: Vec::new(),
            tried: Vec::new(),
            more: M::default(),
        }
    }
}

/// Nothing more to tell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct NoMore {}

/// A change that helps.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// The options to set.
    pub settings: Vec<Setting>,
    /// The gain, in words.
    pub words: String,
}
