//! Cells as closed bodies with flat faces, for files and pictures.

use std::collections::BTreeSet;

use super::polytope::Polytope;
use crate::geom::Point;
use crate::mesh::TriMesh;

/// Distance within which two corners of a cell are one, as a part of its size.
const WELD_RATIO: f64 = 1e-9;

/// A closed body with flat faces of three corners or more.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Body {
    /// The corners.
    pub corners: Vec<Point>,
    /// The corners of each face, counter-clockwise as seen from outside.
    pub faces: Vec<Vec<u32>>,
}

/// The faces of a polytope with the corners that they share.
pub(super) struct Welded {
    /// The corners.
    pub corners: Vec<Point>,
    /// The number of each face in the polytope, and its corners. Those without area are left out.
    pub faces: Vec<(usize, Vec<u32>)>,
}

impl Welded {
    /// Welds the faces of a polytope; `None` unless they close.
    pub fn of(polytope: &Polytope) -> Option<Self> {
        let near_mm = WELD_RATIO * polytope.bounds().size().max();
        let mut corners: Vec<Point> = Vec::new();
        let mut faces = Vec::new();
        for (index, face) in polytope.faces().iter().enumerate() {
            let mut ring: Vec<u32> = Vec::with_capacity(face.ring.len());
            for at in &face.ring {
                let mut known = corners.iter();
                let known = known.position(|corner| (corner - at).norm() <= near_mm);
                let number = known.unwrap_or_else(|| {
                    corners.push(*at);
                    corners.len() - 1
                }) as u32;
                if !ring.contains(&number) {
                    ring.push(number);
                }
            }
            if ring.len() >= 3 {
                faces.push((index, ring));
            }
        }
        let is_closed = are_closed(faces.iter().map(|(_, ring)| ring.as_slice()));
        is_closed.then_some(Self { corners, faces })
    }
}

/// Returns true if every edge of a face is one of another face, the other way round.
fn are_closed<'a>(faces: impl Iterator<Item = &'a [u32]>) -> bool {
    let mut known = BTreeSet::new();
    let mut count = 0;
    for face in faces {
        let next = face.iter().cycle().skip(1);
        for (&a, &b) in face.iter().zip(next) {
            known.insert([a, b]);
            count += 1;
        }
    }
    known.len() == count && known.iter().all(|&[a, b]| known.contains(&[b, a]))
}

impl Body {
    /// Takes the faces of a polytope; `None` unless they close.
    pub fn of_polytope(polytope: &Polytope) -> Option<Self> {
        let welded = Welded::of(polytope)?;
        Some(Self {
            corners: welded.corners,
            faces: welded.faces.into_iter().map(|(_, ring)| ring).collect(),
        })
    }

    /// Takes the triangles of a mesh.
    pub(super) fn of_mesh(mesh: &TriMesh) -> Self {
        Self {
            corners: mesh.vertices().to_vec(),
            faces: mesh.triangles().iter().map(|face| face.to_vec()).collect(),
        }
    }

    /// Returns true if every edge of a face is one of another face, the other way round.
    pub fn is_closed(&self) -> bool {
        are_closed(self.faces.iter().map(Vec::as_slice))
    }

    /// Returns its triangles: fans of the faces, which are convex.
    pub fn mesh(&self) -> TriMesh {
        let fans = self.faces.iter().flat_map(|face| {
            let pairs = face[1..].windows(2);
            pairs.map(|pair| [face[0], pair[0], pair[1]])
        });
        TriMesh::from_parts(self.corners.clone(), fans.collect())
    }

    /// Returns its volume, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.mesh().signed_volume_mm3()
    }

    /// Moves every corner by a map that keeps planes flat and turns nothing inside out.
    #[must_use]
    pub fn mapped(self, map: impl Fn(&Point) -> Point) -> Self {
        Self {
            corners: self.corners.iter().map(map).collect(),
            faces: self.faces,
        }
    }
}
