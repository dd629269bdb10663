//! What the judge of a telescope sees.

use super::motion::TelescopeMotion;
use super::promise::TelescopePromise;
use crate::geom::Point;
use crate::mesh::TriMesh;

/// Everything that the judge sees.
#[derive(Debug, Clone, PartialEq)]
pub struct TelescopeEvidence {
    /// The promises.
    pub promise: TelescopePromise,
    /// The motion.
    pub motion: TelescopeMotion,
    /// The parts in the order of the promises, each in its shell's frame and its own size.
    pub parts: Vec<TriMesh>,
    /// The points of the curve that was asked for, mm.
    pub asked: Vec<Point>,
    /// The texts of the pose files, in the order of the promises.
    pub pose_files: Vec<String>,
}

impl TelescopeEvidence {
    /// Returns the meshes of the tubes, in the order of the promises.
    pub(super) fn tubes(&self) -> impl Iterator<Item = &TriMesh> {
        let parts = self.promise.parts.iter().zip(&self.parts);
        parts.filter(|(part, _)| part.is_tube).map(|(_, mesh)| mesh)
    }
}
