//! The certificate that a polyhedron keeps its distance from a surface.

use super::obstacles::Obstacles;
use crate::geom::Plane;
use crate::mesh::TriMesh;

/// By how much rounding may make a distance less than promised, mm.
pub const ROUNDING_MM: f64 = 1e-6;

/// The proof that planes part every piece of a surface from the body below them.
///
/// A piece is parted by a plane if all its corners lie at least the distance above it. Let every
/// piece of a closed surface be parted, and one point of the body be inside. Then the body lies
/// inside and keeps the distance: a path that left it would cross a piece. Checking costs O(T).
///
/// The pieces are the triangles in their order, halved by the rule of [`Obstacles::of_mesh`].
/// A triangle without long edges is one piece.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Separation {
    /// The distance that is kept, mm.
    pub distance_mm: f64,
    /// The longest edge of a piece, mm.
    pub longest_edge_mm: f64,
    /// For each piece, the index of a plane that parts it.
    pub faces: Vec<u32>,
}

/// The reason that a certificate does not hold.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeparationError {
    /// No plane, or not the named one, parts a piece.
    #[error("piece {piece} is parted by {parted_mm:.3} mm, less than {distance_mm} mm")]
    NotParted {
        /// The index of the piece.
        piece: usize,
        /// By how much it is parted, mm; negative if the plane cuts it.
        parted_mm: f64,
        /// The distance asked for, mm.
        distance_mm: f64,
    },
    /// A certificate of another surface.
    #[error("the certificate has {found} pieces, but the surface has {expected}")]
    Count {
        /// The pieces of the certificate.
        found: usize,
        /// The pieces of the surface.
        expected: usize,
    },
    /// A plane that does not exist.
    #[error("piece {piece} names face {face}, but there is no such face")]
    NoFace {
        /// The index of the piece.
        piece: usize,
        /// The index of the face.
        face: u32,
    },
}

impl Separation {
    /// Names, for every piece of the obstacles' surface, the plane that parts it best; fails with
    /// the first piece that none parts by the distance.
    pub fn find(
        planes: &[Plane],
        obstacles: &Obstacles,
        distance_mm: f64,
    ) -> Result<Self, SeparationError> {
        let mut best = vec![(f64::NEG_INFINITY, 0); obstacles.piece_count()];
        for (face, plane) in planes.iter().enumerate() {
            for (best, parted) in best.iter_mut().zip(obstacles.all_parted_mm(plane)) {
                if parted > best.0 {
                    *best = (parted, face as u32);
                }
            }
        }
        let least_mm = distance_mm - ROUNDING_MM;
        if let Some(piece) = best.iter().position(|&(parted, _)| parted < least_mm) {
            let parted_mm = best[piece].0;
            return Err(SeparationError::NotParted {
                piece,
                parted_mm,
                distance_mm,
            });
        }
        Ok(Self {
            distance_mm,
            longest_edge_mm: obstacles.longest_edge_mm(),
            faces: best.into_iter().map(|(_, face)| face).collect(),
        })
    }

    /// Checks the certificate for a surface and planes, with nothing of how it was found. Returns
    /// the least distance by which a piece is parted, mm.
    pub fn check(&self, surface: &TriMesh, planes: &[Plane]) -> Result<f64, SeparationError> {
        let obstacles = Obstacles::of_mesh(surface, self.longest_edge_mm);
        let (found, expected) = (self.faces.len(), obstacles.piece_count());
        if found != expected {
            return Err(SeparationError::Count { found, expected });
        }
        let mut least_mm = f64::INFINITY;
        for (piece, &face) in self.faces.iter().enumerate() {
            let no_face = SeparationError::NoFace { piece, face };
            let plane = planes.get(face as usize).ok_or(no_face)?;
            let parted_mm = obstacles.parted_mm(piece, plane);
            if parted_mm.is_nan() || parted_mm < self.distance_mm - ROUNDING_MM {
                return Err(SeparationError::NotParted {
                    piece,
                    parted_mm,
                    distance_mm: self.distance_mm,
                });
            }
            least_mm = least_mm.min(parted_mm);
        }
        Ok(least_mm)
    }
}
