//! Tests of whole cavities and voids.

use super::shapes::{ball, block, prism, revolved};
use super::{Cavity, CavitySpec, VoidError, Voids, grown, without_slivers};
use crate::base::watch::Watch;
use crate::geom::triangle::triangle_triangle_distance_squared;
use crate::geom::{Aabb, Bvh, Frame, Point, Quadric, Vector};
use crate::mesh::{MeshDistance, Solid, TriMesh};
use crate::shell::Keep;
use crate::shell::fixtures::cells;

fn signed_volume(mesh: &TriMesh) -> f64 {
    mesh.signed_volume_mm3()
}

/// Half a pixel of a 600 dpi printer.
const TOLERANCE_MM: f64 = 0.021;

fn spec(wall_mm: f64, keeps: &[Keep]) -> CavitySpec<'_> {
    CavitySpec {
        wall_mm,
        tolerance_mm: TOLERANCE_MM,
        keeps,
        min_void_mm: 0.0,
    }
}

fn cavity_of(mesh: &TriMesh, spec: &CavitySpec) -> Cavity {
    Cavity::extract(&Solid::new(mesh.clone()).unwrap(), spec, &Watch::silent()).unwrap()
}

/// Extracts the cavity and checks the promises that hold for every cavity.
fn sound_cavity(mesh: &TriMesh, spec: &CavitySpec) -> Cavity {
    let cavity = cavity_of(mesh, spec);
    assert_sound(cavity.mesh());
    let wall_mm = MeshDistance::new(mesh).min_distance_to(cavity.mesh());
    assert!(wall_mm >= spec.wall_mm - 0.01, "{wall_mm}");
    cavity
}

/// Asserts that the mesh is closed, 2-manifold (every vertex in one fan) and free of
/// self-intersection, by testing every pair of triangles.
fn assert_sound(mesh: &TriMesh) {
    Solid::new(mesh.clone()).unwrap();
    assert_eq!(fans(mesh), mesh.vertices().len());
    let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let boxes: Vec<Aabb> = corners.iter().map(Aabb::of_points).collect();
    let mut order: Vec<usize> = (0..corners.len()).collect();
    order.sort_by(|&i, &j| boxes[i].min.x.total_cmp(&boxes[j].min.x));
    for (k, &i) in order.iter().enumerate() {
        for &j in order[k + 1..]
            .iter()
            .take_while(|&&j| boxes[j].min.x <= boxes[i].max.x)
        {
            let shared = mesh.triangles()[i]
                .iter()
                .any(|v| mesh.triangles()[j].contains(v));
            let apart = (0..3)
                .any(|a| boxes[i].min[a] > boxes[j].max[a] || boxes[j].min[a] > boxes[i].max[a]);
            assert!(
                shared
                    || apart
                    || triangle_triangle_distance_squared(&corners[i], &corners[j]) > 0.0,
                "triangles {:?} and {:?} meet",
                corners[i],
                corners[j]
            );
        }
    }
}

/// Counts the fans: the connected runs of triangles around a vertex.
fn fans(mesh: &TriMesh) -> usize {
    let mut next = std::collections::HashMap::new();
    for &[a, b, c] in mesh.triangles() {
        for (v, from, to) in [(a, b, c), (b, c, a), (c, a, b)] {
            assert!(next.insert((v, from), to).is_none());
        }
    }
    let mut seen = std::collections::HashSet::new();
    let mut keys: Vec<_> = next.keys().copied().collect();
    keys.sort_unstable();
    let mut count = 0;
    for (v, start) in keys {
        let mut from = start;
        count += usize::from(!seen.contains(&(v, from)));
        while seen.insert((v, from)) {
            from = next[&(v, from)];
        }
    }
    count
}

/// Returns points of every triangle: its corners, the middles of its sides and its centroid.
fn samples(mesh: &TriMesh) -> Vec<Point> {
    let of = |t: [Point; 3]| {
        let [a, b, c] = t.map(|p| p.coords);
        [
            a,
            b,
            c,
            (a + b) / 2.0,
            (b + c) / 2.0,
            (c + a) / 2.0,
            (a + b + c) / 3.0,
        ]
        .map(Point::from)
    };
    mesh.iter_corners().flat_map(of).collect()
}

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
    let about = |places: &[(Point, Aabb)]| cavity.parts_about(places).unwrap();
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
    let voids = cavity.void_bodies(&EVERYTHING, &Frame::identity()).unwrap();
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
    let voids = cavity.void_bodies(&EVERYTHING, &Frame::identity()).unwrap();
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
    assert_eq!(error, VoidError::Cancelled);
}

const EVERYTHING: Quadric = Quadric([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);

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
    let voids = cavity.void_bodies(&quadric, frame).unwrap();
    let wall = MeshDistance::new(&block([0.0; 3], [14.0, 12.0, 10.0]));
    for body in &voids.bodies {
        assert_sound(body.mesh());
        assert_sound(without_slivers(body).unwrap().mesh());
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
fn a_quadric_positive_everywhere_gives_the_cavity_and_one_positive_nowhere_gives_no_void() {
    let (cavity, frame) = setting();
    assert_eq!(
        cavity.void_bodies(&EVERYTHING, &frame).unwrap().bodies[0]
            .mesh()
            .triangles()
            .len(),
        cavity.mesh().triangles().len()
    );
    let nothing = Quadric(EVERYTHING.0.map(|g| -g));
    assert!(
        cavity
            .void_bodies(&nothing, &frame)
            .unwrap()
            .bodies
            .is_empty()
    );
    assert!(
        cavity
            .void_bodies(&Quadric([0.0; 10]), &frame)
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
        .void_bodies(&Quadric(inside.0.map(|g| -g)), &frame)
        .unwrap();
    assert_eq!(voids.bodies.len(), 1);
    assert!((voids.emptied_mm3 - volumes[0]).abs() < 113.1 * TOLERANCE_MM);
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
    let thin = cavity.void_bodies(&slab(0.7), &frame).unwrap();
    assert_eq!((thin.bodies.len(), thin.refused.len()), (0, 1));
    assert!(
        (thin.refused_mm3() - 12.0 * 10.0 * 1.4).abs() < 5.0,
        "{}",
        thin.refused_mm3()
    );
    assert_eq!(
        cavity.void_bodies(&slab(1.3), &frame).unwrap().bodies.len(),
        1
    );
}

#[test]
fn a_body_subtracted_from_a_cavity_stays_out_of_its_voids() {
    let (cavity, frame) = setting();
    let thin = block([2.0, 2.0, 2.0], [12.0, 10.0, 2.5]);
    let rest = cavity.without(&grown(&thin, 0.3).unwrap()).unwrap();
    assert_sound(rest.mesh());
    let lost = signed_volume(cavity.mesh()) - signed_volume(rest.mesh());
    // The slab grown by 0.3 mm takes its own volume, 196 mm² of faces times 0.3 mm, and a little at
    // the edges. The surface may sag by 0.4 of the margin.
    assert!(
        lost > 40.0 + 196.0 * 0.3 * 0.6 && lost < 40.0 + 196.0 * 0.3 + 10.0,
        "{lost}"
    );
    let voids = rest.void_bodies(&EVERYTHING, &frame).unwrap();
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
                cavity.void_bodies(&quadric, &Frame::identity()).unwrap(),
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
