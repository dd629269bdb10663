//! The parts of a kit as they are written and read back.

use super::{BossRound, CleaningRound, DrawnCells, HeightProof, Level, Remark};
use crate::ballast::Load;
use crate::cut::{CutPlan, Hollowed, Jig, JointId, Part};
use crate::field::Clamped;
use crate::hollow::{Proof, Solution, TopCourse};
use crate::mass::Moments;
use crate::mesh::TriMesh;
use crate::verify::{PartEvidence, Pose, assembly_moments};

/// The parts of a kit, corrected until the written parts meet the goal.
#[derive(Debug, Clone)]
pub struct Made {
    /// The solution that the parts were made from.
    pub solution: Solution,
    /// The ballast that is laid in.
    pub load: Load,
    /// The proof for other heights of a top's centre.
    pub height_proof: Option<HeightProof>,
    /// The proof that no void within the wall is better, before anything was kept solid for
    /// cleaning.
    pub proof: Option<Proof>,
    /// The course of the first answer.
    pub course: TopCourse,
    /// The uncut body.
    pub hollowed: Hollowed,
    /// The density without steps that does what its regions do, goal frame; `None` unless they
    /// are near a wished infill.
    pub smooth: Option<Clamped>,
    /// The regions of infill inside of its voids, as [`Voids::inner`](super::Voids::inner).
    pub inner: Vec<TriMesh>,
    /// The cells that its voids are made of, as [`Voids::cells`](super::Voids::cells).
    pub cells: DrawnCells,
    /// Volume of voids that stay solid for cleaning or for pins, mm³.
    pub refused_mm3: f64,
    /// The cuts and pins.
    pub plan: CutPlan,
    /// Notes for the job sheet beside those of the plan.
    pub remarks: Vec<Remark>,
    /// The parts.
    pub parts: Vec<WrittenPart>,
    /// The jigs for joints that nothing else aligns: tools, no part of the object.
    pub jigs: Vec<WrittenJig>,
    /// Number of times that it was solved again.
    pub rounds: usize,
    /// Figure of the certificate before anything was kept solid.
    pub value_before_cleaning: f64,
    /// Rounds in which something was kept solid so that voids can be cleaned or joints have pins.
    pub cleaning: Vec<CleaningRound>,
    /// Rounds in which bosses were kept solid around pins.
    pub bosses: Vec<BossRound>,
}

impl Made {
    /// Returns the moments of the written parts put together, model frame: without hardware,
    /// ballast and glue.
    pub fn written_moments(&self) -> Moments {
        assembly_moments(&self.evidence())
    }

    /// Returns the jig of the joint with this index; `None` if it needs or has none.
    pub fn jig_of(&self, joint: usize) -> Option<&WrittenJig> {
        self.jigs.iter().find(|jig| jig.jig.joint == joint)
    }

    /// Returns the parts as the judge reads them.
    pub fn evidence(&self) -> Vec<PartEvidence> {
        self.parts.iter().map(WrittenPart::evidence).collect()
    }
}

/// A jig as it is written.
#[derive(Debug, Clone)]
pub struct WrittenJig {
    /// The jig.
    pub jig: Jig,
    /// Its file, relative to the kit.
    pub file: String,
    /// The bytes of its file.
    pub bytes: Vec<u8>,
    /// The triangles read back from those bytes, print pose, in the jig's own size.
    pub read_back: TriMesh,
}

impl WrittenJig {
    /// Returns its name: that of its joint after `jig-`.
    pub fn id(&self) -> String {
        format!("jig-{}", JointId::of(self.jig.joint))
    }

    /// Returns the jig as the judge reads it.
    pub fn evidence(&self) -> PartEvidence {
        PartEvidence {
            id: self.id(),
            mesh: self.read_back.clone(),
            inner: Vec::new(),
            pose: Pose {
                rows: self.jig.print_from_model,
            },
        }
    }
}

/// A part as it is written.
#[derive(Debug, Clone)]
pub struct WrittenPart {
    /// The part.
    pub part: Part,
    /// Its file, relative to the kit.
    pub file: String,
    /// The bytes of its file.
    pub bytes: Vec<u8>,
    /// The triangles read back from its files, print pose, in the part's own size. The outermost
    /// region of sparse infill is a cavity of them.
    pub read_back: TriMesh,
    /// The regions of sparse infill in it; `None` if it has none.
    pub sparse: Option<WrittenSparse>,
}

/// The sparse infill of a part as it is written.
#[derive(Debug, Clone)]
pub struct WrittenSparse {
    /// The outside of the part, print pose, in the part's own size.
    pub outside: TriMesh,
    /// The regions, the outermost first; at least one.
    pub regions: Vec<WrittenRegion>,
}

/// A region of sparse infill as it is written.
#[derive(Debug, Clone)]
pub struct WrittenRegion {
    /// Its density.
    pub level: Level,
    /// Its own file, relative to the kit, and the bytes of it; `None` if it is in the part's file.
    pub file: Option<(String, Vec<u8>)>,
    /// Its surface, print pose, in the part's own size; outward.
    pub mesh: TriMesh,
}

impl WrittenPart {
    /// Returns the surface that is printed, print pose, in the part's own size.
    pub fn surface(&self) -> &TriMesh {
        let sparse = self.sparse.as_ref();
        sparse.map_or(&self.read_back, |sparse| &sparse.outside)
    }

    /// Returns the regions of sparse infill inside of the outermost one, print pose.
    pub fn inner_regions(&self) -> impl Iterator<Item = &TriMesh> {
        let sparse = self.sparse.iter();
        let inner = sparse.flat_map(|sparse| sparse.regions.iter().skip(1));
        inner.map(|region| &region.mesh)
    }

    /// Returns the part as the judge reads it.
    pub fn evidence(&self) -> PartEvidence {
        let pose = Pose {
            rows: self.part.pose.print_from_model,
        };
        PartEvidence {
            id: self.part.id.to_string(),
            mesh: self.read_back.clone(),
            inner: self.inner_regions().cloned().collect(),
            pose,
        }
    }
}
