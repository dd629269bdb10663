//! The rungs of [`repair`] in their order, with the count of what each did.

use std::collections::{BTreeSet, HashSet};

use super::holes::fill_holes;
use super::inner::settle_inner;
use super::order::InnerSurfaces;
use super::orient::{face_outward, orient_neighbours};
use super::report::Repairs;
use super::sew::sew;
use super::unite::unite_shells;
use super::unstitch::unstitch;
use super::untangle::untangle;
use super::weld::{drop_unused_vertices, weld, weld_open_edges};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point};
use crate::mesh::crossings::crossing_pairs;
use crate::mesh::edges::{EdgeKind, EdgeTable, edge_kind};
use crate::mesh::fans::Fans;
use crate::mesh::shells::Shells;
use crate::mesh::{TriMesh, shells, smallest_first};

/// Largest distance between rims to be welded, as a share of the diagonal of the bounding box.
/// Below about 1e-7 the last digit of a file in single precision keeps seams open. Above 1e-5 (1 µm
/// on a 100 mm model) details that a printer can show would be merged.
const WELD_TOLERANCE_RATIO: f64 = 1e-6;

/// Largest distance by which stitching and untangling may move the surface, as a share of the
/// diagonal of the bounding box. It is 0.01 mm on a model of a metre, which is larger than any
/// printer's room that we know.
const MOST_MOVED_RATIO: f64 = 1e-5;

/// Largest number of open edges that are stitched: each is compared with all corners on rims.
const MAX_STITCHED_EDGES: usize = 4000;

/// Climbs the ladder of repairs that keep the shape; returns the mesh and the count of each repair.
///
/// See the [room](super) for the rungs and their proofs. A mesh that is already sound comes back
/// unchanged. Only the welding and stitching of rims and the untangling of crossings move the
/// surface, by at most 1e-5 of the diagonal. Linear in the triangles except for sorts, rims and
/// overlaps, which have limits.
///
/// # Errors
/// The watch was stopped.
pub fn repair(mesh: TriMesh, watch: &Watch) -> Result<(TriMesh, Repairs), Cancelled> {
    repair_with(mesh, InnerSurfaces::Refuse, watch)
}

/// Climbs the ladder like [`repair`], and settles inner surfaces as ordered before the last rung.
///
/// # Errors
/// The watch was stopped.
pub fn repair_with(
    mesh: TriMesh,
    inner: InnerSurfaces,
    watch: &Watch,
) -> Result<(TriMesh, Repairs), Cancelled> {
    let mut repairs = Repairs::default();
    let mesh = merge_equal_vertices(mesh, &mut repairs);
    let mesh = close_seams(mesh, &mut repairs);
    let mesh = drop_duplicates(mesh, &mut repairs);
    let mesh = drop_unused(mesh, &mut repairs);
    let before = mesh.clone();
    let mesh = orient_if_misoriented(mesh);
    repairs.flipped_triangles = count_flipped(&before, &mesh);
    watch.check()?;
    let mesh = stitch_cracks(mesh, &mut repairs);
    watch.check()?;
    let mesh = fill(mesh, &mut repairs, watch)?;
    let mesh = separate_touching_surfaces(mesh, &mut repairs);
    let before = mesh.clone();
    let mesh = face_outward_if_closed(mesh);
    repairs.flipped_triangles += count_flipped(&before, &mesh);
    let mesh = untangle_shells(mesh, &mut repairs, watch)?;
    let mesh = settle_inner(mesh, inner, &mut repairs, watch)?;
    let mesh = unite(mesh, &mut repairs, watch)?;
    Ok((mesh, repairs))
}

