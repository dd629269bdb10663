//! What the pictures of a kit are taken of.

use crate::geom::{Parting, Plane};
use crate::mesh::TriMesh;
use crate::verify::{Aim, BallastOrder, Hardware, PartEvidence, Peg, PromisedPart, Shells};

/// What the pictures are taken of.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The shells of the uncut result, model frame.
    pub shells: &'a Shells,
    /// The parts, print frame.
    pub parts: &'a [PartEvidence],
    /// What was promised of them, in the same order.
    pub promised: &'a [PromisedPart],
    /// The cuts between them, model frame.
    pub cuts: &'a [Parting],
    /// The goal: its axis points up in the pictures.
    pub aim: Aim,
    /// What is put in that is not printed, model frame.
    pub hardware: &'a [Hardware],
    /// The stock parts in their pockets, model frame.
    pub ballast: &'a [BallastOrder],
}

impl Subject<'_> {
    /// The cuts along which the parts are drawn apart, and the plane between the halves of a yo-yo.
    pub(super) fn partings(&self) -> Vec<Parting> {
        let frame = self.aim.frame();
        let has_halves = self.hardware.iter().any(|piece| piece.what == "axle");
        let between = has_halves.then(|| Plane::through(&frame.origin, &frame.axis()));
        self.cuts
            .iter()
            .cloned()
            .chain(between.map(Parting::everywhere))
            .collect()
    }
}

/// The parts' meshes in the model frame.
pub(super) fn parts_in_model(parts: &[PartEvidence]) -> Vec<TriMesh> {
    parts
        .iter()
        .map(|part| part.mesh.map_vertices(|p| part.pose.to_model(p)))
        .collect()
}

/// The pins that stand out of a part, by the parts in the order of the sheet.
pub(super) fn pins(promised: &[PromisedPart]) -> impl Iterator<Item = (usize, &Peg)> {
    promised
        .iter()
        .enumerate()
        .flat_map(|(part, row)| row.pins.iter().map(move |pin| (part, pin)))
}
