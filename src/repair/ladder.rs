//! The rungs of [`repair`] in their order, with the count of what each did.

use std::collections::HashSet;
use std::fmt;

use super::orient::{face_outward, orient_neighbours};
use super::unstitch::unstitch;
use super::weld::{drop_unused_vertices, weld, weld_open_edges};
use crate::mesh::edges::{EdgeKind, EdgeTable, edge_kind};
use crate::mesh::fans::Fans;
use crate::mesh::{TriMesh, smallest_first};

/// Largest distance between rims to be welded, as a share of the diagonal of the bounding box.
/// Below about 1e-7 the last digit of a file in single precision keeps seams open. Above 1e-5 (1 µm
/// on a 100 mm model) details that a printer can show would be merged.
const WELD_TOLERANCE_RATIO: f64 = 1e-6;

/// Counts of the changes that [`repair`] made to a mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
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
}

impl Repairs {
    /// Returns true if nothing had to be done.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
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
/// See the [room](super) for the rungs and their proofs. No hole is filled. A mesh that is already
/// sound comes back unchanged. Only the welding of rims moves vertices. Linear in the triangles
/// except for one sort of the vertices.
#[must_use]
pub fn repair(mesh: TriMesh) -> (TriMesh, Repairs) {
    let mut repairs = Repairs::default();
    let mesh = merge_equal_vertices(mesh, &mut repairs);
    let mesh = close_seams(mesh, &mut repairs);
    let mesh = drop_duplicates(mesh, &mut repairs);
    let mesh = drop_unused(mesh, &mut repairs);
    let before = mesh.clone();
    let mesh = orient_if_misoriented(mesh);
    let mesh = separate_touching_surfaces(mesh, &mut repairs);
    let mesh = face_outward_if_closed(mesh);
    repairs.flipped_triangles = count_flipped(&before, &mesh);
    (mesh, repairs)
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
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::mesh::primitives::{ball, cuboid, torus};
    use crate::mesh::{Defects, Solid};

    fn unit_cube() -> TriMesh {
        cuboid(&Point::origin(), &Point::new(1.0, 1.0, 1.0))
    }

    /// Gives every triangle three corners of its own, moved by `shift(triangle)`.
    fn soup(mesh: &TriMesh, shift: impl Fn(usize) -> Vector) -> TriMesh {
        let vertices = mesh
            .iter_corners()
            .enumerate()
            .flat_map(|(t, corners)| corners.map(|p| p + shift(t)));
        let triangles = (0..mesh.triangles().len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect();
        TriMesh::new(vertices.collect(), triangles).unwrap()
    }

    fn with_triangles(mesh: &TriMesh, more: &[[u32; 3]]) -> TriMesh {
        TriMesh::new(mesh.vertices().to_vec(), [mesh.triangles(), more].concat()).unwrap()
    }

    #[test]
    fn a_sound_mesh_comes_back_as_it_was() {
        for mesh in [
            unit_cube(),
            torus(3.0, 1.0, 20, 10),
            unit_cube().joined(&ball(&Point::new(9.0, 0.0, 0.0), 1.0, 1)),
        ] {
            let (repaired, repairs) = repair(mesh.clone());
            assert_eq!((repaired, repairs), (mesh, Repairs::default()));
        }
    }

    #[test]
    fn a_soup_turned_inside_out_becomes_a_solid() {
        let torus = torus(3.0, 1.0, 20, 10);
        let (repaired, repairs) = repair(soup(&torus.reversed(), |_| Vector::zeros()));
        assert_eq!(
            (repairs.merged_vertices, repairs.flipped_triangles),
            (1200 - 200, 400)
        );
        let volume = Solid::new(repaired).unwrap().mesh().signed_volume_mm3();
        assert!((volume - torus.signed_volume_mm3()).abs() < 1e-12);
    }

    #[test]
    fn seams_a_millionth_apart_are_closed_and_wider_ones_stay_open() {
        let jitter = |size: f64| move |t: usize| Vector::repeat(size * (t % 3) as f64);
        let (repaired, repairs) = repair(soup(&unit_cube(), jitter(1e-7)));
        assert!(Solid::new(repaired).is_ok() && repairs.merged_near_vertices > 0);
        let torn = soup(&unit_cube(), jitter(1e-5));
        let (repaired, repairs) = repair(torn);
        assert!(Solid::new(repaired).is_err());
        assert_eq!(repairs.merged_near_vertices, 0, "{repairs}");
    }

    #[test]
    fn doubled_and_collapsed_triangles_are_dropped() {
        let spoiled = with_triangles(&unit_cube(), &[[0, 4, 6], [6, 0, 4], [1, 1, 2], [5, 5, 5]]);
        let (repaired, repairs) = repair(spoiled);
        assert_eq!(repaired, unit_cube());
        assert_eq!(
            (repairs.dropped_duplicates, repairs.dropped_degenerate),
            (2, 2)
        );
        assert_eq!(
            repairs.to_string(),
            "triangles without area dropped: 2, doubled triangles dropped: 2"
        );
    }

    #[test]
    fn a_hole_is_never_closed() {
        let open = TriMesh::new(
            unit_cube().vertices().to_vec(),
            unit_cube().triangles()[1..].to_vec(),
        )
        .unwrap();
        let (repaired, repairs) = repair(open.clone());
        assert_eq!((repaired, repairs.is_empty()), (open, true));
    }

    #[test]
    fn boxes_that_touch_at_a_corner_come_apart_there() {
        let other = unit_cube().map_vertices(|p| p + Vector::repeat(1.0));
        let (repaired, repairs) = repair(unit_cube().joined(&other));
        assert_eq!((repairs.merged_vertices, repairs.split_vertices), (1, 1));
        assert_eq!(Defects::of(&repaired), None);
    }

    #[test]
    fn unused_vertices_go() {
        let mut vertices = vec![Point::new(9.0, 9.0, 9.0)];
        vertices.extend(unit_cube().vertices());
        let triangles = unit_cube()
            .triangles()
            .iter()
            .map(|t| t.map(|v| v + 1))
            .collect();
        let (repaired, repairs) = repair(TriMesh::new(vertices, triangles).unwrap());
        assert_eq!((repaired, repairs.dropped_vertices), (unit_cube(), 1));
        assert!(repairs.notable().is_empty());
    }

    #[test]
    fn nothing_and_nonsense_come_back() {
        assert!(repair(TriMesh::default()).1.is_empty());
        let nonsense = unit_cube().map_vertices(|p| Point::new(f64::NAN, p.y, f64::INFINITY));
        assert!(Solid::new(repair(nonsense).0).is_err());
    }
}
