//! Tests of the number of cuts that the planner finds, on bodies with a known answer.

use crate::{
    cut::{
        scenes::{ball, cuboid, plan, request, with_balls},
        tests::kit,
        *,
    },
    geom::{Point, Vector},
    mesh::Csg,
};

#[test]
fn pearls_on_a_skew_string_need_one_cut() {
    let direction = Vector::new(1.0, 2.0, -1.5).normalize();
    let pearls: Vec<[f64; 4]> = (-3..=3)
        .map(|i| direction * (7.0 * f64::from(i)))
        .map(|p| [p.x, p.y, p.z, 3.0])
        .collect();
    let (plan, _) = kit(&with_balls(ball([0.0; 3], 32.0), &pearls), &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn two_voids_side_by_side_only_in_a_skew_direction_need_one_cut() {
    // Their extents along x, y and z do not overlap, so no plane normal to an axis meets both.
    let body = with_balls(
        cuboid([-30.0; 3], [30.0; 3]),
        &[[-15.0, -15.0, -15.0, 6.0], [15.0, 15.0, 15.0, 6.0]],
    );
    let (plan, _) = kit(&body, &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn a_table_with_a_void_in_every_leg_needs_one_cut() {
    let legs = [[5.0, 5.0], [45.0, 5.0], [5.0, 45.0], [45.0, 45.0]];
    let mut body = Csg::of_solid(&cuboid([0.0, 0.0, 30.0], [50.0, 50.0, 40.0])).unwrap();
    for [x, y] in legs {
        let leg = cuboid([x - 5.0, y - 5.0, 0.0], [x + 5.0, y + 5.0, 31.0]);
        body = body.union(&Csg::of_solid(&leg).unwrap()).unwrap();
    }
    let outer = body.to_solid().unwrap();
    let voids = legs.map(|[x, y]| cuboid([x - 3.0, y - 3.0, 4.0], [x + 3.0, y + 3.0, 25.0]));
    let (plan, _) = kit(&Hollowed::new(outer, voids.to_vec()), &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn three_voids_in_a_triangle_need_the_one_plane_through_them_all() {
    let body = with_balls(
        ball([0.0; 3], 40.0),
        &[
            [20.0, 0.0, 12.0, 4.0],
            [-12.0, 18.0, -4.0, 4.0],
            [-10.0, -18.0, 0.0, 4.0],
        ],
    );
    let (plan, _) = kit(&body, &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn four_small_voids_at_the_corners_of_a_tetrahedron_need_two_cuts() {
    // A plane within 1.5 mm of three corners misses the fourth by some 40 mm. Two planes take two
    // corners each.
    let corner = |x: f64, y: f64, z: f64| [15.0 * x, 15.0 * y, 15.0 * z, 2.5];
    let tetrahedron = [
        corner(1.0, 1.0, 1.0),
        corner(1.0, -1.0, -1.0),
        corner(-1.0, 1.0, -1.0),
        corner(-1.0, -1.0, 1.0),
    ];
    let (plan, parts) = kit(
        &with_balls(cuboid([-25.0; 3], [25.0; 3]), &tetrahedron),
        &request(),
    );
    assert_eq!(plan.cuts.len(), 2);
    assert!(
        plan.notes[0].to_string().contains("fewer do not"),
        "{:?}",
        plan.notes
    );
    assert!(parts.len() >= 3);
}

#[test]
fn a_void_too_narrow_to_open_is_named() {
    let body = with_balls(
        cuboid([0.0; 3], [30.0; 3]),
        &[[10.0, 10.0, 10.0, 5.0], [22.0, 22.0, 22.0, 1.0]],
    );
    let refused = plan(&body, &request()).unwrap_err();
    let CutError::Obstacle(Obstacle::Unopenable { voids, .. }) = refused else {
        panic!("{refused}")
    };
    assert_eq!(voids, [VoidId::of(1)]);
}

/// Returns a body of 60 × 30 × 30 mm with a void. Behind it are pockets for balls of 5 mm with a
/// clearance of 0.2 mm.
fn with_pockets(pockets: &[[f64; 3]]) -> Hollowed {
    let voids = [
        &[[15.0, 15.0, 15.0, 9.0]][..],
        &pockets
            .iter()
            .map(|&[x, y, z]| [x, y, z, 2.7])
            .collect::<Vec<_>>(),
    ];
    let mut body = with_balls(cuboid([0.0; 3], [60.0, 30.0, 30.0]), &voids.concat());
    let seat = |&center: &[f64; 3]| Seat {
        center: Point::from(center),
        axis: None,
        radius_mm: 2.7,
        opening_mm: 5.0,
    };
    for (void, center) in body.voids[1..].iter_mut().zip(pockets) {
        void.holds = Some(seat(center));
    }
    body
}

#[test]
fn one_cut_opens_a_void_and_lets_a_ball_into_its_pocket() {
    let body = with_pockets(&[[50.0, 22.0, 8.0]]);
    let (plan, _) = kit(&body, &request());
    assert_eq!(plan.cuts.len(), 1);
    assert!(plan.voids[1].opening_mm >= 5.0, "{:?}", plan.voids);
    let plane = plan.cuts[0].plane().unwrap();
    // Distance from the middle of the pocket: √(2.7² − 2.5²).
    assert!(plane.distance(&Point::new(50.0, 22.0, 8.0)).abs() <= 1.02);
}

#[test]
fn three_pockets_without_order_are_opened_by_the_plane_through_them() {
    let body = with_pockets(&[[40.0, 6.0, 22.0], [54.0, 24.0, 7.0], [36.0, 22.0, 11.0]]);
    let (plan, _) = kit(&body, &request());
    assert!(plan.cuts.len() <= 2, "{:?}", plan.notes);
    assert!(
        plan.voids[1..].iter().all(|void| void.opening_mm >= 5.0),
        "{:?}",
        plan.voids
    );
}
