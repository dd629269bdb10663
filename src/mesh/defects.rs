//! What keeps a mesh from bounding a solid.

/// Everything found wrong with a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "the mesh does not bound a solid: {unpaired_edges} edges are not shared by exactly two opposed triangles"
)]
pub struct Defects {
    /// Directed edges without exactly one opposite.
    pub unpaired_edges: usize,
}