/// Stitches rims that nearly meet, if fewer edges are open then and none is crowded.
fn stitch_cracks(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let diagonal = mesh.aabb().size().norm();
    let table = EdgeTable::of(&mesh);
    let open = table.of_kind(EdgeKind::Open).count();
    if !diagonal.is_finite() || diagonal <= 0.0 || !(1..=MAX_STITCHED_EDGES).contains(&open) {
        return mesh;
    }
    let mut trial = *repairs;
    let sewn = drop_degenerate(sew(&mesh, MOST_MOVED_RATIO * diagonal), &mut trial);
    let sewn = drop_unused_vertices(sewn);
    let still_open = EdgeTable::of(&sewn).of_kind(EdgeKind::Open).count();
    if still_open >= open || EdgeTable::of(&sewn).bad_count() > still_open {
        return mesh;
    }
    let moved_ratio = farthest_mm(&mesh, &sewn) / diagonal;
    if moved_ratio > MOST_MOVED_RATIO {
        return mesh;
    }
    *repairs = trial;
    repairs.stitched_edges = open - still_open;
    repairs.stitched_ratio = moved_ratio;
    sewn
}

/// Returns the distance from a surface of the vertex of `mesh` that is farthest from it.
fn farthest_mm(mesh: &TriMesh, surface: &TriMesh) -> f64 {
    let bvh = Bvh::new(surface.iter_corners());
    let distance = |p: &Point| {
        bvh.closest(p, f64::INFINITY, &[])
            .map_or(f64::INFINITY, |nearest| nearest.distance_squared.sqrt())
    };
    mesh.vertices().iter().map(distance).fold(0.0, f64::max)
}

/// Fills all holes, or none.
fn fill(mesh: TriMesh, repairs: &mut Repairs, watch: &Watch) -> Result<TriMesh, Cancelled> {
    Ok(match fill_holes(&mesh, watch)? {
        Some(filled) => {
            repairs.filled_holes = filled.holes;
            repairs.filled_area_ratio = filled.area_ratio;
            filled.mesh
        }
        None => mesh,
    })
}

/// Untangles each outward shell of a closed mesh that crosses itself, if that moves it by no more
/// than the stitching of cracks may.
fn untangle_shells(
    mesh: TriMesh,
    repairs: &mut Repairs,
    watch: &Watch,
) -> Result<TriMesh, Cancelled> {
    let table = EdgeTable::of(&mesh);
    let diagonal_mm = mesh.aabb().size().norm();
    if table.bad_count() > 0 || !diagonal_mm.is_finite() || diagonal_mm <= 0.0 {
        return Ok(mesh);
    }
    let of_shells = Shells::of(&mesh, &table);
    let shell_of = |t: u32| of_shells.shell_of(t as usize);
    let pairs = crossing_pairs(&mesh, watch)?.into_iter();
    let crossed: BTreeSet<usize> = pairs
        .filter(|&[a, b]| shell_of(a) == shell_of(b))
        .map(|[a, _]| shell_of(a))
        .collect();
    if crossed.is_empty() {
        return Ok(mesh);
    }
    let mut all = TriMesh::default();
    for (shell, members) in of_shells.members().iter().enumerate() {
        let triangles = members.iter().map(|&t| mesh.triangles()[t as usize]);
        let one = TriMesh::from_parts(mesh.vertices().to_vec(), triangles.collect());
        let one = drop_unused_vertices(one);
        let untangled = if crossed.contains(&shell) && one.signed_volume_mm3() > 0.0 {
            untangle(&one, watch)?
        } else {
            None
        };
        let limit_mm = MOST_MOVED_RATIO * diagonal_mm;
        all = match untangled.filter(|untangled| untangled.moved_mm <= limit_mm) {
            Some(untangled) => {
                repairs.untangled_pairs += untangled.pairs;
                let ratio = untangled.moved_mm / diagonal_mm;
                repairs.untangled_ratio = repairs.untangled_ratio.max(ratio);
                all.joined(&untangled.mesh)
            }
            None => all.joined(&one),
        };
    }
    Ok(all)
}

/// Unites the shells of a closed mesh, if some overlap.
fn unite(mesh: TriMesh, repairs: &mut Repairs, watch: &Watch) -> Result<TriMesh, Cancelled> {
    Ok(match unite_shells(&mesh, watch)? {
        Some(united) => {
            repairs.united_shells = shells(&mesh).len();
            united
        }
        None => mesh,
    })
}

/// Merges vertices at the same place, and drops the triangles that lose a corner.
fn merge_equal_vertices(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let welded = weld(&mesh);
    repairs.merged_vertices = mesh.vertices().len() - welded.vertices().len();
    drop_degenerate(welded, repairs)
}

