//! A solid with voids in it.

use super::{Solid, TriMesh};

/// An outer surface and the voids inside it.
///
/// Holds (the voids stage's promise): the voids are solids (oriented outward, as bodies of air),
/// disjoint, and lie inside `outer`, nowhere nearer to it than the wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Hollowed {
    /// The outside of the model.
    pub outer: Solid,
    /// The bodies of air inside it.
    pub voids: Vec<Solid>,
}

impl Hollowed {
    /// One mesh that bounds the remaining material: the outer surface and every void turned inside
    /// out.
    pub fn to_mesh(&self) -> TriMesh {
        let outer = self.outer.mesh().clone();
        self.voids
            .iter()
            .fold(outer, |mesh, void| mesh.joined(&void.mesh().reversed()))
    }
}
