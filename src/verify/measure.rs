//! Facts about one written file: its surface, its place on the plate, and its exact moments.

use super::{PartEvidence, Shells};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Bvh;
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Crossings, Solid, TriMesh};
use crate::repair::weld;

/// Facts about a surface as written.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceFacts {
    /// Number of triangles.
    pub triangles: usize,
    /// The reason why it does not bound a solid; `None` if it does.
    pub defect: Option<String>,
    /// Number of pairs of triangles that pierce each other.
    pub crossings: usize,
    /// The volume it encloses, mm³.
    pub volume_mm3: f64,
}

/// Facts about a part as written.
#[derive(Debug, Clone, PartialEq)]
pub struct PartFacts {
    /// The name on the sheet.
    pub id: String,
    /// Its surface.
    pub surface: SurfaceFacts,
    /// Number of bodies: shells that are turned outward.
    pub bodies: usize,
    /// Number of closed cavities: shells that are turned inward.
    pub cavities: usize,
    /// The height of its lowest vertex over the plate, mm.
    pub lowest_mm: f64,
    /// Its extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// Deviation of its pose from a rigid motion.
    pub pose_error: f64,
    /// Its moments in the model frame.
    pub moments: Moments,
}

impl SurfaceFacts {
    /// Measures a welded surface, with a tree over its triangles.
    pub fn of_mesh(welded: &TriMesh, tree: &Bvh, watch: &Watch) -> Result<Self, Cancelled> {
        watch.check()?;
        let defect = Solid::new(welded.clone()).err();
        Ok(Self {
            triangles: welded.triangles().len(),
            defect: defect.map(|defects| defects.to_string()),
            crossings: Crossings::in_tree(welded, tree, watch)?.pairs,
            volume_mm3: moments_of_mesh(welded).volume(),
        })
    }
}

impl PartFacts {
    /// Measures a part, with a tree over its triangles. Corners at one place are welded; nothing
    /// else is changed.
    pub fn of_part(part: &PartEvidence, tree: &Bvh, watch: &Watch) -> Result<Self, Cancelled> {
        watch.check()?;
        let welded = weld(&part.mesh);
        let aabb = welded.aabb();
        let shells = Shells::of_mesh(&welded);
        Ok(Self {
            id: part.id.clone(),
            bodies: shells.outward.len(),
            cavities: shells.inward.len(),
            lowest_mm: aabb.min.z,
            size_mm: aabb.size().into(),
            pose_error: part.pose.rigidity_error(),
            moments: part.moments(),
            surface: SurfaceFacts::of_mesh(&welded, tree, watch)?,
        })
    }
}