/// Drops the triangles that repeat a corner: they have no area and their sides cancel.
fn drop_degenerate(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let sound = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    let triangles: Vec<[u32; 3]> = mesh.triangles().iter().copied().filter(sound).collect();
    repairs.dropped_degenerate += mesh.triangles().len() - triangles.len();
    TriMesh::from_parts(mesh.into_vertices(), triangles)
}

fn has_kind(mesh: &TriMesh, kind: EdgeKind) -> bool {
    EdgeTable::of(mesh).of_kind(kind).next().is_some()
}

/// Welds rims that nearly meet, if that leaves no edge open and none crowded.
fn close_seams(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let tolerance_mm = WELD_TOLERANCE_RATIO * mesh.aabb().size().norm();
    if !tolerance_mm.is_finite() || tolerance_mm <= 0.0 || !has_kind(&mesh, EdgeKind::Open) {
        return mesh;
    }
    let mut trial = *repairs;
    let welded = weld_open_edges(&mesh, tolerance_mm);
    trial.merged_near_vertices = mesh.vertices().len() - welded.vertices().len();
    let welded = drop_degenerate(welded, &mut trial);
    let has_two_sides =
        |sides: &[_]| matches!(edge_kind(sides), EdgeKind::Paired | EdgeKind::Misoriented);
    if EdgeTable::of(&welded).edges().all(has_two_sides) {
        *repairs = trial;
        return welded;
    }
    mesh
}

/// Drops triangles that repeat another one's corners in the same order, if fewer edges are bad
/// then.
fn drop_duplicates(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let bad = EdgeTable::of(&mesh).bad_count();
    if bad == 0 {
        return mesh;
    }
    let mut seen = HashSet::new();
    let is_first = |t: &[u32; 3]| seen.insert(smallest_first(*t));
    let triangles: Vec<[u32; 3]> = mesh.triangles().iter().copied().filter(is_first).collect();
    let dropped = mesh.triangles().len() - triangles.len();
    let candidate = TriMesh::from_parts(mesh.vertices().to_vec(), triangles);
    if dropped == 0 || EdgeTable::of(&candidate).bad_count() >= bad {
        return mesh;
    }
    repairs.dropped_duplicates = dropped;
    candidate
}

/// Drops the vertices that no triangle uses.
fn drop_unused(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let before = mesh.vertices().len();
    let mesh = drop_unused_vertices(mesh);
    repairs.dropped_vertices = before - mesh.vertices().len();
    mesh
}

/// Makes neighbours agree, if some do not.
fn orient_if_misoriented(mesh: TriMesh) -> TriMesh {
    if has_kind(&mesh, EdgeKind::Misoriented) {
        orient_neighbours(mesh)
    } else {
        mesh
    }
}

/// Doubles the vertices and edges in which surfaces only touch, if every edge has two triangles
/// then.
fn separate_touching_surfaces(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let table = EdgeTable::of(&mesh);
    if table.bad_count() == 0 && Fans::of(&mesh, &table).pinches(&mesh).is_empty() {
        return mesh;
    }
    match unstitch(&mesh) {
        Some(split) => {
            repairs.split_vertices = split.vertices().len() - mesh.vertices().len();
            split
        }
        None => mesh,
    }
}

/// Turns whole shells to face outward, cavities inward, if every edge joins two triangles.
fn face_outward_if_closed(mesh: TriMesh) -> TriMesh {
    if EdgeTable::of(&mesh).bad_count() == 0 {
        face_outward(mesh)
    } else {
        mesh
    }
}

/// Counts the triangles that have the opposite orientation in the two meshes.
///
/// Corners may have new numbers but keep their places, and a flip swaps the last two corners.
fn count_flipped(before: &TriMesh, after: &TriMesh) -> usize {
    let last = |mesh: &TriMesh, t: usize| mesh.corners(t)[2];
    (0..after.triangles().len())
        .filter(|&t| last(before, t) != last(after, t))
        .count()
}

#[cfg(test)]
mod broken;
#[cfg(test)]
mod tests;
