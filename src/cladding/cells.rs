//! The cells of a polyhedron's faces: which face has the space outside, by bisectors.
//!
//! The cell of face i holds the points outside for which no other face is farther below. It is
//! convex, and bounded by planes through the polyhedron's edges. Moved along the face's normal it
//! stays within itself: so a body in it can leave that way without touching one in another cell.

use super::region::{Bound, BoundKind, Region};
use crate::geom::Plane;
use crate::polyhedra::Polyhedron;

/// The cell of one face.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The index of the face.
    pub face: usize,
    /// The points of the cell that are farther than the gap above the face.
    pub region: Region,
}

/// Returns the cells of all faces that have an area, in the order of the faces.
///
/// Together they hold, once, every point outside of the polyhedron grown by the gap, mm.
pub fn cells(body: &Polyhedron, gap_mm: f64) -> Vec<Cell> {
    let faces = body.faces().iter().enumerate();
    let faces = faces.filter(|(_, face)| face.area_mm2 > 0.0);
    let planes: Vec<(usize, Plane)> = faces.map(|(face, of)| (face, of.plane)).collect();
    let cell = |&(face, plane): &(usize, Plane)| {
        let floor = Bound {
            plane: Plane {
                normal: -plane.normal,
                offset_mm: -(plane.offset_mm + gap_mm),
            },
            kind: BoundKind::Floor,
        };
        let others = planes.iter().filter(|(other, _)| *other != face);
        let seams = others.filter_map(|(other, beside)| {
            Some(Bound {
                plane: bisector(&plane, beside)?,
                kind: BoundKind::Seam { face: *other },
            })
        });
        Cell {
            face,
            region: Region::new([floor].into_iter().chain(seams).collect()),
        }
    };
    planes.iter().map(cell).collect()
}

/// Returns the plane whose points are as high above one plane as above another; the first plane is
/// higher below it. `None` for parallel planes that face the same way.
fn bisector(plane: &Plane, other: &Plane) -> Option<Plane> {
    let way = other.normal - plane.normal;
    let length = way.norm();
    (length > 0.0).then(|| Plane {
        normal: way / length,
        offset_mm: (other.offset_mm - plane.offset_mm) / length,
    })
}
