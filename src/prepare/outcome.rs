//! The end of a run: a kit, or the proof that none can exist.

use serde::Serialize;

use crate::advice::Remedy;
use crate::kit::Kit;
use crate::sheet::{Checklist, Verdict};

/// The end of a run.
#[derive(Debug)]
pub enum Outcome {
    /// A kit, whose checks may still have failed.
    Prepared(Box<Prepared>),
    /// The goal cannot be met by hollowing.
    Impossible(Box<Impossible>),
}

/// A kit in memory.
#[derive(Debug)]
pub struct Prepared {
    /// The files.
    pub kit: Kit,
    /// The job sheet, with timings.
    pub checklist: Checklist,
    /// The reason why it fails, and what helps; `None` if every promise is kept.
    pub failure: Option<Failure>,
}

/// A kit that breaks a promise: the reason, and what helps.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Failure {
    /// The reason in a sentence, with its numbers.
    pub reason: String,
    /// Remedies, each confirmed by a solve.
    pub remedies: Vec<Remedy>,
    /// Hints: what else may help.
    pub hints: Vec<String>,
}

impl Prepared {
    /// Returns whether every promise is kept.
    pub fn passes(&self) -> bool {
        self.checklist.verdict == Verdict::Pass
    }
}

/// The proof that a goal cannot be met, for people and for machines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Impossible {
    /// Always `impossible`.
    pub verdict: &'static str,
    /// The reason in a sentence, with its number.
    pub reason: String,
    /// Remedies that were tried, those that help confirmed by a solve.
    pub remedies: Vec<Remedy>,
    /// Hints, if no remedy helps.
    pub hints: Vec<String>,
    /// The choice of the axis, if the job left it open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
    /// The quadric of the proof: ten coefficients over (1, x, y, z, xy, yz, xz, x², y², z²) in the
    /// goal frame, mm.
    pub proof_quadric: [f64; 10],
    /// The origin of the goal frame in the model frame, mm.
    pub origin_mm: [f64; 3],
    /// The unit axis in the model frame.
    pub axis: [f64; 3],
    /// Warnings of the goal's placement.
    pub warnings: Vec<String>,
}
