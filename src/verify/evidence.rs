//! The evidence before the judge: the promises of a kit, and the meshes read back from its files.

use rayon::prelude::*;

use super::{Fingerprint, Pose, Promise};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::TriMesh;

/// The evidence before the judge: the promises, and the meshes as they were read back.
#[derive(Debug, Clone, PartialEq)]
pub struct Evidence {
    /// The promises.
    pub promise: Promise,
    /// The uncut result, model frame, mm.
    pub hollowed: TriMesh,
    /// The parts, in the order of the checklist.
    pub parts: Vec<PartEvidence>,
    /// The jigs, in the order of the checklist.
    pub jigs: Vec<PartEvidence>,
}

/// One part as it was read back.
#[derive(Debug, Clone, PartialEq)]
pub struct PartEvidence {
    /// The name on the sheet, such as `P01`.
    pub id: String,
    /// The triangles of its file, print frame, mm. The outermost region of infill is a cavity.
    pub mesh: TriMesh,
    /// The regions of infill inside of that one, each in the one before; outward. Most parts have
    /// none.
    pub inner: Vec<TriMesh>,
    /// Model coordinates to print coordinates.
    pub pose: Pose,
}

impl Evidence {
    /// Returns the fingerprints of the parts as they were read back.
    pub(super) fn fingerprints(&self) -> Vec<Fingerprint> {
        let parts = self.parts.par_iter();
        parts.map(|part| Fingerprint::of(&part.mesh)).collect()
    }

    /// Returns the regions of infill inside of the outermost one, model frame.
    pub(super) fn inner_in_model(&self) -> Vec<TriMesh> {
        let of_part = |part: &PartEvidence| {
            let place = |region: &TriMesh| region.map_vertices(|p| part.pose.to_model(p));
            part.inner.iter().map(place).collect::<Vec<_>>()
        };
        self.parts.iter().flat_map(of_part).collect()
    }

    /// Returns true if a part with the fingerprint `found` has the triangles of its promised one.
    /// Parts of kits without fingerprints are taken as they are.
    pub(super) fn is_part_as_made(&self, part: usize, found: &Fingerprint) -> bool {
        let promised = self.promise.parts[part].fingerprint.as_ref();
        promised.is_none_or(|promised| promised.triangles_sha256 == found.triangles_sha256)
    }
}

impl PartEvidence {
    /// Returns the triangles of its file and those of all regions in it, turned inward.
    pub(super) fn whole(&self) -> TriMesh {
        let join = |all: TriMesh, region: &TriMesh| all.joined(&region.reversed());
        self.inner.iter().fold(self.mesh.clone(), join)
    }

    /// Returns the moments of the part in its place in the model, with its regions empty.
    pub fn moments(&self) -> Moments {
        self.pose.moments_to_model(&moments_of_mesh(&self.mesh))
    }
}

/// Returns the moments of the parts put together in the model frame, exact for the triangles as
/// written.
pub fn assembly_moments<'a>(parts: impl IntoIterator<Item = &'a PartEvidence>) -> Moments {
    let parts: Vec<&PartEvidence> = parts.into_iter().collect();
    let moments: Vec<Moments> = parts.par_iter().map(|part| part.moments()).collect();
    let sum = |sum, part| sum + part;
    moments.into_iter().fold(Moments::default(), sum)
}
