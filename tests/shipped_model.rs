//! The shipped model is as the documentation describes it.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::path::Path;

use equipoise::geom::{Point, Vector};
use equipoise::io::read_model;
use equipoise::mass::{Body, moments_of_mesh};
use equipoise::mesh::{MeshFacts, Solid, TriMesh};
use equipoise::repair::weld;

fn read_shipped() -> TriMesh {
    weld(&read_model(Path::new(common::ELLIPSOID)).unwrap())
}

#[test]
fn the_shipped_model_is_a_sound_solid_of_one_hundred_millimetres() {
    let solid = Solid::new(read_shipped()).unwrap();
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
fn a_solid_shipped_model_does_not_spin_upright_on_its_lowest_point() {
    let mesh = read_shipped();
    let lower = |a: Point, b: Point| if b.z < a.z { b } else { a };
    let contact = mesh.vertices().iter().copied().reduce(lower).unwrap();
    let body = Body::new(&moments_of_mesh(&mesh), 1.0);
    // Its centre is beside the axis, and the moment about the axis is not the largest.
    assert!(body.axis_offset_mm(&contact, &Vector::z()) > 3.0);
    let about_axis = body.inertia_g_mm2[(2, 2)];
    assert!(body.principal().moments_g_mm2[2] > 1.05 * about_axis);
    let across = body.inertia_g_mm2.fixed_view::<2, 2>(0, 0);
    assert!(across.symmetric_eigenvalues().max() > 1.05 * about_axis);
}

#[test]
fn the_lowest_point_of_the_shipped_model_is_a_single_vertex() {
    let mesh = read_shipped();
    let lowest = mesh.aabb().min.z;
    let contacts: Vec<&Point> = mesh
        .vertices()
        .iter()
        .filter(|p| p.z < lowest + 1e-3)
        .collect();
    assert_eq!(contacts.len(), 1);
    // Its neighbours are one edge e = 4 mm away, so e²/2R above it: some 0.2 mm.
    let next = mesh
        .vertices()
        .iter()
        .map(|p| p.z)
        .filter(|&z| z > lowest)
        .fold(f64::INFINITY, f64::min);
    assert!(next - lowest > 0.05, "{}", next - lowest);
}
