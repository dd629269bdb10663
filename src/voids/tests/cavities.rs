//! Tests of the cavity: its shape, its wall and its errors.

use super::*;

#[test]
fn parts_near_points_are_the_bodies_that_hold_them_or_the_nearest() {
    // The cavity of a U with two arms, each 10 mm wide, 10 mm apart. A box about both arms holds a
    // body of each.
    let arms = [
        [0, 1, 0],
        [0, 2, 0],
        [0, 3, 0],
        [2, 1, 0],
        [2, 2, 0],
        [2, 3, 0],
    ];
    let u = cells(
        &[&[[0, 0, 0], [1, 0, 0], [2, 0, 0]][..], &arms].concat(),
        10.0,
    );
    let cavity = cavity_of(u.mesh(), &spec(1.0, &[]));
    let about = |places: &[(Point, Aabb)]| cavity.parts_near(places).unwrap();
    let upper = Aabb {
        min: Point::new(-5.0, 20.0, -5.0),
        max: Point::new(35.0, 50.0, 15.0),
    };
    let left = about(&[(Point::new(5.0, 30.0, 5.0), upper)]);
    let arm_mm3 = 8.0 * 19.0 * 8.0;
    assert!(
        (signed_volume(&left) / arm_mm3 - 1.0).abs() < 0.01,
        "{}",
        signed_volume(&left)
    );
    assert!(left.aabb().max.x < 10.0);
    // A point in the wall of the other arm.
    let right = about(&[(Point::new(29.5, 30.0, 5.0), upper)]);
    assert!(right.aabb().min.x > 20.0);
    let both = about(&[
        (Point::new(5.0, 30.0, 5.0), upper),
        (Point::new(25.0, 30.0, 5.0), upper),
    ]);
    assert!((signed_volume(&both) - signed_volume(&left) - signed_volume(&right)).abs() < 1e-6);
    let nowhere = Aabb {
        min: Point::new(12.0, 20.0, 0.0),
        max: Point::new(18.0, 30.0, 9.0),
    };
    assert!(
        about(&[(Point::new(15.0, 25.0, 5.0), nowhere)])
            .triangles()
            .is_empty()
    );
}

#[test]
fn the_cavity_of_a_ball_is_a_ball() {
    let center = Point::new(1.0, 2.0, 3.0);
    let model = ball(center, 5.0, 5);
    let cavity = sound_cavity(&model, &spec(1.0, &[]));
    // The model's own facets lie up to r θ²/8 = 0.004 mm inside the ball of radius 5 (θ =
    // 90°/32 … 1.4 × that).
    for p in samples(cavity.mesh()) {
        let radius = (p - center).norm();
        assert!(
            (3.985 - TOLERANCE_MM..=4.0 + TOLERANCE_MM).contains(&radius),
            "{radius}"
        );
    }
}

#[test]
fn the_cavity_of_a_box_is_a_box_with_flat_faces_and_slightly_chamfered_edges() {
    let cavity = sound_cavity(&block([0.0; 3], [8.0, 7.0, 6.0]), &spec(1.0, &[]));
    let inner = MeshDistance::new(&block([1.0; 3], [7.0, 6.0, 5.0]));
    let depths: Vec<f64> = samples(cavity.mesh())
        .iter()
        .map(|p| inner.signed(p))
        .collect();
    assert!(depths.iter().all(|&d| d > -0.01 && d < 0.25), "{depths:?}");
    let volume = signed_volume(cavity.mesh());
    // 6·5·4 mm³, less chamfered edges (60 mm of them, at most 0.4²/2 mm² each) and faces drawn
    // 0.006 mm deeper.
    assert!(
        volume < 120.0 && volume > 120.0 - 60.0 * 0.08 - 148.0 * 0.021,
        "{volume}"
    );
}

