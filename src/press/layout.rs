//! The subject of a kit's drawings: its files as read back, and the cuts between its parts.

use crate::cut::{Cut, UncutFace};
use crate::geom::Parting;
use crate::page::Subject;
use crate::verify::{Body, Evidence};

/// The subject of a kit's drawings.
#[derive(Debug, Clone, Copy)]
pub struct Layout<'a> {
    /// The files as they were read back, and their promise.
    pub evidence: &'a Evidence,
    /// The uncut result, taken apart.
    pub body: &'a Body,
    /// The cuts.
    pub cuts: &'a [Cut],
    /// The planes of the cuts, and where they are made.
    pub partings: &'a [Parting],
    /// The faces at which a cut leaves the body whole.
    pub uncut: &'a [UncutFace],
}

impl<'a> Layout<'a> {
    /// Returns what pictures are taken of.
    pub(super) fn subject(&self) -> Subject<'a> {
        let promise = &self.evidence.promise;
        Subject {
            shells: &self.body.shells,
            parts: &self.evidence.parts,
            promised: &promise.parts,
            jigs: &self.evidence.jigs,
            promised_jigs: &promise.jigs,
            cuts: self.partings,
            aim: promise.goal,
            hardware: &promise.hardware,
            ballast: &promise.ballast,
            infill: promise.infill.as_ref(),
        }
    }
}
