//! Searches a closed surface for overlaps with itself, on a lattice of columns.

use rayon::prelude::*;

use super::bins::Bins;
use super::crossings::RowCrossings;
use super::ruler::Ruler;
use crate::mesh::TriMesh;

/// Columns along a side of the lattice that is searched. Fewer miss smaller overlaps; more take
/// longer than the sweep at a coarse pitch itself.
const COLUMNS_A_SIDE: f64 = 160.0;
/// Length, mm, below which a stretch of a wrong winding number is rounding of a column that grazes
/// the surface.
const MIN_DEPTH_MM: f64 = 1e-6;

/// Returns whether some column of a coarse lattice meets points with a winding number other than 0
/// or 1.
///
/// Such points lie in overlapping components or in parts turned inside out. Overlaps between the
/// columns are not found.
pub(super) fn overlaps_itself(mesh: &TriMesh) -> bool {
    let bounds = mesh.aabb();
    let pitch_mm = bounds.size().xy().max() / COLUMNS_A_SIDE;
    let xs = Ruler::covering([bounds.min.x, bounds.max.x], pitch_mm, Ruler::PHASE_X);
    let ys = Ruler::covering([bounds.min.y, bounds.max.y], pitch_mm, Ruler::PHASE_Y);
    let bins = Bins::of_ranges(triangle_y_ranges(mesh), &ys, 1);
    (0..ys.len()).into_par_iter().any(|row| {
        let mut crossings = RowCrossings::default();
        crossings.find(mesh, bins.of(row), ys.at(row), &xs);
        (0..xs.len()).any(|column| winds_wrongly(&crossings, column))
    })
}

/// Returns the y-range of each triangle, mm.
pub(super) fn triangle_y_ranges(mesh: &TriMesh) -> impl Iterator<Item = [f64; 2]> + Clone + '_ {
    mesh.triangles().iter().map(|corners| {
        let [a, b, c] = corners.map(|vertex| mesh.vertices()[vertex as usize].y);
        [a.min(b).min(c), a.max(b).max(c)]
    })
}

/// Returns whether a column's winding number is neither 0 nor 1 over some height.
fn winds_wrongly(crossings: &RowCrossings, column: usize) -> bool {
    let mut winding = 0;
    crossings.of(column).windows(2).any(|pair| {
        winding += pair[0].winding_step;
        !(0..=1).contains(&winding) && pair[1].z_mm - pair[0].z_mm > MIN_DEPTH_MM
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::shell::fixtures;

    #[test]
    fn boxes_overlap_themselves_only_when_they_do() {
        let solid = fixtures::cells(&[[0, 0, 0]], 10.0);
        let moved = |x: f64| solid.mesh().map_vertices(|p| p + Vector::new(x, 1.0, 1.0));
        assert!(!overlaps_itself(solid.mesh()));
        assert!(!overlaps_itself(&solid.mesh().clone().joined(&moved(11.0))));
        assert!(overlaps_itself(&solid.mesh().clone().joined(&moved(9.0))));
        assert!(overlaps_itself(&solid.mesh().reversed()));
    }
}
