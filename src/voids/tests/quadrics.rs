//! Tests of the voids that quadrics cut out of a cavity.

use super::*;

/// Returns the cavity of a box, and a tilted frame in its middle.
fn setting() -> (Cavity, Frame) {
    let cavity = cavity_of(&block([0.0; 3], [14.0, 12.0, 10.0]), &spec(1.0, &[]));
    (
        cavity,
        Frame::with_axis(Point::new(7.0, 6.0, 5.0), &Vector::new(0.2, 0.3, 1.0)),
    )
}

/// Asserts that the voids of a quadric are sound, keep the wall and lie on its positive side within
/// the tolerance. Returns their volumes, mm³.
fn sound_voids(cavity: &Cavity, frame: &Frame, quadric: Quadric) -> Vec<f64> {
    let voids = cavity
        .void_bodies(&quadric, frame, &Watch::silent())
        .unwrap();
    let wall = MeshDistance::new(&block([0.0; 3], [14.0, 12.0, 10.0]));
    for body in &voids.bodies {
        assert_sound(body.mesh());
        assert_sound(without_slivers(body, &Watch::silent()).unwrap().mesh());
        assert!(wall.min_distance_to(body.mesh()) >= 0.99);
        for p in samples(body.mesh()) {
            let local = frame.to_local(&p);
            let (value, slope) = (quadric.value(&local), quadric.gradient(&local).norm());
            // Within half a millimetre of a singular point the surface is drawn coarsely; the
            // second derivatives are at most 2. Elsewhere it strays by half the tolerance times the
            // slope, and a little more as the slope itself changes.
            let is_singular = slope < 1.0;
            assert!(
                is_singular || value >= -0.55 * TOLERANCE_MM * slope,
                "{p}: {value} {slope}"
            );
        }
    }
    voids
        .bodies
        .iter()
        .map(|body| signed_volume(body.mesh()))
        .collect()
}

#[test]
fn a_quadric_positive_everywhere_gives_the_cavity_and_its_opposite_nothing() {
    let (cavity, frame) = setting();
    assert_eq!(
        cavity
            .void_bodies(&EVERYTHING, &frame, &Watch::silent())
            .unwrap()
            .bodies[0]
            .mesh()
            .triangles()
            .len(),
        cavity.mesh().triangles().len()
    );
    let nothing = Quadric(EVERYTHING.0.map(|g| -g));
    assert!(
        cavity
            .void_bodies(&nothing, &frame, &Watch::silent())
            .unwrap()
            .bodies
            .is_empty()
    );
    assert!(
        cavity
            .void_bodies(&Quadric([0.0; 10]), &frame, &Watch::silent())
            .unwrap()
            .bodies
            .is_empty()
    );
}

#[test]
fn a_plane_through_the_middle_halves_the_cavity() {
    let (cavity, frame) = setting();
    let volumes = sound_voids(
        &cavity,
        &frame,
        Quadric([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    );
    let half = signed_volume(cavity.mesh()) / 2.0;
    // The cavity is point-symmetric about its middle within the tolerance, on 592 mm² of surface.
    assert!((volumes[0] - half).abs() < 1.0, "{volumes:?}");
}

#[test]
fn the_inside_of_a_ball_is_a_ball_and_outside_it_the_loose_ball_is_emptied() {
    let (cavity, frame) = setting();
    let inside = Quadric([9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, -1.0]);
    let volumes = sound_voids(&cavity, &frame, inside);
    let exact = 4.0 / 3.0 * std::f64::consts::PI * 27.0;
    // Half the tolerance on 113 mm² of sphere.
    assert!(
        (volumes[0] - exact).abs() < 113.1 * 0.5 * TOLERANCE_MM,
        "{volumes:?}"
    );
    let voids = cavity
        .void_bodies(&Quadric(inside.0.map(|g| -g)), &frame, &Watch::silent())
        .unwrap();
    assert_eq!(voids.bodies.len(), 1);
    assert!((voids.loose_mm3 - volumes[0]).abs() < 113.1 * TOLERANCE_MM);
    assert!((signed_volume(voids.bodies[0].mesh()) - signed_volume(cavity.mesh())).abs() < 1e-9);
}

#[test]
fn cones_hyperboloids_cylinders_and_plane_pairs_give_sound_voids() {
    let (cavity, frame) = setting();
    let whole = signed_volume(cavity.mesh());
    let cases = [
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.8, -0.7], 1),
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, -0.8, 0.7], 2),
        ([-2.0, 0.1, 0.0, 0.0, 0.1, 0.0, 0.0, 1.0, 0.8, -0.3], 1),
        ([-2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.5, -0.4, 1.0], 2),
        ([-4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0], 1),
        ([-2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], 2),
        // Two wedges that touch along a line may be joined there.
        ([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1),
    ];
    for (g, count) in cases {
        let volumes = sound_voids(&cavity, &frame, Quadric(g));
        let rest = sound_voids(&cavity, &frame, Quadric(g.map(|c| -c)));
        assert!(volumes.len() >= count, "{g:?}: {volumes:?}");
        let sum: f64 = volumes.iter().chain(&rest).sum();
        // Both sides are drawn within half the tolerance, on less than 400 mm² of quadric.
        assert!(
            (sum - whole).abs() < 400.0 * 2.0 * 0.5 * TOLERANCE_MM,
            "{g:?}: {sum} {whole}"
        );
    }
}

