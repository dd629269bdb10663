//! Repairs that cannot change the shape: weld, drop what has no area, orient, split pinches.

use std::collections::HashSet;
use std::fmt;

use super::orient::{agreeing, outward};
use super::unstitch::unstitched;
use super::weld::{weld, weld_open_edges, without_unused_vertices};
use crate::mesh::TriMesh;
use crate::mesh::edges::{EdgeKind, EdgeTable, edge_kind};
use crate::mesh::fans::Fans;

/// How far apart, relative to the diagonal of the bounding box, two rims may be to be welded. Below
/// about 1e-7 the last digit of a file in single precision keeps seams open; above 1e-5 (1 µm on a
/// 100 mm model) details a printer can show would be drawn together.
const WELD_TOLERANCE_RATIO: f64 = 1e-6;

/// What [`repair`] did to a mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Vertices that lay exactly where another lies, and were merged with it.
    pub merged_vertices: usize,
    /// Vertices on open edges that lay within a millionth of the model's diagonal of another, and
    /// were merged with it.
    pub merged_near_vertices: usize,
    /// Triangles that repeated a corner, and were dropped.
    pub dropped_degenerate: usize,
    /// Triangles that repeated another, and were dropped.
    pub dropped_duplicates: usize,
    /// Triangles turned to face the way their neighbours and the solid do.
    pub flipped_triangles: usize,
    /// Vertices added because a vertex or an edge joined surfaces that only touch there.
    pub split_vertices: usize,
    /// Vertices that no triangle used, and were dropped.
    pub dropped_vertices: usize,
}

impl Repairs {
    /// Whether nothing had to be done.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// What a person should know of: without the merging of equal vertices, which every STL file
    /// needs, and the dropping of unused ones, which no one sees.
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
        let said: Vec<String> = done
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{what}: {count}"))
            .collect();
        if said.is_empty() {
            f.write_str("nothing")
        } else {
            f.write_str(&said.join(", "))
        }
    }
}

/// The mesh with the repairs that keep its shape, and what they were.
///
/// Exactly equal vertices are welded; rims a millionth of the diagonal apart are welded if that
/// closes the mesh; triangles that repeat a corner or another triangle are dropped; neighbours are
/// turned to agree and, when the mesh is closed, outer shells to face outward and cavities inward;
/// a vertex or an edge that joins surfaces which only touch there is doubled; unused vertices go.
/// No hole is filled. A mesh that is already sound comes back as it was. Coordinates never change
/// but for the welding of rims. Linear in the triangles but for one sort.
pub fn repair(mesh: TriMesh) -> (TriMesh, Repairs) {
    let mut repairs = Repairs::default();
    let mesh = merged(mesh, &mut repairs);
    let mesh = closed_along_seams(mesh, &mut repairs);
    let mesh = without_duplicates(mesh, &mut repairs);
    let mesh = without_unused(mesh, &mut repairs);
    let given = mesh.clone();
    let mesh = if has_kind(&mesh, EdgeKind::Misoriented) {
        agreeing(mesh)
    } else {
        mesh
    };
    let mesh = apart(mesh, &mut repairs);
    let mesh = if EdgeTable::of(&mesh).bad_count() == 0 {
        outward(mesh)
    } else {
        mesh
    };
    repairs.flipped_triangles = turned(&given, &mesh);
    (mesh, repairs)
}

fn merged(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let welded = weld(&mesh);
    repairs.merged_vertices = mesh.vertices().len() - welded.vertices().len();
    without_degenerate(welded, repairs)
}

/// Drops the triangles that repeat a corner: they have no area and their sides cancel.
fn without_degenerate(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let sound = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    let triangles: Vec<[u32; 3]> = mesh.triangles().iter().copied().filter(sound).collect();
    repairs.dropped_degenerate += mesh.triangles().len() - triangles.len();
    TriMesh::from_parts(mesh.into_vertices(), triangles)
}

fn has_kind(mesh: &TriMesh, kind: EdgeKind) -> bool {
    EdgeTable::of(mesh).of_kind(kind).next().is_some()
}

/// Welds rims that nearly meet, if that leaves no edge open and none crowded.
fn closed_along_seams(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let tolerance_mm = WELD_TOLERANCE_RATIO * mesh.aabb().size().norm();
    if !tolerance_mm.is_finite() || tolerance_mm <= 0.0 || !has_kind(&mesh, EdgeKind::Open) {
        return mesh;
    }
    let mut tried = *repairs;
    let welded = weld_open_edges(&mesh, tolerance_mm);
    tried.merged_near_vertices = mesh.vertices().len() - welded.vertices().len();
    let welded = without_degenerate(welded, &mut tried);
    let has_two_sides =
        |sides: &[_]| matches!(edge_kind(sides), EdgeKind::Paired | EdgeKind::Misoriented);
    if EdgeTable::of(&welded).edges().all(has_two_sides) {
        *repairs = tried;
        return welded;
    }
    mesh
}

