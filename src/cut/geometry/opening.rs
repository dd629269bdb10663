//! The width to which a plane opens a void.

use crate::{
    cut::geometry::{section::Section, sides::Sides},
    geom::Plane,
    mesh::TriMesh,
};

/// A void opened by a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Opening {
    /// Diameter of the largest disc through the narrowest mouth of the void's pieces, mm.
    pub(crate) diameter_mm: f64,
    /// Area of all mouths, mm².
    pub(crate) area_mm2: f64,
}

/// Greatest depth of a dimple, over half the diameter of its mouth. A dimple lies wholly in sight,
/// so its mouth may be of any width. Larger values would accept pockets that hide their bottom.
const DIMPLE_DEPTH_RATIO: f64 = 1.0;

/// Returns how the plane opens the void; `None` if it misses the void.
///
/// A plane may divide a void into several pieces (a horseshoe cut near its bend). Every piece
/// deeper than a dimple must be reached, so the piece with the narrowest mouth counts. A piece with
/// several mouths is rated by its widest.
pub(crate) fn measure_opening(void: &TriMesh, plane: &Plane) -> Option<Opening> {
    let section = Section::of_mesh(void, plane);
    if section.rings.is_empty() {
        return None;
    }
    Some(Opening {
        area_mm2: section.area_mm2(),
        diameter_mm: narrowest_mouth_mm(void, plane, section),
    })
}

/// Returns whether a pocket is so shallow for its mouth that all of it lies in sight.
pub(crate) fn is_dimple(depth_mm: f64, mouth_mm: f64) -> bool {
    2.0 * depth_mm <= DIMPLE_DEPTH_RATIO * mouth_mm
}

/// Returns the mouth of the piece that has the narrowest, mm.
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
    let pieces = pieces_with_mouths(&sides, &mouths);
    let deep = pieces
        .iter()
        .filter(|&&(piece, mm)| !is_dimple(sides.depth_mm(piece), mm));
    deep.map(|&(_, mm)| mm).fold(widest_mm, f64::min)
}

/// Returns the pieces of the void, each with the diameter of its widest mouth, mm.
fn pieces_with_mouths(sides: &Sides, mouths: &[f64]) -> Vec<(u32, f64)> {
    let mut pieces: Vec<(u32, f64)> = Vec::new();
    for (group, &mouth_mm) in mouths.iter().enumerate() {
        for piece in sides.neighbours(group) {
            match pieces.iter_mut().find(|(known, _)| *known == piece) {
                Some((_, widest)) => *widest = widest.max(mouth_mm),
                None => pieces.push((piece, mouth_mm)),
            }
        }
    }
    pieces
}
