//! Moves cutting planes off vertices and faces, so that cuts leave no sheets without volume.

use super::TriMesh;
use crate::geom::Plane;

/// Least distance of a vertex from a planned cut, mm. Nearer, a face along the cut could leave
/// sheets without volume.
const VERTEX_GAP_MM: f64 = 1e-6;
/// Largest number of steps, each of twice the gap, by which a cut is moved to avoid vertices.
const MAX_NUDGES: usize = 200;
/// Least thickness of a sheet that a cut may leave, mm: a hundred times the step of single
/// precision at 100 mm. Much thinner, the two sides of a sheet could meet in the file. Much
/// thicker, the cut would visibly miss the requested place.
const SHEET_MM: f64 = 1e-3;
/// Largest number of faces, one behind the other, that a cut is moved past. A model with more is
/// made of sheets.
const MAX_FACES: usize = 16;
/// Cosine of the angle above which a triangle counts as parallel to a plane. A steeper triangle is
/// a small piece of a slope, not a side of a sheet.
const PARALLEL_COSINE: f64 = 0.99;

/// Moves a cutting plane along its normal until no vertex is within [`VERTEX_GAP_MM`] of it.
///
/// If the cut would leave a sheet thinner than [`SHEET_MM`] on faces parallel to it, the plane
/// moves out of the material behind them. With such material on both sides, it moves so far that
/// the sheet left on one side survives the single precision of a file.
pub(crate) fn move_off_vertices(mesh: &TriMesh, plane: &Plane) -> Plane {
    let mut heights: Vec<f64> = mesh
        .vertices()
        .iter()
        .map(|p| plane.normal.dot(&p.coords))
        .collect();
    heights.sort_by(f64::total_cmp);
    let is_free = |offset_mm: f64| {
        let next = heights.partition_point(|&h| h < offset_mm - VERTEX_GAP_MM);
        heights
            .get(next)
            .is_none_or(|&h| h > offset_mm + VERTEX_GAP_MM)
    };
    let (direction, start_mm) = step_clear_of_sheets(mesh, plane);
    let steps = (0..MAX_NUDGES).map(|i| start_mm + 2.0 * VERTEX_GAP_MM * i as f64);
    let mut offsets = steps.map(|step_mm| plane.offset_mm + direction * step_mm);
    let offset_mm = offsets.find(|&o| is_free(o)).unwrap_or(plane.offset_mm);
    Plane {
        normal: plane.normal,
        offset_mm,
    }
}

/// Returns the direction (±1 along its normal) and the least distance, mm, to move a plane so that
/// it leaves no thin sheet.
fn step_clear_of_sheets(mesh: &TriMesh, plane: &Plane) -> (f64, f64) {
    let direction = if let [None, Some(_)] = thin_sheets(mesh, plane) {
        -1.0
    } else {
        1.0
    };
    let mut step_mm = 0.0;
    for _ in 0..MAX_FACES {
        let moved = Plane {
            offset_mm: plane.offset_mm + direction * step_mm,
            ..*plane
        };
        let [above, below] = thin_sheets(mesh, &moved);
        let (ahead, behind) = if direction > 0.0 {
            (above, below)
        } else {
            (below, above)
        };
        step_mm += match (ahead, behind) {
            (None, None) => break,
            (Some(thick_mm), None) => thick_mm + 2.0 * VERTEX_GAP_MM,
            (thick_mm, Some(_)) => thick_mm.unwrap_or(0.0) + 2.0 * SHEET_MM,
        };
    }
    (direction, step_mm)
}

/// Returns the plane unchanged unless it would leave a sheet thinner than [`SHEET_MM`] on a face
/// parallel to it. Then returns that of [`move_off_vertices`].
pub(crate) fn move_off_faces(mesh: &TriMesh, plane: &Plane) -> Plane {
    if thin_sheets(mesh, plane) == [None, None] {
        *plane
    } else {
        move_off_vertices(mesh, plane)
    }
}

/// Returns the thickness of the thickest thin sheet that a plane leaves above itself, and below.
///
/// A thin sheet lies between the plane and a parallel face less than [`SHEET_MM`] away, with the
/// material on the plane's side. `None` if there is none.
fn thin_sheets(mesh: &TriMesh, plane: &Plane) -> [Option<f64>; 2] {
    let mut thickest = [None; 2];
    for [a, b, c] in mesh.iter_corners() {
        let heights = [a, b, c].map(|p| plane.distance(&p));
        if heights.iter().any(|h| h.abs() > SHEET_MM) {
            continue;
        }
        let area = (b - a).cross(&(c - a));
        let facing = plane.normal.dot(&area);
        let thick_mm = heights
            .iter()
            .fold(f64::MIN, |most, h| most.max(h * facing.signum()));
        if facing.abs() > PARALLEL_COSINE * area.norm() && thick_mm > -VERTEX_GAP_MM {
            let side = &mut thickest[usize::from(facing < 0.0)];
            *side = Some(side.unwrap_or(0.0_f64).max(thick_mm));
        }
    }
    thickest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::mesh::{Csg, primitives::cuboid};

    fn body(min: [f64; 3], max: [f64; 3]) -> Csg {
        Csg::of_mesh(&cuboid(&Point::from(min), &Point::from(max))).unwrap()
    }

    #[test]
    fn a_cut_along_a_face_leaves_no_sheet_of_it() {
        // The plane z = 1 holds the top of the lower step.
        let stair = body([0.0; 3], [2.0, 1.0, 1.0]).union(&body([0.0; 3], [1.0, 1.0, 3.0]));
        let stair = stair.unwrap().to_mesh().unwrap();
        for normal in [Vector::z(), -Vector::z()] {
            let plane = Plane {
                normal,
                offset_mm: normal.z,
            };
            let moved = move_off_faces(&stair, &plane);
            assert_eq!(move_off_faces(&stair, &moved), moved);
            let (above, below) = Csg::of_mesh(&stair)
                .unwrap()
                .split_by_plane(&moved)
                .unwrap();
            let upper = if normal.z > 0.0 { above } else { below };
            // Only the upper box is left above the step: nothing of the step 1 mm wide.
            assert!(
                upper.to_mesh().unwrap().aabb().max.x < 1.0 + 1e-12,
                "{normal}"
            );
        }
    }

    #[test]
    fn a_cut_along_faces_of_both_ways_leaves_a_sheet_that_a_file_holds() {
        // A step up on one side and a ledge over air on the other, both at z = 1.
        let tower = body([0.0; 3], [2.0, 1.0, 1.0]).union(&body([0.0; 3], [1.0, 1.0, 3.0]));
        let tower = tower
            .unwrap()
            .union(&body([-1.0, 0.0, 1.0], [0.5, 1.0, 2.0]))
            .unwrap();
        let mesh = tower.to_mesh().unwrap();
        let plane = Plane {
            normal: Vector::z(),
            offset_mm: 1.0,
        };
        let moved = move_off_vertices(&mesh, &plane);
        assert!(
            (moved.offset_mm - 1.0 - 2.0 * SHEET_MM).abs() < 1e-5,
            "{moved:?}"
        );
        assert_eq!(move_off_faces(&mesh, &moved), moved);
    }
}