/// Drops triangles that repeat another one's corners in the same turn, if that leaves fewer bad
/// edges.
fn without_duplicates(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
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

/// The same turn of corners, begun at the smallest.
fn smallest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

fn without_unused(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let before = mesh.vertices().len();
    let mesh = without_unused_vertices(mesh);
    repairs.dropped_vertices = before - mesh.vertices().len();
    mesh
}

/// Doubles the vertices and edges at which surfaces only touch, if that leaves every edge with two
/// triangles.
fn apart(mesh: TriMesh, repairs: &mut Repairs) -> TriMesh {
    let table = EdgeTable::of(&mesh);
    if table.bad_count() == 0 && Fans::of(&mesh, &table).pinches(&mesh).is_empty() {
        return mesh;
    }
    match unstitched(&mesh) {
        Some(split) => {
            repairs.split_vertices = split.vertices().len() - mesh.vertices().len();
            split
        }
        None => mesh,
    }
}

/// How many triangles run the other way than given: corners may have new numbers, but keep their
/// places, and turning a triangle swaps its last two.
fn turned(given: &TriMesh, mesh: &TriMesh) -> usize {
    let last = |mesh: &TriMesh, t: usize| mesh.corners(t)[2];
    (0..mesh.triangles().len())
        .filter(|&t| last(given, t) != last(mesh, t))
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

    /// Three own corners for every triangle, moved by `shift(triangle)`.
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
            let (mended, repairs) = repair(mesh.clone());
            assert_eq!((mended, repairs), (mesh, Repairs::default()));
        }
    }

    #[test]
    fn a_soup_turned_inside_out_becomes_a_solid() {
        let torus = torus(3.0, 1.0, 20, 10);
        let (mended, repairs) = repair(soup(&torus.reversed(), |_| Vector::zeros()));
        assert_eq!(
            (repairs.merged_vertices, repairs.flipped_triangles),
            (1200 - 200, 400)
        );
        let volume = Solid::new(mended).unwrap().mesh().signed_volume_mm3();
        assert!((volume - torus.signed_volume_mm3()).abs() < 1e-12);
    }

    #[test]
    fn seams_a_millionth_apart_are_closed_and_wider_ones_stay_open() {
        let jitter = |size: f64| move |t: usize| Vector::repeat(size * (t % 3) as f64);
        let (mended, repairs) = repair(soup(&unit_cube(), jitter(1e-7)));
        assert!(Solid::new(mended).is_ok() && repairs.merged_near_vertices > 0);
        let torn = soup(&unit_cube(), jitter(1e-5));
        let (mended, repairs) = repair(torn);
        assert!(Solid::new(mended).is_err());
        assert_eq!(repairs.merged_near_vertices, 0, "{repairs}");
    }

    #[test]
    fn doubled_and_collapsed_triangles_are_dropped() {
        let spoilt = with_triangles(&unit_cube(), &[[0, 4, 6], [6, 0, 4], [1, 1, 2], [5, 5, 5]]);
        let (mended, repairs) = repair(spoilt);
        assert_eq!(mended, unit_cube());
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
        let (mended, repairs) = repair(open.clone());
        assert_eq!((mended, repairs.is_empty()), (open, true));
    }

    #[test]
    fn boxes_that_touch_at_a_corner_come_apart_there() {
        let other = unit_cube().map_vertices(|p| p + Vector::repeat(1.0));
        let (mended, repairs) = repair(unit_cube().joined(&other));
        assert_eq!((repairs.merged_vertices, repairs.split_vertices), (1, 1));
        assert_eq!(Defects::of(&mended), None);
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
        let (mended, repairs) = repair(TriMesh::new(vertices, triangles).unwrap());
        assert_eq!((mended, repairs.dropped_vertices), (unit_cube(), 1));
        assert!(repairs.notable().is_empty());
    }

    #[test]
    fn nothing_and_nonsense_come_back() {
        assert!(repair(TriMesh::default()).1.is_empty());
        let nonsense = unit_cube().map_vertices(|p| Point::new(f64::NAN, p.y, f64::INFINITY));
        assert!(Solid::new(repair(nonsense).0).is_err());
    }
}
