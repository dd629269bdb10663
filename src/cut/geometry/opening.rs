//! How wide a plane opens a void.

use crate::{
    cut::geometry::{section::Section, sides::Sides},
    geom::Plane,
    mesh::TriMesh,
};

/// A void opened by a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Opening {
    /// The diameter of the largest disc through the narrowest mouth of the void's pieces, mm.
    pub(crate) diameter_mm: f64,
}

/// A piece of a void this many times as deep as half its mouth, or shallower, is a dimple: all of
/// it lies in sight, so its mouth may be of any width. Larger values would let pockets pass that
/// hide their bottom.
const DIMPLE_DEPTH_RATIO: f64 = 1.0;

/// How the plane opens the void; `None` where it misses it.
///
/// A plane may part a void into several pieces (a horseshoe cut near its bend). Every piece deeper
/// than a dimple must be reached, so the piece with the narrowest mouth counts, and of each piece
/// its widest mouth.
pub(crate) fn opening(void: &TriMesh, plane: &Plane) -> Option<Opening> {
    let section = Section::of_mesh(void, plane);
    if section.rings.is_empty() {
        return None;
    }
    Some(Opening {
        diameter_mm: narrowest_mouth_mm(void, plane, section),
    })
}

/// Whether a pocket is so shallow for its mouth that all of it lies in sight.
pub(crate) fn is_dimple(depth_mm: f64, mouth_mm: f64) -> bool {
    2.0 * depth_mm <= DIMPLE_DEPTH_RATIO * mouth_mm
}

/// The mouth of the void's piece that has the narrowest, mm.
fn narrowest_mouth_mm(void: &TriMesh, plane: &Plane, section: Section) -> f64 {
    let polygons = section.groups();
    let mouth_mm = |rings: &Vec<usize>| {
        section
            .outline(rings)
            .largest_disc(0.0)
            .map_or(0.0, |disc| 2.0 * disc.radius_mm)
    };
    let mouths: Vec<f64> = polygons.iter().map(mouth_mm).collect();
    let widest_mm = mouths.iter().copied().fold(0.0, f64::max);
    if mouths.len() <= 1 {
        return widest_mm;
    }
    let sides = Sides::new(void, *plane, section);
    let pieces = pieces(&sides, &mouths);
    let deep = pieces
        .iter()
        .filter(|&&(piece, mm)| !is_dimple(sides.depth_mm(piece), mm));
    deep.map(|&(_, mm)| mm).fold(widest_mm, f64::min)
}

/// The pieces of the void, each with the diameter of its widest mouth.
fn pieces(sides: &Sides, mouths: &[f64]) -> Vec<(u32, f64)> {
    let mut pieces: Vec<(u32, f64)> = Vec::new();
    for (group, &mouth_mm) in mouths.iter().enumerate() {
        for piece in sides.neighbours(group) {
            match pieces.iter_mut().find(|(name, _)| *name == piece) {
                Some((_, widest)) => *widest = widest.max(mouth_mm),
                None => pieces.push((piece, mouth_mm)),
            }
        }
    }
    pieces
}
