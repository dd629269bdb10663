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
    /// The parts in the order of the promises, each in print pose and its own size.
    pub printed: Vec<TriMesh>,
    /// The same, each in its shell's frame.
    pub parts: Vec<TriMesh>,
    /// The points of the curve that was asked for, mm.
    pub asked: Vec<Point>,
    /// The texts of the pose files, in the order of the promises.
    pub pose_files: Vec<String>,
}

impl TelescopeEvidence {
    /// Returns printed parts, each in its shell's frame.
    pub fn in_shells(promise: &TelescopePromise, printed: &[TriMesh]) -> Vec<TriMesh> {
        let parts = promise.parts.iter().zip(printed);
        let parts =
            parts.map(|(part, mesh)| mesh.map_vertices(|p| part.print_from_shell.to_model(p)));
        parts.collect()
    }

    /// Returns the meshes of the tubes, in the order of the promises.
    pub(super) fn tubes(&self) -> impl Iterator<Item = &TriMesh> {
        let parts = self.promise.parts.iter().zip(&self.parts);
        parts.filter(|(part, _)| part.is_tube).map(|(_, mesh)| mesh)
    }
}
