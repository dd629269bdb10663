//! The subject of the pictures of a kit: the uncut result, its parts and all that is put in.

use crate::geom::{Parting, Plane};
use crate::mesh::TriMesh;
use crate::verify::{
    Aim, BallastOrder, Hardware, HardwareKind, InfillOrder, PartEvidence, Peg, PromisedJig,
    PromisedPart, Shells,
};

/// The subject of the pictures.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// Shells of the uncut result, model frame.
    pub shells: &'a Shells,
    /// Parts, print frame.
    pub parts: &'a [PartEvidence],
    /// Promises of these parts, in the same order.
    pub promised: &'a [PromisedPart],
    /// Cuts between them, model frame.
    pub cuts: &'a [Parting],
    /// Jigs, print frame.
    pub jigs: &'a [PartEvidence],
    /// Promises of these jigs, in the same order.
    pub promised_jigs: &'a [PromisedJig],
    /// Goal; its axis points up in the pictures.
    pub aim: Aim,
    /// Hardware, model frame.
    pub hardware: &'a [Hardware],
    /// Stock parts in their pockets, model frame.
    pub ballast: &'a [BallastOrder],
    /// Sparse infill in the cavities; `None` if they are voids.
    pub infill: Option<&'a InfillOrder>,
}

impl Subject<'_> {
    /// Returns whether two halves sit on an axle.
    pub(super) fn has_halves(&self) -> bool {
        self.hardware
            .iter()
            .any(|piece| piece.kind == HardwareKind::Axle)
    }

    /// Returns the cuts along which the parts are drawn apart, and the plane between the halves of
    /// a yo-yo.
    pub(super) fn partings(&self) -> Vec<Parting> {
        let frame = self.aim.frame();
        let between = self
            .has_halves()
            .then(|| Plane::through(&frame.origin, &frame.axis()));
        self.cuts
            .iter()
            .cloned()
            .chain(between.map(Parting::everywhere))
            .collect()
    }
}

/// Returns the meshes of the parts in the model frame.
pub(super) fn parts_in_model(parts: &[PartEvidence]) -> Vec<TriMesh> {
    parts
        .iter()
        .map(|part| part.mesh.map_vertices(|p| part.pose.to_model(p)))
        .collect()
}

/// Returns the pins, each with the index of the part that bears it.
pub(super) fn pins_by_part(promised: &[PromisedPart]) -> impl Iterator<Item = (usize, &Peg)> {
    promised
        .iter()
        .enumerate()
        .flat_map(|(part, row)| row.pins.iter().map(move |pin| (part, pin)))
}
