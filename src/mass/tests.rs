//! The moments against closed forms, and their laws under motion, mirroring, scaling and addition.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::{Body, ImpossibleBody, Moments, moments_of_mesh};
use crate::geom::{Frame, Matrix, Point, Vector};
use crate::mesh::primitives::{ball, cuboid, cylinder, ellipsoid, torus};
use crate::mesh::{TriMesh, surface_mm2};

/// Returns the largest difference of two sets of moments. Each is relative to the moment that a
/// body of this volume could have at this distance from the origin: V, V·L, V·L².
fn difference(a: &Moments, b: &Moments, reach_mm: f64) -> f64 {
    let scale = |i: usize| a.volume().abs() * reach_mm.powi([0, 1, 1, 1, 2, 2, 2, 2, 2, 2][i]);
    (0..Moments::COUNT)
        .map(|i| (a.0[i] - b.0[i]).abs() / scale(i))
        .fold(0.0, f64::max)
}

/// Rounding of a few hundred compensated sums and a handful of products: some units in the 16th
/// digit.
const ROUNDING: f64 = 1e-13;

/// Returns the distance of the farthest vertex from the origin, mm.
fn reach_mm(mesh: &TriMesh) -> f64 {
    mesh.vertices()
        .iter()
        .map(|p| p.coords.norm())
        .fold(0.0, f64::max)
}

/// Returns the inertia of a body of unit density about its centre, along the axes of the model.
fn inertia(mesh: &TriMesh) -> Matrix {
    Body::new(&moments_of_mesh(mesh), 1.0).inertia_g_mm2
}

/// Returns the order of convergence: the power of two by which the error shrinks when the mesh gets
/// twice as fine.
fn order(coarse: f64, fine: f64, exact: f64) -> f64 {
    ((coarse - exact) / (fine - exact)).log2()
}

#[test]
fn a_body_gives_back_its_moments_and_impossible_tensors_are_refused_by_name() {
    let mesh = cuboid(&Point::new(1.0, -2.0, 3.0), &Point::new(5.0, 4.0, 4.5));
    let moments = moments_of_mesh(&mesh);
    let body = Body::new(&moments, 1.2e-3);
    for (got, want) in body.moments(1.2e-3).unwrap().0.iter().zip(moments.0) {
        assert!((got - want).abs() < 1e-10 * want.abs(), "{got} {want}");
    }
    let tensor = Matrix::from_diagonal(&Vector::new(1.0, 2.0, 3.5));
    let long = Body {
        inertia_g_mm2: tensor,
        ..body
    };
    let refused = long.moments(1.0).unwrap_err();
    assert!(
        refused.to_string().contains("triangle inequality"),
        "{refused}"
    );
    let light = Body {
        mass_g: -1.0,
        ..body
    };
    assert_eq!(light.moments(1.0), Err(ImpossibleBody::Mass(-1.0)));
}

#[test]
fn a_box_has_the_moments_of_the_textbook_to_the_last_digits() {
    let mesh = cuboid(&Point::new(1.0, -2.0, 5.0), &Point::new(4.0, 2.0, 10.0));
    let body = Body::new(&moments_of_mesh(&mesh), 0.5);
    assert!((body.mass_g - 30.0).abs() < 30.0 * ROUNDING);
    assert!((body.center - Point::new(2.5, 0.0, 7.5)).norm() < 10.0 * ROUNDING);
    let [a2, b2, c2] = [9.0, 16.0, 25.0];
    let exact = Matrix::from_diagonal(&Vector::new(b2 + c2, a2 + c2, a2 + b2)) * (30.0 / 12.0);
    assert!((body.inertia_g_mm2 - exact).amax() < exact.amax() * ROUNDING);
}

#[test]
fn the_moments_of_a_tetrahedron_are_those_of_its_closed_form() {
    // ∫xⁱyʲzᵏ over the corner tetrahedron is i! j! k! / (i + j + k + 3)!.
    let corners = vec![
        Point::origin(),
        Point::new(1.0, 0.0, 0.0),
        Point::new(0.0, 1.0, 0.0),
        Point::new(0.0, 0.0, 1.0),
    ];
    let mesh = TriMesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).unwrap();
    let [v, first, product, square] = [1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 60.0];
    let exact = Moments([
        v, first, first, first, product, product, product, square, square, square,
    ]);
    assert!(difference(&exact, &moments_of_mesh(&mesh), 1.0) < ROUNDING);
}

#[test]
fn balls_converge_with_the_square_of_the_edge() {
    let (r, center) = (3.0_f64, Point::new(1.0, 2.0, 3.0));
    let [coarse, fine] = [3, 4].map(|level| ball(&center, r, level));
    let volume = 4.0 / 3.0 * PI * r.powi(3);
    let moment = 0.4 * volume * r * r;
    let volumes = [&coarse, &fine].map(|mesh| moments_of_mesh(mesh).volume());
    assert!((order(volumes[0], volumes[1], volume) - 2.0).abs() < 0.02);
    assert!((order(inertia(&coarse)[(0, 0)], inertia(&fine)[(0, 0)], moment) - 2.0).abs() < 0.02);
    // An icosphere has the symmetry of the icosahedron, so every axis through the centre is
    // principal.
    assert!(
        (inertia(&fine) - Matrix::identity() * inertia(&fine)[(2, 2)]).amax() < moment * ROUNDING
    );
    assert!((moments_of_mesh(&fine).centroid() - center).norm() < reach_mm(&fine) * ROUNDING);
}

