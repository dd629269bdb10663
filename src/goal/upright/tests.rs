//! Bodies whose up nobody doubts, made here and turned askew.

use super::*;
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mesh::primitives::{cuboid, cylinder, ellipsoid};
use crate::mesh::{Csg, TriMesh};

/// Bodies are symmetric and steadied, so only the rounding of their arcs is left, degrees.
const EXACT_DEG: f64 = 1.0;

fn body(mesh: &TriMesh) -> Csg {
    Csg::of_mesh(mesh).unwrap()
}

fn block(min: [f64; 3], max: [f64; 3]) -> Csg {
    body(&cuboid(&Point::from(min), &Point::from(max)))
}

fn rod(radius_mm: f64, from_mm: f64, to_mm: f64) -> Csg {
    let rod = cylinder(radius_mm, to_mm - from_mm, 48);
    body(&rod.map_vertices(|p| p + Vector::z() * from_mm))
}

/// Returns a frustum of two discs, or a cone.
fn frustum(lower_mm: f64, upper_mm: f64, height_mm: f64) -> Csg {
    let points = |radius_mm: f64, z: f64| {
        let disc = cylinder(radius_mm.max(1e-9), 1.0, 48);
        let ring: Vec<Point> = disc.vertices()[..48].to_vec();
        ring.into_iter().map(move |p| Point::new(p.x, p.y, z))
    };
    let both: Vec<Point> = points(lower_mm, 0.0)
        .chain(points(upper_mm, height_mm))
        .collect();
    Csg::convex_hull(&both).unwrap()
}

fn joined(parts: &[Csg]) -> Csg {
    let first = parts[0].clone();
    let mut rest = parts[1..].iter();
    rest.try_fold(first, |sum, part| sum.union(part)).unwrap()
}

/// Returns four legs of a square table or chair.
fn legs(half_mm: f64, thick_mm: f64, height_mm: f64) -> Vec<Csg> {
    let ends = [-half_mm, half_mm - thick_mm];
    let feet = ends.iter().flat_map(|x| ends.iter().map(move |y| [*x, *y]));
    feet.map(|[x, y]| block([x, y, 0.0], [x + thick_mm, y + thick_mm, height_mm]))
        .collect()
}

/// Returns what is found of a body that is made with up along z, turned askew, and that up.
fn found(body: &Csg) -> (Vec<UprightPose>, Vector) {
    let askew = Frame::with_axis(Point::new(3.0, -2.0, 5.0), &Vector::new(-0.4, 0.7, -0.55));
    let mesh = body.to_mesh().unwrap().map_vertices(|p| askew.to_model(p));
    let poses = find_upright(&Solid::new(mesh).unwrap(), &Watch::silent()).unwrap();
    (poses, askew.axis())
}

/// Asserts that up is found, and returns the best pose.
fn assert_up(body: &Csg) -> UprightPose {
    let (poses, up) = found(body);
    let off_deg = poses[0].up.angle(&up).to_degrees();
    assert!(off_deg < EXACT_DEG, "{off_deg}° off: {poses:#?}");
    poses[0].clone()
}

#[test]
fn a_cone_stands_on_its_base_and_a_frustum_on_its_wider_end() {
    let best = assert_up(&frustum(10.0, 0.0, 25.0));
    assert!(best.reasons.contains(&UprightReason::FlatFoot));
    assert!(best.lead > 0.5, "{best:?}");
    assert!(assert_up(&frustum(10.0, 7.0, 12.0)).lead > 0.0);
}

#[test]
fn a_cup_stands_on_its_bottom_for_it_holds_liquid() {
    let inside = rod(8.0, 2.0, 30.0);
    let best = assert_up(&frustum(8.0, 10.0, 24.0).subtract(&inside).unwrap());
    assert!(best.reasons.contains(&UprightReason::HoldsLiquid));
    assert!(best.lead > 0.5, "{best:?}");
}

#[test]
fn a_ring_that_lies_flat_holds_nothing() {
    let ring = rod(20.0, 0.0, 8.0).subtract(&rod(15.0, -1.0, 9.0)).unwrap();
    let (poses, _) = found(&ring);
    assert!(!poses[0].reasons.contains(&UprightReason::HoldsLiquid));
}

#[test]
fn an_open_boat_has_its_keel_below_though_its_rim_is_flat() {
    let shape = |sides: [f64; 3]| body(&ellipsoid(&Point::origin(), &Vector::from(sides), 4));
    let hull = shape([50.0, 18.0, 16.0])
        .subtract(&shape([47.0, 15.0, 13.0]))
        .unwrap();
    let deck = Plane {
        normal: Vector::z(),
        offset_mm: -0.01,
    };
    let (_, below) = hull.split_by_plane(&deck).unwrap();
    let best = assert_up(&below);
    assert!(
        best.reasons.contains(&UprightReason::HoldsLiquid),
        "{best:?}"
    );
}

#[test]
fn a_table_and_a_chair_stand_on_their_feet_though_other_sides_are_flatter() {
    let mut parts = legs(30.0, 5.0, 40.0);
    parts.push(block([-30.0, -30.0, 40.0], [30.0, 30.0, 43.0]));
    let feet = UprightReason::Feet { count: 4 };
    assert!(assert_up(&joined(&parts)).reasons.contains(&feet));
    parts.push(block([-30.0, 27.0, 43.0], [30.0, 30.0, 85.0]));
    assert!(assert_up(&joined(&parts)).reasons.contains(&feet));
}

#[test]
fn a_pear_rests_on_its_round_end() {
    let ball = |z: f64, radius_mm: f64| {
        let sides = Vector::new(radius_mm, radius_mm, 0.8 * radius_mm);
        body(&ellipsoid(&Point::new(0.0, 0.0, z), &sides, 4))
    };
    let best = assert_up(&joined(&[ball(0.0, 20.0), ball(16.0, 10.0)]));
    assert!(best.reasons.contains(&UprightReason::StableRest));
}

#[test]
fn a_spindle_that_stands_nowhere_has_its_narrow_end_below() {
    let turned_over = frustum(0.0, 10.0, 25.0);
    let lens = body(&ellipsoid(
        &Point::new(0.0, 0.0, 25.0),
        &Vector::new(9.9, 9.9, 9.0),
        4,
    ));
    let best = assert_up(&joined(&[turned_over, lens]));
    assert!(
        best.reasons.contains(&UprightReason::NarrowBelow),
        "{best:?}"
    );
}

#[test]
fn a_cylinder_stands_on_an_end_and_the_files_z_breaks_the_tie_of_both() {
    let can = rod(10.0, 0.0, 30.0);
    let (poses, axis) = found(&can);
    let along = axis * axis.z.signum();
    assert!(poses[0].up.angle(&along).to_degrees() < EXACT_DEG);
    assert!(poses[0].reasons.contains(&UprightReason::FileUp));
    assert!(poses[1].up.dot(&along) < -0.999);
}

#[test]
fn what_is_found_is_the_same_on_one_thread() {
    let mug = frustum(8.0, 10.0, 24.0)
        .subtract(&rod(7.0, 2.0, 30.0))
        .unwrap();
    let mug = mug.to_solid().unwrap();
    let alone = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let find = || find_upright(&mug, &Watch::silent()).unwrap();
    assert_eq!(alone.install(find), find());
}

#[test]
fn a_stopped_watch_stops_the_search() {
    let watch = Watch::silent();
    watch.cancel();
    let can = rod(10.0, 0.0, 30.0).to_solid().unwrap();
    assert_eq!(find_upright(&can, &watch), Err(Cancelled));
}
