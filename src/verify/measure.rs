//! What one written file holds: its shape, how it lies, and its exact moments.

use super::{Pose, Shells};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Crossings, Solid, TriMesh};
use crate::repair::weld;

/// One part as it was read back.
#[derive(Debug, Clone, PartialEq)]
pub struct PartEvidence {
    /// The name on the sheet, such as `P01`.
    pub id: String,
    /// The triangles of its file, print frame, mm.
    pub mesh: TriMesh,
    /// Model coordinates to print coordinates.
    pub pose: Pose,
}

/// What is true of a surface as written.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceFacts {
    /// How many triangles it has.
    pub triangles: usize,
    /// Why it does not bound a solid; none if it does.
    pub defect: Option<String>,
    /// Pairs of triangles that pierce each other.
    pub crossings: usize,
    /// mm³.
    pub volume_mm3: f64,
}

/// What is true of a part as written.
#[derive(Debug, Clone, PartialEq)]
pub struct PartFacts {
    /// The name on the sheet.
    pub id: String,
    /// Its surface.
    pub surface: SurfaceFacts,
    /// Closed cavities: shells that are turned inward.
    pub cavities: usize,
    /// The height of its lowest vertex over the plate, mm.
    pub lowest_mm: f64,
    /// Its extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// How far its pose is from a rigid motion.
    pub pose_error: f64,
    /// Its moments in the model frame.
    pub moments: Moments,
}

impl SurfaceFacts {
    /// Measures a welded surface.
    pub fn of_mesh(welded: &TriMesh) -> Self {
        Self {
            triangles: welded.triangles().len(),
            defect: Solid::new(welded.clone())
                .err()
                .map(|defects| defects.to_string()),
            crossings: Crossings::of(welded).pairs,
            volume_mm3: moments_of_mesh(welded).volume(),
        }
    }
}

impl PartFacts {
    /// Measures a part: corners at one place are welded, nothing else is touched.
    pub fn of_part(part: &PartEvidence) -> Self {
        let welded = weld(&part.mesh);
        let aabb = welded.aabb();
        Self {
            id: part.id.clone(),
            cavities: Shells::of_mesh(&welded).inward.len(),
            lowest_mm: aabb.min.z,
            size_mm: aabb.size().into(),
            pose_error: part.pose.rigidity_error(),
            moments: part.moments(),
            surface: SurfaceFacts::of_mesh(&welded),
        }
    }
}

impl PartEvidence {
    /// The moments of the part where it belongs in the model.
    pub fn moments(&self) -> Moments {
        self.pose.moments_to_model(&moments_of_mesh(&self.mesh))
    }
}

/// The moments of the parts put together in the model frame, exact for what was written.
pub fn assembly_moments<'a>(parts: impl IntoIterator<Item = &'a PartEvidence>) -> Moments {
    parts
        .into_iter()
        .fold(Moments::default(), |sum, part| sum + part.moments())
}