#[test]
fn ellipsoids_are_stretched_balls_to_the_last_digits() {
    let axes = Vector::new(1.0, 2.0, 4.0);
    let [round, long] = [
        ball(&Point::origin(), 1.0, 3),
        ellipsoid(&Point::origin(), &axes, 3),
    ]
    .map(|m| moments_of_mesh(&m));
    let stretched = Moments::from_parts(
        round.volume() * axes.product(),
        &Vector::zeros(),
        &(Matrix::from_diagonal(&axes)
            * round.second()
            * Matrix::from_diagonal(&axes)
            * axes.product()),
    );
    assert!(difference(&stretched, &long, 4.0) < ROUNDING);
    let exact = 4.0 / 15.0 * PI * axes.product() * (axes.x * axes.x + axes.y * axes.y);
    let [coarse, fine] =
        [3, 4].map(|level| inertia(&ellipsoid(&Point::origin(), &axes, level))[(2, 2)]);
    assert!((order(coarse, fine, exact) - 2.0).abs() < 0.02);
}

#[test]
fn cylinders_equal_their_prisms_and_converge_with_the_square_of_the_edge() {
    let (r, h) = (2.0_f64, 5.0_f64);
    let meshes = [40, 80].map(|segments| cylinder(r, h, segments));
    // Regular polygon of n sides: area n r² sin(2π/n)/2, polar second moment A r² (2 +
    // cos(2π/n))/6.
    for (mesh, n) in meshes.iter().zip([40.0, 80.0]) {
        let step = 2.0 * PI / n;
        let volume = h * n * r * r * step.sin() / 2.0;
        let about_axis = volume * r * r * (2.0 + step.cos()) / 6.0;
        let across = about_axis / 2.0 + volume * h * h / 12.0;
        let exact = Matrix::from_diagonal(&Vector::new(across, across, about_axis));
        assert!((inertia(mesh) - exact).amax() < across * ROUNDING);
    }
    let exact = PI * r.powi(4) * h / 2.0;
    let [coarse, fine] = meshes.map(|mesh| inertia(&mesh)[(2, 2)]);
    assert!((order(coarse, fine, exact) - 2.0).abs() < 0.02);
}

#[test]
fn tori_converge_with_the_square_of_the_edge() {
    let (ring, tube) = (5.0_f64, 2.0_f64);
    let volume = 2.0 * PI * PI * ring * tube * tube;
    let about_axis = volume * (ring * ring + 0.75 * tube * tube);
    let across = volume * (0.5 * ring * ring + 0.625 * tube * tube);
    let [coarse, fine] = [1, 2].map(|k| inertia(&torus(ring, tube, 60 * k, 40 * k)));
    for (axis, exact) in [(0, across), (1, across), (2, about_axis)] {
        assert!((order(coarse[(axis, axis)], fine[(axis, axis)], exact) - 2.0).abs() < 0.05);
        assert!((fine[(axis, axis)] / exact - 1.0).abs() < 0.01);
    }
}

#[test]
fn principal_moments_come_ascending_with_their_axes() {
    let frame = Frame::with_axis(Point::new(7.0, 8.0, 9.0), &Vector::new(1.0, 2.0, 3.0));
    let mesh = cuboid(&Point::new(-1.0, -2.0, -3.0), &Point::new(1.0, 2.0, 3.0));
    let body = Body::new(
        &moments_of_mesh(&mesh.map_vertices(|p| frame.to_model(p))),
        1.0,
    );
    let principal = body.principal();
    // m (b² + c²)/3 for half sides. The box is longest along its z axis, which has the least
    // moment.
    for (found, exact) in principal
        .moments_g_mm2
        .iter()
        .zip([5.0, 10.0, 13.0].map(|s| 48.0 * s / 3.0))
    {
        assert!((found / exact - 1.0).abs() < 1e-12);
    }
    assert!((principal.axes.column(0).dot(&frame.axis()).abs() - 1.0).abs() < 1e-12);
    assert!((principal.axes.column(2).dot(&frame.axes.column(0)).abs() - 1.0).abs() < 1e-12);
    assert!(body.axis_offset_mm(&frame.origin, &frame.axis()) < 1e-12);
    assert!((body.in_frame(&frame).inertia_g_mm2 - inertia(&mesh)).amax() < 208.0 * 1e-12);
}

fn vector(size: f64) -> impl Strategy<Value = Vector> {
    [-size..size, -size..size, -size..size].prop_map(Vector::from)
}

