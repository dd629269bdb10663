//! The boolean engine finds the same volumes as another engine by other authors.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use equipoise::geom::{Frame, Plane, Point, Vector};
use equipoise::mesh::{Csg, TriMesh, primitives};

/// Greatest relative difference of the volumes. Both engines compute vertices in f64, to about
/// 1e-14 of the coordinates, so bodies with 1e4 vertices agree far better than this. A lost sliver
/// of a triangle (1e-6) does not.
const AGREEMENT_RATIO: f64 = 1e-9;

/// Number of poses tried.
const POSES: u32 = 6;

/// The `index`-th of an even sequence of numbers in 0..1: multiples of a power of the plastic
/// number (Roberts, 2018).
fn even(index: u32, axis: i32) -> f64 {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    (0.5 + f64::from(index) / PLASTIC.powi(axis)).fract()
}

/// Turns and moves a mesh into general position, elsewhere for every index.
fn move_by_index(mesh: &TriMesh, index: u32) -> TriMesh {
    let number = |axis| 2.0 * even(index + 1, axis) - 1.0;
    let direction = Vector::new(number(1), number(2), number(3) + 2.0);
    let shift = Vector::new(number(4), number(5), number(6)) * 9.0;
    let frame = Frame::with_axis(Point::from(shift), &direction);
    mesh.map_vertices(|p| frame.to_model(p))
}

/// Hands a mesh to the other engine.
fn other(mesh: &TriMesh) -> Manifold {
    let positions: Vec<f64> = mesh
        .vertices()
        .iter()
        .flat_map(|p| [p.x, p.y, p.z])
        .collect();
    let corners: Vec<usize> = mesh
        .triangles()
        .iter()
        .flatten()
        .map(|&corner| corner as usize)
        .collect();
    Manifold::new(&positions, &corners).unwrap()
}

/// The volume of the result of the other engine's boolean, mm³.
fn other_volume_mm3(a: &TriMesh, b: &TriMesh, operation: OpType) -> f64 {
    let made = compute_boolean(&other(a), &other(b), operation).unwrap();
    let vertices = made.ps.iter().map(|p| Point::new(p.x, p.y, p.z)).collect();
    let corners: Vec<u32> = made.hs.iter().map(|half| half.tail as u32).collect();
    let triangles = corners
        .chunks_exact(3)
        .map(|t| [t[0], t[1], t[2]])
        .collect();
    TriMesh::new(vertices, triangles)
        .unwrap()
        .signed_volume_mm3()
}

fn volume_mm3(body: &Csg) -> f64 {
    body.to_mesh().unwrap().signed_volume_mm3()
}

fn assert_agree(what: &str, ours: f64, theirs: f64, scale: f64) {
    assert!(
        ours > 1e-3 * scale,
        "{what} is all but empty, which proves nothing"
    );
    assert!(
        (ours - theirs).abs() <= AGREEMENT_RATIO * scale,
        "{what}: {ours} and {theirs} mm³"
    );
}

/// Bodies with flat and round faces, and with a hole.
fn bodies() -> [TriMesh; 3] {
    let half = Vector::new(14.0, 11.0, 17.0);
    [
        primitives::cuboid(&Point::from(-half), &Point::from(half)),
        primitives::ball(&Point::origin(), 15.0, 3),
        primitives::torus(16.0, 6.0, 40, 24),
    ]
}

#[test]
fn another_engine_finds_the_same_volumes_of_booleans() {
    let bodies = bodies();
    for index in 0..POSES {
        let a = move_by_index(&bodies[index as usize % 3], index);
        let b = move_by_index(&bodies[(index as usize + 1) % 3], index + POSES);
        let (ours_a, ours_b) = (Csg::of_mesh(&a).unwrap(), Csg::of_mesh(&b).unwrap());
        let scale = a.signed_volume_mm3();
        let assert_same = |what: &str, ours: Csg, operation: OpType| {
            let theirs = other_volume_mm3(&a, &b, operation);
            assert_agree(what, volume_mm3(&ours), theirs, scale);
        };
        let both = ours_a.intersect(&ours_b).unwrap();
        assert_same("the intersection", both, OpType::Intersect);
        let either = ours_a.union(&ours_b).unwrap();
        assert_same("the union", either, OpType::Add);
        let rest = ours_a.subtract(&ours_b).unwrap();
        assert_same("the difference", rest, OpType::Subtract);
    }
}

#[test]
fn another_engine_cuts_off_the_same_volumes_with_a_large_box() {
    const LARGE_MM: f64 = 200.0;
    for (index, body) in bodies().iter().enumerate() {
        let body = move_by_index(body, index as u32);
        let normal = Vector::new(0.3, -0.5 + 0.4 * index as f64, 0.8).normalize();
        let middle = body.aabb().min + 0.45 * body.aabb().size();
        let (above, below) = Csg::of_mesh(&body)
            .unwrap()
            .split_by_plane(&Plane::through(&middle, &normal))
            .unwrap();
        let on_plane = Frame::with_axis(middle, &normal);
        let corner = Point::new(-LARGE_MM, -LARGE_MM, 0.0);
        let half_space = primitives::cuboid(&corner, &Point::new(LARGE_MM, LARGE_MM, LARGE_MM))
            .map_vertices(|p| on_plane.to_model(p));
        let scale = body.signed_volume_mm3();
        let above_mm3 = other_volume_mm3(&body, &half_space, OpType::Intersect);
        assert_agree("the part above", volume_mm3(&above), above_mm3, scale);
        let below_mm3 = other_volume_mm3(&body, &half_space, OpType::Subtract);
        assert_agree("the part below", volume_mm3(&below), below_mm3, scale);
    }
}
