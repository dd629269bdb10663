use super::*;
use crate::geom::{Point, Vector};
use crate::mesh::primitives::{ball, cuboid, torus};
use crate::mesh::{Defects, Solid};

fn mend(mesh: TriMesh) -> (TriMesh, Repairs) {
    repair(mesh, &Watch::silent()).unwrap()
}

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
        let (repaired, repairs) = mend(mesh.clone());
        assert_eq!((repaired, repairs), (mesh, Repairs::default()));
    }
}

#[test]
fn a_soup_turned_inside_out_becomes_a_solid() {
    let torus = torus(3.0, 1.0, 20, 10);
    let (repaired, repairs) = mend(soup(&torus.reversed(), |_| Vector::zeros()));
    assert_eq!(
        (repairs.merged_vertices, repairs.flipped_triangles),
        (1200 - 200, 400)
    );
    let volume = Solid::new(repaired).unwrap().mesh().signed_volume_mm3();
    assert!((volume - torus.signed_volume_mm3()).abs() < 1e-12);
}

#[test]
fn seams_a_millionth_apart_are_closed_and_those_within_the_limit_are_stitched() {
    let jitter = |size: f64| move |t: usize| Vector::repeat(size * (t % 3) as f64);
    let (repaired, repairs) = mend(soup(&unit_cube(), jitter(1e-7)));
    assert!(Solid::new(repaired).is_ok() && repairs.merged_near_vertices > 0);
    let (repaired, repairs) = mend(soup(&unit_cube(), jitter(4e-6)));
    let volume = Solid::new(repaired).unwrap().mesh().signed_volume_mm3();
    assert!(
        (volume - 1.0).abs() < 1e-4 && repairs.stitched_edges > 0,
        "{repairs}"
    );
    // No place moved by more than the jitter of 8e-6·√3, over the diagonal of √3.
    assert!(
        repairs.stitched_ratio > 0.0 && repairs.stitched_ratio <= 8e-6 * (1.0 + 1e-3),
        "{repairs}"
    );
    let (repaired, repairs) = mend(soup(&unit_cube(), jitter(1e-3)));
    assert!(Solid::new(repaired).is_err());
    assert_eq!(
        (repairs.stitched_edges, repairs.filled_holes),
        (0, 0),
        "{repairs}"
    );
}

#[test]
fn boxes_that_overlap_are_united_even_if_one_of_them_is_open() {
    let other = cuboid(&Point::new(0.5, 0.25, 0.25), &Point::new(1.5, 0.75, 0.75));
    // The open side lies inside the other box.
    let is_kept = |t: &&[u32; 3]| t.iter().any(|&v| other.vertices()[v as usize].x > 0.5);
    let triangles = other.triangles().iter().filter(is_kept).copied().collect();
    let open = TriMesh::new(other.vertices().to_vec(), triangles).unwrap();
    let (repaired, repairs) = mend(unit_cube().joined(&open));
    assert!((repaired.signed_volume_mm3() - 1.125).abs() < 1e-9);
    assert_eq!((repairs.filled_holes, repairs.united_shells), (1, 2));
    assert_eq!(mend(repaired.clone()), (repaired, Repairs::default()));
}

#[test]
fn doubled_and_collapsed_triangles_are_dropped() {
    let spoiled = with_triangles(&unit_cube(), &[[0, 4, 6], [6, 0, 4], [1, 1, 2], [5, 5, 5]]);
    let (repaired, repairs) = mend(spoiled);
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
fn a_hole_is_closed_and_told() {
    let open = TriMesh::new(
        unit_cube().vertices().to_vec(),
        unit_cube().triangles()[1..].to_vec(),
    )
    .unwrap();
    let (repaired, repairs) = mend(open);
    assert_eq!(repaired.signed_volume_mm3(), 1.0);
    assert_eq!(repairs.filled_holes, 1);
    // Half a side of eleven halves.
    assert!((repairs.filled_area_ratio - 1.0 / 11.0).abs() < 1e-12);
    let said = repairs.notable().to_string();
    assert!(
        said.contains("1 hole filled") && said.contains("nothing moved"),
        "{said}"
    );
}

#[test]
fn boxes_that_touch_at_a_corner_come_apart_there() {
    let other = unit_cube().map_vertices(|p| p + Vector::repeat(1.0));
    let (repaired, repairs) = mend(unit_cube().joined(&other));
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
    let (repaired, repairs) = mend(TriMesh::new(vertices, triangles).unwrap());
    assert_eq!((repaired, repairs.dropped_vertices), (unit_cube(), 1));
    assert!(repairs.notable().is_empty());
}

#[test]
fn nothing_and_nonsense_come_back() {
    assert!(mend(TriMesh::default()).1.is_empty());
    let nonsense = unit_cube().map_vertices(|p| Point::new(f64::NAN, p.y, f64::INFINITY));
    assert!(Solid::new(mend(nonsense).0).is_err());
}

#[test]
fn a_ring_whose_spike_pierces_its_other_side_is_resolved_and_told() {
    let ring = torus(3.0, 1.0, 24, 12);
    let inner = |a: &&Point, b: &&Point| {
        let away = |p: &Point| (p - Point::new(2.0, 0.0, 0.0)).norm();
        away(a).total_cmp(&away(b))
    };
    let place = *ring.vertices().iter().min_by(inner).unwrap();
    let tip = Point::new(-2.6, 0.13, 0.07);
    let spiked = ring.map_vertices(|p| if *p == place { tip } else { *p });
    let (repaired, repairs) = mend(spiked.clone());
    let solid = Solid::new(repaired.clone()).unwrap();
    assert_eq!(crate::mesh::Crossings::of(solid.mesh()).pairs, 0);
    // The tip lies inside the ring, and no more counts twice.
    let doubled = spiked.signed_volume_mm3() - solid.mesh().signed_volume_mm3();
    assert!(doubled > 0.0 && doubled < 0.1, "{doubled}");
    assert!(
        repairs.untangled_pairs > 0 && repairs.untangled_ratio < 1e-6,
        "{repairs:?}"
    );
    let said = repairs.notable().to_string();
    assert!(
        said.contains("crossings of the surface with itself resolved"),
        "{said}"
    );
    assert_eq!(mend(repaired.clone()), (repaired, Repairs::default()));
}
