//! What a run ends with: a kit, or the proof that none can exist.

use serde::Serialize;

use crate::advice::Remedy;
use crate::kit::Kit;
use crate::sheet::{Checklist, Verdict};

/// How a run ended.
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
    /// Why it fails, and what helps; none where every promise is kept.
    pub failure: Option<Failure>,
}

/// Why a kit fails though a hollowing that meets its goal exists, or another promise is broken.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Failure {
    /// The reason in a sentence, with its numbers.
    pub reason: String,
    /// What helps, each confirmed by a solve.
    pub remedies: Vec<Remedy>,
    /// What might help besides.
    pub hints: Vec<String>,
}

impl Prepared {
    /// Whether every promise is kept.
    pub fn passes(&self) -> bool {
        self.checklist.verdict == Verdict::Pass
    }
}

/// Why the goal cannot be met, for people and for machines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Impossible {
    /// Always `impossible`.
    pub verdict: &'static str,
    /// The reason in a sentence, with its number.
    pub reason: String,
    /// What was tried to make it possible, and what of it helps, each confirmed by a solve.
    pub remedies: Vec<Remedy>,
    /// What might help besides, where none of them does.
    pub hints: Vec<String>,
    /// How the axis was chosen, where it was left open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
    /// The quadric of the proof: ten coefficients over (1, x, y, z, xy, yz, xz, x², y², z²) in the
    /// goal frame, mm.
    pub proof_quadric: [f64; 10],
    /// The origin of the goal frame in the model frame, mm.
    pub origin_mm: [f64; 3],
    /// The unit axis in the model frame.
    pub axis: [f64; 3],
    /// What the goal's placement warned of.
    pub warnings: Vec<String>,
}
