//! The model that is shipped is what the documentation says of it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use equipoise::geom::{Point, Vector};
use equipoise::io::read_model;
use equipoise::mass::{Body, moments_of_mesh};
use equipoise::mesh::{MeshFacts, Solid, TriMesh};
use equipoise::repair::weld;

fn shipped() -> TriMesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models/tilted-ellipsoid.stl");
    weld(&read_model(&path).unwrap())
}

#[test]
fn the_shipped_model_is_a_sound_solid_of_one_hundred_millimetres() {
    let solid = Solid::new(shipped()).unwrap();
    let facts = MeshFacts::of(solid.mesh());
    assert_eq!(
        (facts.shells, facts.genus, facts.degenerate_triangles),
        (1, Some(0), 0)
    );
    assert!(facts.pinch_vertices.is_empty() && facts.crossings.unwrap().pairs == 0);
    // Coordinates are rounded to single precision: 4e-6 mm at 50 mm.
    assert!((facts.size_mm.max() - 100.0).abs() < 1e-5);
}

#[test]
fn the_shipped_model_does_not_spin_upright_on_its_lowest_point_as_a_solid() {
    let mesh = shipped();
    let contact = mesh
        .vertices()
        .iter()
        .copied()
        .reduce(|a, b| if b.z < a.z { b } else { a })
        .unwrap();
    let body = Body::new(&moments_of_mesh(&mesh), 1.0);
    // Its centre lies beside the axis, and the moment about the axis is not the largest.
    assert!(body.axis_offset_mm(&contact, &Vector::z()) > 3.0);
    let about_axis = body.inertia_g_mm2[(2, 2)];
    assert!(body.principal().moments_g_mm2[2] > 1.05 * about_axis);
    assert!(
        body.inertia_g_mm2
            .fixed_view::<2, 2>(0, 0)
            .symmetric_eigenvalues()
            .max()
            > 1.05 * about_axis
    );
}

#[test]
fn the_lowest_point_of_the_shipped_model_is_one_vertex_where_the_ellipsoid_is_lowest() {
    let mesh = shipped();
    let lowest = mesh.aabb().min.z;
    let contacts: Vec<&Point> = mesh
        .vertices()
        .iter()
        .filter(|p| p.z < lowest + 1e-3)
        .collect();
    assert_eq!(contacts.len(), 1);
    // Its neighbours lie one edge (4 mm) off: e²/2R above it, some 0.2 mm, not level with it.
    let next = mesh
        .vertices()
        .iter()
        .map(|p| p.z)
        .filter(|&z| z > lowest)
        .fold(f64::INFINITY, f64::min);
    assert!(next - lowest > 0.05, "{}", next - lowest);
}
