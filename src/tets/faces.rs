//! The faces of tetrahedra, each with the cells on it.

use super::error::TetsError;
use crate::geom::{Point, Vector};

/// The faces of a tetrahedron of positive volume, counterclockwise as seen from outside. The face
/// `i` lies opposite corner `i`.
pub(super) const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// One side of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct FaceSide {
    /// The corners in ascending order.
    sorted: [u32; 3],
    /// 4 · cell + the corner opposite.
    id: u32,
    /// True if the corners turn as the sorted ones do.
    is_even: bool,
}

/// A face with a cell on one side only.
#[derive(Debug, Clone, Copy)]
pub(super) struct OuterFace {
    /// The corners, counterclockwise as seen from outside.
    pub corners: [u32; 3],
    /// The tetrahedron inside.
    pub cell: u32,
}

/// The faces of a mesh.
#[derive(Debug, Default)]
pub(super) struct Faces {
    /// The faces on the outside, in the order of the cells.
    pub outer: Vec<OuterFace>,
    /// The pairs of cells that share a face.
    pub inner: Vec<[u32; 2]>,
}

impl Faces {
    /// Pairs the faces of cells of positive volume. Their corners are numbers of places.
    ///
    /// # Errors
    /// A face with more than two cells, or with both on the same side.
    pub fn of(cells: &[[u32; 4]], places: &[Point]) -> Result<Self, TetsError> {
        let mut sides: Vec<FaceSide> = (0..)
            .zip(cells)
            .flat_map(|(cell, corners)| {
                (0..4).map(move |face| FaceSide::new(4 * cell + face as u32, corners))
            })
            .collect();
        sides.sort_unstable();
        let mut faces = Self::default();
        for on_face in sides.chunk_by(|a, b| a.sorted == b.sorted) {
            let cell = |side: &FaceSide| (side.id / 4) as usize;
            let at = || middle(on_face[0].sorted.map(|corner| places[corner as usize]));
            match on_face {
                [one] => faces.outer.push(one.outer(&cells[cell(one)])),
                [one, other] if one.is_even != other.is_even => {
                    faces.inner.push([one.id / 4, other.id / 4]);
                }
                [one, other, ..] => {
                    let pair = [cell(one), cell(other)];
                    let sets = pair.map(|cell| sorted(cells[cell]));
                    return Err(match on_face.len() {
                        _ if sets[0] == sets[1] => TetsError::Twice {
                            cells: pair,
                            at: at(),
                        },
                        2 => TetsError::SameSide {
                            cells: pair,
                            at: at(),
                        },
                        count => TetsError::CrowdedFace {
                            cell: pair[0],
                            count,
                            at: at(),
                        },
                    });
                }
                [] => {}
            }
        }
        faces.outer.sort_unstable_by_key(|face| face.cell);
        Ok(faces)
    }
}

impl FaceSide {
    fn new(id: u32, corners: &[u32; 4]) -> Self {
        let [a, b, c] = FACES[(id % 4) as usize].map(|corner| corners[corner]);
        let sorted = sorted([a, b, c]);
        let is_even = [[a, b, c], [b, c, a], [c, a, b]].contains(&sorted);
        Self {
            sorted,
            id,
            is_even,
        }
    }

    fn outer(&self, corners: &[u32; 4]) -> OuterFace {
        OuterFace {
            corners: FACES[(self.id % 4) as usize].map(|corner| corners[corner]),
            cell: self.id / 4,
        }
    }
}

/// Returns numbers in ascending order.
fn sorted<const N: usize>(mut numbers: [u32; N]) -> [u32; N] {
    numbers.sort_unstable();
    numbers
}

/// Returns the middle of a few points.
pub(super) fn middle<const N: usize>(points: [Point; N]) -> Point {
    let sum: Vector = points.iter().map(|point| point.coords).sum();
    Point::from(sum / N as f64)
}
