//! Ways that are barred, faces that touch, the lies of parts in a room, and the choice of screws.

use equipoise::cladding::{Lie, ScrewKit, barred_mm2, contact_mm2, face_mm2};
use equipoise::cutter::Fastener;
use equipoise::geom::{Aabb, Plane, Point, Vector};
use equipoise::mesh::primitives::{ball, cuboid};

use super::scenes::block;

/// Returns the corners of a block at the origin.
fn corners(size: [f64; 3]) -> Vec<Point> {
    cuboid(&Point::origin(), &size.into()).vertices().to_vec()
}

#[test]
fn a_block_is_barred_by_what_hangs_over_it_and_not_by_what_lies_below_or_beside() {
    let moving = block([0.0; 3], [4.0, 4.0, 1.0]);
    let over = block([3.0, 1.0, 5.0], [9.0, 3.0, 6.0]);
    let up = Vector::z();
    assert!((barred_mm2(&moving, &over, &up) - 2.0).abs() < 1e-12);
    assert_eq!(barred_mm2(&over, &moving, &up), 0.0);
    assert!((barred_mm2(&over, &moving, &-up) - 2.0).abs() < 1e-12);
    let beside = block([4.0, 0.0, -3.0], [6.0, 4.0, 9.0]);
    assert_eq!(barred_mm2(&moving, &beside, &up), 0.0);
    // Face on face: it cannot move at all.
    let on_it = block([0.0, 0.0, 1.0], [4.0, 4.0, 2.0]);
    assert!((barred_mm2(&moving, &on_it, &up) - 16.0).abs() < 1e-12);
}

#[test]
fn a_round_body_is_barred_by_its_whole_shadow() {
    let round = ball(&Point::origin(), 2.0, 3);
    let roof = block([-9.0, -9.0, 7.0], [9.0, 9.0, 8.0]);
    let way = Vector::new(0.1, -0.2, 1.0).normalize();
    let barred = barred_mm2(&round, &roof, &way);
    let disc = std::f64::consts::PI * 4.0;
    assert!(barred < disc && barred > 0.97 * disc, "{barred}");
}

#[test]
fn bodies_touch_in_what_their_faces_share() {
    let lower = block([0.0; 3], [4.0, 4.0, 1.0]);
    let upper = block([1.0, 2.0, 1.0], [6.0, 6.0, 2.0]);
    let plane = Plane {
        normal: Vector::z(),
        offset_mm: 1.0,
    };
    assert!((contact_mm2(&lower, &upper, &plane) - 6.0).abs() < 1e-12);
    assert_eq!(contact_mm2(&upper, &lower, &plane), 0.0);
    assert!((face_mm2(&lower, &plane) - 16.0).abs() < 1e-12);
}

#[test]
fn a_block_fits_as_it_lies_turned_or_on_its_side() {
    let up = Vector::z();
    let lie = |size| Lie::find(&corners(size), &up, [250.0, 210.0, 200.0]);
    let as_it_lies = lie([249.0, 209.0, 199.0]).unwrap();
    assert!((as_it_lies.frame.axis() - up).norm() < 1e-12);
    let mut sides = lie([209.0, 249.0, 199.0]).unwrap().size_mm;
    sides.sort_by(f64::total_cmp);
    assert!((sides[2] - 249.0).abs() < 1e-9);
    let on_side = lie([100.0, 150.0, 240.0]).unwrap();
    assert!(on_side.frame.axis().dot(&up).abs() < 0.5);
    assert_eq!(lie([260.0, 220.0, 205.0]), None);
}

#[test]
fn a_bar_longer_than_every_side_fits_across() {
    // The diagonal of the plate is 326.5 mm; a bar of 10 mm loses about 10 mm at both ends.
    let lie = |length| {
        Lie::with_up(
            &corners([length, 10.0, 5.0]),
            &Vector::z(),
            [250.0, 210.0, 200.0],
        )
    };
    let found = lie(316.0).unwrap();
    assert!(found.size_mm[0] <= 250.0 + 1e-6 && found.size_mm[1] <= 210.0 + 1e-6);
    assert_eq!(lie(318.0), None);
    let turned = corners([316.0, 10.0, 5.0]);
    let local: Vec<Point> = turned.iter().map(|p| found.frame.to_local(p)).collect();
    let extent = Aabb::of_points(&local);
    assert!(extent.min.coords.norm() < 1e-9);
    assert!((extent.size().x - found.size_mm[0]).abs() < 1e-9);
}

#[test]
fn the_shortest_screw_that_reaches_through_its_insert_is_chosen() {
    let stock = Fastener::all().unwrap();
    let choose = |thread_mm: f64, stack_mm: f64| {
        ScrewKit::choose(&stock, thread_mm, stack_mm).map(|kit| kit.screw.id)
    };
    // Inserts of 5.7 and 8.1 mm behind 5.5 mm of panel and gap.
    assert_eq!(choose(3.0, 5.5).as_deref(), Some("screw-m3x12"));
    assert_eq!(choose(4.0, 5.5).as_deref(), Some("screw-m4x16"));
    // None reaches through: the longest.
    assert_eq!(choose(4.0, 13.0).as_deref(), Some("screw-m4x20"));
    assert_eq!(choose(4.0, 30.0), None);
    assert_eq!(choose(7.0, 5.5), None);
}