#[test]
fn the_wall_is_kept_along_an_inward_edge() {
    let model = prism(
        &[[4.0, 4.0], [0.0, 4.0], [0.0, 0.0], [8.0, 0.0], [8.0, 4.0]],
        6.0,
    );
    let l_shape = prism(
        &[
            [4.0, 4.0],
            [4.0, 8.0],
            [0.0, 8.0],
            [0.0, 0.0],
            [8.0, 0.0],
            [8.0, 4.0],
        ],
        6.0,
    );
    assert!(signed_volume(&l_shape) > signed_volume(&model));
    let cavity = sound_cavity(&l_shape, &spec(1.0, &[]));
    let distance = MeshDistance::new(&l_shape);
    // Beside the edge at (4, 4) the surface is a cylinder of the wall's radius.
    let near_edge = samples(cavity.mesh())
        .into_iter()
        .filter(|p| p.x > 3.0 && p.x < 4.0 && p.y < 4.0 && p.y > 3.0);
    let mut count = 0;
    for p in near_edge.filter(|p| p.z > 2.0 && p.z < 4.0) {
        assert!((distance.signed(&p) - 1.0).abs() < TOLERANCE_MM, "{p}");
        count += 1;
    }
    assert!(count > 20);
}

#[test]
fn a_thin_plate_has_no_cavity() {
    let cavity = cavity_of(&block([0.0; 3], [20.0, 15.0, 1.9]), &spec(1.0, &[]));
    assert!(cavity.mesh().triangles().is_empty());
    let voids = cavity
        .void_bodies(&EVERYTHING, &Frame::identity(), &Watch::silent())
        .unwrap();
    assert_eq!(voids, Voids::default());
}

#[test]
fn a_dumbbell_with_a_thin_neck_has_two_cavities_the_larger_first() {
    let outline = [
        [0.0, 0.0],
        [3.0, 1.0],
        [3.0, 4.0],
        [0.9, 5.0],
        [0.9, 7.0],
        [4.0, 8.0],
        [4.0, 12.0],
        [0.0, 13.0],
    ];
    let cavity = sound_cavity(&revolved(&outline, 24), &spec(1.0, &[]));
    let voids = cavity
        .void_bodies(&EVERYTHING, &Frame::identity(), &Watch::silent())
        .unwrap();
    assert_eq!(voids.bodies.len(), 2);
    assert!(voids.bodies[0].mesh().aabb().min.z > 7.0);
    assert!(signed_volume(voids.bodies[0].mesh()) > signed_volume(voids.bodies[1].mesh()));
}

#[test]
fn the_cavity_touches_each_keep_within_tolerance_and_enters_none() {
    let keeps = [
        Keep::ball(Point::new(5.0, 5.0, 0.0), 3.0),
        Keep {
            from: Point::new(2.0, 2.0, 4.0),
            to: Point::new(6.0, 3.0, 9.0),
            radius_mm: 1.2,
        },
    ];
    let cavity = sound_cavity(&block([0.0; 3], [10.0; 3]), &spec(1.0, &keeps));
    for keep in keeps {
        let bvh = Bvh::new(cavity.mesh().iter_corners());
        let distance = bvh.segment_distance(&keep.from, &keep.to, f64::INFINITY);
        assert!(
            distance >= keep.radius_mm - 0.01 && distance <= keep.radius_mm + TOLERANCE_MM,
            "{distance}"
        );
    }
    assert!(signed_volume(cavity.mesh()) > 0.0);
}

#[test]
fn overlapping_input_still_gives_a_sound_cavity() {
    let two =
        ball(Point::new(0.0, 0.0, 0.0), 4.0, 4).joined(&ball(Point::new(4.3, 0.1, 0.2), 4.0, 4));
    sound_cavity(&two, &spec(1.0, &[]));
}

#[test]
fn a_length_that_is_not_positive_is_named_in_the_error() {
    let model = Solid::new(block([0.0; 3], [8.0; 3])).unwrap();
    for wall_mm in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Cavity::extract(&model, &spec(wall_mm, &[]), &Watch::silent())
            .map(|_| ())
            .unwrap_err();
        assert!(error.to_string().contains("the wall"), "{error}");
    }
}

#[test]
fn a_cancelled_extraction_stops() {
    let watch = Watch::silent();
    watch.cancel();
    let model = Solid::new(block([0.0; 3], [8.0; 3])).unwrap();
    let error = Cavity::extract(&model, &spec(1.0, &[]), &watch)
        .map(|_| ())
        .unwrap_err();
    assert_eq!(error, VoidError::Cancelled(Cancelled));
}
