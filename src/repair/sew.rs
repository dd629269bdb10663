//! Sewing: joins pieces that lie rim to rim, even if one rim has a corner that the other lacks.

use super::weld::weld_open_edges;
use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::mesh::edges::{EdgeKind, EdgeTable, Side};

/// Joins rims that lie on each other. Corners on rims within `tolerance_mm` of each other become
/// one. An edge of a rim that passes within `tolerance_mm` of corners of a rim is divided at them.
///
/// The surface moves by no more than the tolerance. A rim without a counterpart stays open: the
/// caller judges the result.
#[must_use]
pub(crate) fn sew(mesh: &TriMesh, tolerance_mm: f64) -> TriMesh {
    let mut mesh = weld_open_edges(mesh, tolerance_mm);
    while let Some(divided) = divide_open_edges(&mesh, tolerance_mm) {
        mesh = divided;
    }
    mesh
}

/// Divides open edges at the corners of rims that lie on them, one edge of a triangle at a time.
/// `None` if there is nothing to divide.
fn divide_open_edges(mesh: &TriMesh, tolerance_mm: f64) -> Option<TriMesh> {
    let table = EdgeTable::of(mesh);
    let open: Vec<Side> = table
        .of_kind(EdgeKind::Open)
        .map(|sides| sides[0])
        .collect();
    let mut rim: Vec<u32> = open.iter().flat_map(|side| [side.low, side.high]).collect();
    rim.sort_unstable();
    rim.dedup();
    let mut triangles = mesh.triangles().to_vec();
    let mut is_done = vec![false; triangles.len()];
    for side in &open {
        let [from, to, apex] = corners_from(mesh, side);
        let between = corners_between(mesh, &rim, [from, to], tolerance_mm);
        if between.is_empty() || std::mem::replace(&mut is_done[side.triangle()], true) {
            continue;
        }
        triangles[side.triangle()] = [from, between[0], apex];
        let ends = between.iter().skip(1).chain([&to]);
        triangles.extend(
            between
                .iter()
                .zip(ends)
                .map(|(&start, &end)| [start, end, apex]),
        );
    }
    let is_divided = triangles.len() > mesh.triangles().len();
    is_divided.then(|| TriMesh::from_parts(mesh.vertices().to_vec(), triangles))
}

/// Returns the corners of the side's triangle, those of the side first.
fn corners_from(mesh: &TriMesh, side: &Side) -> [u32; 3] {
    let corners = mesh.triangles()[side.triangle()];
    [0, 1, 2].map(|step| corners[(side.id as usize + step) % 3])
}

/// Returns the rim's corners that lie on an edge but not at its ends, in their order along it.
fn corners_between(
    mesh: &TriMesh,
    rim: &[u32],
    [from, to]: [u32; 2],
    tolerance_mm: f64,
) -> Vec<u32> {
    let place = |v: u32| mesh.vertices()[v as usize];
    let (start, along) = (place(from), place(to) - place(from));
    let share = |p: &Point| (p - start).dot(&along) / along.norm_squared();
    let is_between = |&v: &u32| {
        let p = place(v);
        let off_line = (p - (start + along * share(&p))).norm();
        let from_ends = (p - start).norm().min((p - place(to)).norm());
        v != from
            && v != to
            && (0.0..1.0).contains(&share(&p))
            && off_line <= tolerance_mm
            && from_ends > tolerance_mm
    };
    let mut found: Vec<u32> = rim.iter().copied().filter(is_between).collect();
    found.sort_by(|&a, &b| share(&place(a)).total_cmp(&share(&place(b))));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Solid, primitives::cuboid};

    /// A box without the triangles that lie in a plane across z.
    fn without_face(min: [f64; 3], max: [f64; 3], z: f64) -> TriMesh {
        let mesh = cuboid(&Point::from(min), &Point::from(max));
        let is_kept = |t: &&[u32; 3]| t.iter().any(|&v| mesh.vertices()[v as usize].z != z);
        let triangles = mesh.triangles().iter().filter(is_kept).copied().collect();
        TriMesh::new(mesh.vertices().to_vec(), triangles).unwrap()
    }

    #[test]
    fn a_box_sewn_of_one_below_and_two_above_is_a_solid_of_their_volume() {
        // The rims of the upper two have corners in the middle of the lower one's edges.
        // The wall between them is double.
        let below = without_face([0.0; 3], [2.0, 1.0, 1.0], 1.0);
        let open_wall = |mesh: TriMesh| {
            let is_kept = |t: &&[u32; 3]| t.iter().any(|&v| mesh.vertices()[v as usize].x != 1.0);
            TriMesh::new(
                mesh.vertices().to_vec(),
                mesh.triangles().iter().filter(is_kept).copied().collect(),
            )
            .unwrap()
        };
        let left = open_wall(without_face([0.0, 0.0, 1.0], [1.0, 1.0, 2.0], 1.0));
        let right = open_wall(without_face([1.0, 0.0, 1.0], [2.0, 1.0, 2.0], 1.0));
        let jitter = |p: &Point| p + crate::geom::Vector::new(1e-12, 0.0, -1e-12);
        let sewn = Solid::new(sew(
            &below.joined(&left.map_vertices(jitter)).joined(&right),
            1e-9,
        ))
        .unwrap();
        assert!((sewn.mesh().signed_volume_mm3() - 4.0).abs() < 1e-9);
    }

    #[test]
    fn a_rim_without_a_counterpart_stays_open() {
        let open = without_face([0.0; 3], [1.0; 3], 1.0);
        assert_eq!(sew(&open, 1e-9), open);
    }
}
