//! A solid with voids in it, and the parts that some of them hold.

use crate::{
    cut::{request::PlanRequest, seat::Seat},
    mesh::{Defects, Solid, TriMesh, shells},
};

/// An outer surface and the voids inside it.
///
/// Guaranteed by the voids stage: the voids are solids (oriented outward, as bodies of air) and
/// disjoint. They lie inside `outer`, nowhere nearer to it than the wall thickness.
#[derive(Debug, Clone, PartialEq)]
pub struct Hollowed {
    /// The outside of the model.
    pub outer: Solid,
    /// The bodies of air inside it.
    pub voids: Vec<Void>,
}

/// A body of air.
#[derive(Debug, Clone, PartialEq)]
pub struct Void {
    /// Its surface.
    pub body: Solid,
    /// The seat of the part that it holds; `None` for a void that stays empty.
    pub holds: Option<Seat>,
}

impl Hollowed {
    /// Returns a solid with voids that hold nothing.
    pub fn new(outer: Solid, bodies: Vec<Solid>) -> Self {
        Self {
            outer,
            voids: bodies.into_iter().map(Void::empty).collect(),
        }
    }

    /// Splits a solid into its outside and the cavities in it, as voids that hold nothing.
    ///
    /// # Errors
    /// A part of it bounds no solid, which a solid of bodies with cavities does not have.
    pub fn of_solid(solid: &Solid) -> Result<Self, Defects> {
        let faces_inward = |shell: &TriMesh| shell.signed_volume_mm3() < 0.0;
        let (inward, outward): (Vec<_>, Vec<_>) =
            shells(solid.mesh()).into_iter().partition(faces_inward);
        if inward.is_empty() {
            return Ok(Self::new(solid.clone(), Vec::new()));
        }
        let outside = outward.iter().fold(TriMesh::default(), TriMesh::joined);
        let cavities = inward.iter().map(|shell| Solid::new(shell.reversed()));
        Ok(Self::new(
            Solid::new(outside)?,
            cavities.collect::<Result<_, _>>()?,
        ))
    }

    /// Returns one mesh that bounds the remaining material: the outer surface and every void turned
    /// inside out.
    pub fn to_mesh(&self) -> TriMesh {
        let outer = self.outer.mesh().clone();
        self.voids
            .iter()
            .fold(outer, |mesh, void| mesh.joined(&void.mesh().reversed()))
    }

    /// Returns the solid with only those voids that hold a part.
    pub(crate) fn without_empty_voids(&self) -> Self {
        let holds_part = |void: &&Void| void.holds.is_some();
        Self {
            outer: self.outer.clone(),
            voids: self.voids.iter().filter(holds_part).cloned().collect(),
        }
    }

    /// Returns the seats of the parts that voids hold, in the order of the voids.
    pub(crate) fn seats(&self) -> impl Iterator<Item = &Seat> {
        self.voids.iter().filter_map(|void| void.holds.as_ref())
    }
}

impl Void {
    /// Returns a void that holds nothing.
    pub fn empty(body: Solid) -> Self {
        Self { body, holds: None }
    }

    /// Returns its surface, facing outward as that of a body of air.
    pub fn mesh(&self) -> &TriMesh {
        self.body.mesh()
    }

    /// Returns the diameter of the disc that must pass through its opening, mm. A part that it
    /// holds must go in, so all of it lies in sight once the void is open. An empty void must be
    /// wide enough to be cleaned.
    pub fn least_opening_mm(&self, request: &PlanRequest) -> f64 {
        self.holds
            .as_ref()
            .map_or(request.min_opening_mm, |seat| seat.opening_mm)
    }
}