/// Any proper rotation, from a quaternion that is not zero.
fn rotation() -> impl Strategy<Value = Matrix> {
    let quaternion =
        [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64].prop_map(nalgebra::Vector4::from);
    quaternion
        .prop_filter("not zero", |q| q.norm() > 0.1)
        .prop_map(|q| {
            nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::from(q))
                .to_rotation_matrix()
                .into_inner()
        })
}

/// A body without symmetry: an ellipsoid with a box beside it, rotated and moved.
fn body() -> impl Strategy<Value = TriMesh> {
    (vector(3.0), rotation(), vector(20.0)).prop_map(|(sides, turn, shift)| {
        let sides = sides.map(|s| 0.5 + s.abs());
        let box_beside = cuboid(
            &Point::new(4.0, 0.0, 0.0),
            &(Point::new(4.0, 0.0, 0.0) + sides.yzx()),
        );
        let both = ellipsoid(&Point::origin(), &sides, 1).joined(&box_beside);
        both.map_vertices(|p| turn * p + shift)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn moving_the_mesh_moves_the_moments(mesh in body(), shift in vector(50.0)) {
        let moved = mesh.map_vertices(|p| p + shift);
        let expected = moments_of_mesh(&mesh).translated(&shift);
        let reach = reach_mm(&mesh) + shift.norm();
        prop_assert!(difference(&expected, &moments_of_mesh(&moved), reach) < ROUNDING);
    }

    #[test]
    fn turning_the_mesh_turns_the_moments(mesh in body(), turn in rotation()) {
        let turned = moments_of_mesh(&mesh.map_vertices(|p| turn * p));
        let expected = moments_of_mesh(&mesh).rotated(&turn);
        prop_assert!(difference(&expected, &turned, reach_mm(&mesh)) < ROUNDING);
    }

    #[test]
    fn a_mirror_image_has_the_mirrored_moments(mesh in body(), normal in vector(1.0)) {
        prop_assume!(normal.norm() > 0.1);
        let normal = normal.normalize();
        let mirror = Matrix::identity() - normal * normal.transpose() * 2.0;
        let image = mesh.map_vertices(|p| mirror * p).reversed();
        let expected = moments_of_mesh(&mesh).rotated(&mirror);
        prop_assert!(difference(&expected, &moments_of_mesh(&image), reach_mm(&mesh)) < ROUNDING);
    }

    #[test]
    fn scaling_the_mesh_scales_the_moments(mesh in body(), factor in 0.01..100.0f64) {
        let scaled = crate::mesh::scaled(&mesh, factor);
        let expected = moments_of_mesh(&mesh).scaled(factor);
        let reach = reach_mm(&scaled);
        prop_assert!(difference(&expected, &moments_of_mesh(&scaled), reach) < ROUNDING);
    }

    #[test]
    fn moments_add_and_an_inverted_body_subtracts(a in body(), b in body()) {
        let [ma, mb] = [&a, &b].map(moments_of_mesh);
        let farthest = reach_mm(&a).max(reach_mm(&b));
        let reach = farthest * (1.0 + (mb.volume() / ma.volume()).max(1.0));
        let joined = a.clone().joined(&b);
        // Pyramids over the middle of small bodies far apart hold far more than these do.
        let height = joined.aabb().size().norm() / 2.0;
        let pyramids = surface_mm2(&joined) * height / 3.0 / (ma + mb).volume();
        let both = moments_of_mesh(&joined);
        prop_assert!(difference(&(ma + mb), &both, reach) < ROUNDING * pyramids.max(1.0));
        let nothing = moments_of_mesh(&a.clone().joined(&a.reversed()));
        prop_assert!(difference(&ma, &(nothing + ma), reach) < ROUNDING);
    }

    #[test]
    fn moments_in_a_frame_equal_those_of_the_mesh_moved_into_it(
        mesh in body(), origin in vector(10.0), turn in rotation()
    ) {
        let frame = Frame { origin: Point::from(origin), axes: turn };
        let seen = moments_of_mesh(&mesh).in_frame(&frame);
        let reach = reach_mm(&mesh) + origin.norm();
        prop_assert!(difference(&seen, &moments_of_mesh(&mesh.in_frame(&frame)), reach) < ROUNDING);
        let back = seen.from_frame(&frame);
        prop_assert!(difference(&moments_of_mesh(&mesh), &back, reach) < ROUNDING);
    }

    #[test]
    fn the_principal_moments_do_not_depend_on_the_pose(
        mesh in body(), turn in rotation(), shift in vector(10.0)
    ) {
        let principal = |mesh: &TriMesh| {
            let body = Body::new(&moments_of_mesh(mesh), 1.0);
            body.principal().moments_g_mm2
        };
        let (still, moved) = (
            principal(&mesh),
            principal(&mesh.map_vertices(|p| turn * p + shift)),
        );
        // The tensor about the centre is a difference of tensors about the origin, larger by
        // (reach/size)².
        let lost = ROUNDING * (1.0 + reach_mm(&mesh).powi(2));
        for (a, b) in still.iter().zip(moved) {
            prop_assert!((a - b).abs() < lost * still[2]);
        }
    }
}
