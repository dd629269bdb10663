//! The rungs of [`repair`] in their order, with the count of what each did.

use std::collections::HashSet;
use std::fmt;

use super::holes::fill_holes;
use super::orient::{face_outward, orient_neighbours};
use super::sew::sew;
use super::unite::unite_shells;
use super::unstitch::unstitch;
use super::weld::{drop_unused_vertices, weld, weld_open_edges};
use crate::base::units::format_count;
use crate::geom::{Bvh, Point};
use crate::mesh::edges::{EdgeKind, EdgeTable, edge_kind};
use crate::mesh::fans::Fans;
use crate::mesh::{TriMesh, shells, smallest_first};

/// Largest distance between rims to be welded, as a share of the diagonal of the bounding box.
/// Below about 1e-7 the last digit of a file in single precision keeps seams open. Above 1e-5 (1 µm
/// on a 100 mm model) details that a printer can show would be merged.
const WELD_TOLERANCE_RATIO: f64 = 1e-6;

/// Largest distance between rims that are stitched, as a share of the diagonal of the bounding box.
/// It is 0.01 mm on a model of a metre, which is larger than any printer's room that we know.
const STITCH_TOLERANCE_RATIO: f64 = 1e-5;

/// Largest number of open edges that are stitched: each is compared with all corners on rims.
const MAX_STITCHED_EDGES: usize = 4000;

/// Counts of the changes that [`repair`] made to a mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Repairs {
    /// Vertices merged with another at exactly the same place.
    pub merged_vertices: usize,
    /// Vertices on open edges merged with another within a millionth of the model's diagonal.
    pub merged_near_vertices: usize,
    /// Dropped triangles that repeated a corner.
    pub dropped_degenerate: usize,
    /// Dropped triangles that repeated another triangle.
    pub dropped_duplicates: usize,
    /// Triangles flipped to agree with their neighbours or to face outward.
    pub flipped_triangles: usize,
    /// Vertices added to separate surfaces that only touch in a vertex or an edge.
    pub split_vertices: usize,
    /// Dropped vertices that no triangle used.
    pub dropped_vertices: usize,
    /// Open edges along cracks that were stitched.
    pub stitched_edges: usize,
    /// Largest distance by which a vertex moved in stitching, as a share of the diagonal.
    pub stitched_ratio: f64,
    /// Holes that were filled. Nothing moved.
    pub filled_holes: usize,
    /// Area of the fillings over that of the surface before.
    pub filled_area_ratio: f64,
    /// Closed surfaces that were united with those they overlap.
    pub united_shells: usize,
}

impl Repairs {
    /// Returns true if nothing had to be done.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Describes what the rungs did that close the surface or unite it.
    fn describe_closing(&self) -> Vec<String> {
        let stitched = (self.stitched_edges > 0).then(|| {
            format!(
                "open edges stitched along cracks: {} (no point moved by more than {:.4} % of the model's diagonal)",
                self.stitched_edges,
                100.0 * self.stitched_ratio
            )
        });
        let filled = (self.filled_holes > 0).then(|| {
            format!(
                "{} filled, {:.2} % of the surface (nothing moved)",
                format_count(self.filled_holes, "hole"),
                100.0 * self.filled_area_ratio
            )
        });
        let united = (self.united_shells > 0).then(|| {
            format!(
                "closed surfaces that overlap united: {}",
                self.united_shells
            )
        });
        stitched.into_iter().chain(filled).chain(united).collect()
    }

    /// Returns the counts that a user should know. Leaves out the merging of equal vertices,
    /// which every STL file needs, and the dropping of unused ones, which nobody sees.
    pub fn notable(self) -> Self {
        Self {
            merged_vertices: 0,
            dropped_vertices: 0,
            ..self
        }
    }
}

impl fmt::Display for Repairs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let done = [
            (
                self.merged_vertices,
                "vertices merged with another at the same place",
            ),
            (
                self.merged_near_vertices,
                "vertices on open edges merged with one next to them",
            ),
            (self.dropped_degenerate, "triangles without area dropped"),
            (self.dropped_duplicates, "doubled triangles dropped"),
            (self.flipped_triangles, "triangles turned to face outward"),
            (
                self.split_vertices,
                "vertices added where surfaces only touch",
            ),
            (self.dropped_vertices, "unused vertices dropped"),
        ];
        let descriptions: Vec<String> = done
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, description)| format!("{description}: {count}"))
            .chain(self.describe_closing())
            .collect();
        if descriptions.is_empty() {
            f.write_str("nothing")
        } else {
            f.write_str(&descriptions.join(", "))
        }
    }
}

/// Climbs the ladder of repairs that keep the shape; returns the mesh and the count of each repair.
///
/// See the [room](super) for the rungs and their proofs. A mesh that is already sound comes back
/// unchanged. Only the welding and stitching of rims moves vertices, by at most 1e-5 of the
/// diagonal. Linear in the triangles except for sorts, rims and overlaps, which have limits.
#[must_use]
pub fn repair(mesh: TriMesh) -> (TriMesh, Repairs) {
    let mut repairs = Repairs::default();
    let mesh = merge_equal_vertices(mesh, &mut repairs);
    let mesh = close_seams(mesh, &mut repairs);
    let mesh = drop_duplicates(mesh, &mut repairs);
    let mesh = drop_unused(mesh, &mut repairs);
    let before = mesh.clone();
    let mesh = orient_if_misoriented(mesh);
    repairs.flipped_triangles = count_flipped(&before, &mesh);
    let mesh = stitch_cracks(mesh, &mut repairs);
    let mesh = fill(mesh, &mut repairs);
    let mesh = separate_touching_surfaces(mesh, &mut repairs);
    let before = mesh.clone();
    let mesh = face_outward_if_closed(mesh);
    repairs.flipped_triangles += count_flipped(&before, &mesh);
    let mesh = unite(mesh, &mut repairs);
    (mesh, repairs)
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
    let sewn = drop_degenerate(sew(&mesh, STITCH_TOLERANCE_RATIO * diagonal), &mut trial);
    let sewn = drop_unused_vertices(sewn);
    let still_open = EdgeTable::of(&sewn).of_kind(EdgeKind::Open).count();
    if still_open >= open || EdgeTable::of(&sewn).bad_count() > still_open {
        return mesh;
    }
    let moved_ratio = farthest_mm(&mesh, &sewn) / diagonal;
    if moved_ratio > STITCH_TOLERANCE_RATIO {
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
fn fill(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    match fill_holes(&mesh) {
        Some(filled) => {
            repairs.filled_holes = filled.holes;
            repairs.filled_area_ratio = filled.area_ratio;
            filled.mesh
        }
        None => mesh,
    }
}

/// Unites the shells of a closed mesh, if some overlap.
fn unite(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    match unite_shells(&mesh) {
        Some(united) => {
            repairs.united_shells = shells(&mesh).len();
            united
        }
        None => mesh,
    }
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
mod tests;