#[test]
fn voids_thinner_than_the_minimum_are_left_solid_and_counted() {
    let model = block([0.0; 3], [14.0, 12.0, 10.0]);
    let cavity = cavity_of(
        &model,
        &CavitySpec {
            min_void_mm: 2.0,
            ..spec(1.0, &[])
        },
    );
    let frame = Frame::with_axis(Point::new(7.0, 6.0, 5.0), &Vector::z());
    let slab = |half: f64| Quadric([half * half, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0]);
    let thin = cavity
        .void_bodies(&slab(0.7), &frame, &Watch::silent())
        .unwrap();
    assert_eq!((thin.bodies.len(), thin.too_small.len()), (0, 1));
    assert!(
        (thin.too_small_mm3() - 12.0 * 10.0 * 1.4).abs() < 5.0,
        "{}",
        thin.too_small_mm3()
    );
    assert_eq!(
        cavity
            .void_bodies(&slab(1.3), &frame, &Watch::silent())
            .unwrap()
            .bodies
            .len(),
        1
    );
}

#[test]
fn a_body_subtracted_from_a_cavity_stays_out_of_its_voids() {
    let (cavity, frame) = setting();
    let thin = block([2.0, 2.0, 2.0], [12.0, 10.0, 2.5]);
    let rest = cavity
        .without(&grow_bodies(&thin, 0.3, &Watch::silent()).unwrap())
        .unwrap();
    assert_sound(rest.mesh());
    let lost = signed_volume(cavity.mesh()) - signed_volume(rest.mesh());
    // The slab grown by 0.3 mm takes its own volume, 196 mm² of faces times 0.3 mm, and a little at
    // the edges. The surface may sag by 0.4 of the margin.
    assert!(
        lost > 40.0 + 196.0 * 0.3 * 0.6 && lost < 40.0 + 196.0 * 0.3 + 10.0,
        "{lost}"
    );
    let voids = rest
        .void_bodies(&EVERYTHING, &frame, &Watch::silent())
        .unwrap();
    assert!(MeshDistance::new(&thin).min_distance_to(voids.bodies[0].mesh()) > 0.1);
}

#[test]
fn one_thread_and_two_give_the_same_bits() {
    let model = ball(Point::new(1.0, 2.0, 3.0), 6.0, 3);
    let keeps = [Keep::ball(Point::new(1.0, 2.0, -3.0), 2.0)];
    let with_threads = |n| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build()
            .unwrap();
        pool.install(|| {
            let cavity = cavity_of(&model, &spec(1.0, &keeps));
            let quadric = Quadric([-3.0, 0.2, 0.1, 0.0, 0.0, 0.3, 0.0, 1.0, 0.7, -0.2]);
            (
                cavity.mesh().clone(),
                cavity
                    .void_bodies(&quadric, &Frame::identity(), &Watch::silent())
                    .unwrap(),
            )
        })
    };
    let bits = |mesh: &TriMesh| -> Vec<u64> {
        mesh.vertices()
            .iter()
            .flat_map(|p| [p.x, p.y, p.z].map(f64::to_bits))
            .collect()
    };
    let (one, two) = (with_threads(1), with_threads(2));
    assert_eq!(bits(&one.0), bits(&two.0));
    assert_eq!(one.0.triangles(), two.0.triangles());
    assert_eq!(one.1, two.1);
}
