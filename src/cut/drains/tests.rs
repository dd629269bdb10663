//! Drain holes in boxes and balls.

use super::*;
use crate::base::verdict::Verdict;
use crate::cut::Obstacle;
use crate::cut::parts;
use crate::cut::scenes::{ball, cuboid, request};
use crate::geom::Vector;
use crate::mesh::MeshDistance;

const ONE: DrainNeed = DrainNeed {
    diameter_mm: 4.0,
    count: 1,
    is_liquid: false,
    plug_gap_mm: None,
    printed_up: None,
};
const PAIR: DrainNeed = DrainNeed {
    diameter_mm: 2.0,
    count: 2,
    is_liquid: false,
    plug_gap_mm: None,
    printed_up: None,
};
const RESIN: DrainNeed = DrainNeed {
    diameter_mm: 3.5,
    count: 2,
    is_liquid: true,
    plug_gap_mm: None,
    printed_up: None,
};

/// Returns a box of 40 mm with a void 2 mm below its surface.
fn hollow_box() -> Hollowed {
    let outer = cuboid([0.0; 3], [40.0; 3]);
    Hollowed::new(outer, vec![cuboid([2.0; 3], [38.0; 3])])
}

/// Returns a ball of 40 mm across with a void 2 mm below its surface.
fn hollow_ball() -> Hollowed {
    Hollowed::new(ball([0.0; 3], 20.0), vec![ball([0.0; 3], 18.0)])
}

fn placed(hollowed: &Hollowed, need: &DrainNeed) -> Drained {
    drain(hollowed, &request(), need).unwrap()
}

fn mouth(hole: &DrainHole) -> Point {
    hole.from_mm.into()
}

#[test]
fn a_box_is_drained_through_its_underside_within_its_foot() {
    let found = placed(&hollow_box(), &ONE);
    assert_eq!(found.closed, vec![]);
    let [hole] = &found.plan.drains[..] else {
        panic!("{:?}", found.plan.drains)
    };
    let [x, y, z] = hole.from_mm;
    assert!((-0.31..0.0).contains(&z), "{hole:?}");
    // The rim and a wall beside it keep off the edge of the foot.
    let edge_mm = 2.0 + request().wall_mm;
    assert!([x, y].iter().all(|c| (edge_mm..40.0 - edge_mm).contains(c)));
    assert_eq!(hole.to_mm[2], 2.3);
}

#[test]
fn a_hole_takes_a_prism_of_the_wall_and_leaves_one_body_without_a_cavity() {
    let hollowed = hollow_box();
    let found = placed(&hollowed, &ONE);
    let hole = &found.plan.drains[0];
    // 48 flats around a circle, through 2 mm.
    let prism_mm3 = 48.0 * (std::f64::consts::PI / 48.0).tan() * 4.0 * 2.0;
    assert!((hole.volume_mm3 / prism_mm3 - 1.0).abs() < 1e-9);
    let drained = found.plan.drained(&hollowed).unwrap();
    assert!((drained.volume() / prism_mm3 - 1.0).abs() < 1e-9);
    let Verdict::Found(parts) = parts(&hollowed, &found.plan, &request()).unwrap() else {
        panic!("no parts")
    };
    let [part] = &parts[..] else {
        panic!("one part")
    };
    let whole_mm3 = hollowed.to_mesh().signed_volume_mm3();
    let lost_mm3 = whole_mm3 - part.solid.mesh().signed_volume_mm3();
    assert!((lost_mm3 / prism_mm3 - 1.0).abs() < 1e-9);
    assert_eq!(crate::mesh::shells(part.solid.mesh()).len(), 1);
    assert_eq!(part.voids, vec![VoidId::of(0)]);
}

#[test]
fn a_plug_is_the_wall_in_its_hole_less_the_gap_and_has_a_flat_inner_end() {
    let hollowed = hollow_box();
    let gap_mm = 0.1;
    let need = DrainNeed {
        plug_gap_mm: Some(gap_mm),
        ..ONE
    };
    let found = placed(&hollowed, &need);
    let [hole] = &found.plan.drains[..] else {
        panic!("one hole")
    };
    // A slope of a quarter over 2.6 mm.
    assert_eq!(hole.diameter_mm, 4.0);
    assert!((hole.mouth_mm - 5.3).abs() < 1e-9, "{hole:?}");
    // The bore is 2.6 mm long, of which 0.3 mm stick out of the wall at either end.
    let area_mm2 = |height_mm: f64, gap_mm: f64| {
        let slope: f64 = 0.25;
        let radius_mm = 2.65 - slope * height_mm - gap_mm * slope.hypot(1.0);
        48.0 * (std::f64::consts::PI / 48.0).tan() * radius_mm * radius_mm
    };
    // Simpson's rule is exact for a frustum.
    let volume_mm3 = |[from, to]: [f64; 2], gap_mm: f64| {
        let [a, b, c] = [from, 0.5 * (from + to), to].map(|at| area_mm2(at, gap_mm));
        (to - from) / 6.0 * (a + 4.0 * b + c)
    };
    let taken_mm3 = volume_mm3([0.3, 2.3], 0.0);
    assert!((hole.volume_mm3 / taken_mm3 - 1.0).abs() < 1e-9, "{hole:?}");
    let plug_mm3 = volume_mm3([0.3, 2.6], gap_mm);
    let left_mm3 = found.plan.drained(&hollowed).unwrap().volume();
    assert!(
        (left_mm3 - (taken_mm3 - plug_mm3)).abs() < 1e-6,
        "{left_mm3}"
    );
    let Verdict::Found(parts) = parts(&hollowed, &found.plan, &request()).unwrap() else {
        panic!("no parts")
    };
    let [body, plug] = &parts[..] else {
        panic!("a body and a plug")
    };
    assert!((plug.solid.mesh().signed_volume_mm3() / plug_mm3 - 1.0).abs() < 1e-9);
    let apart_mm = MeshDistance::new(body.solid.mesh()).min_distance_to(plug.solid.mesh());
    assert!((apart_mm - gap_mm).abs() < 1e-9, "{apart_mm}");
    // It is printed with the wide end up.
    assert!((plug.pose.size_mm[2] - 2.3).abs() < 1e-9, "{:?}", plug.pose);
}

#[test]
fn two_holes_of_a_void_lie_far_apart() {
    for hollowed in [hollow_box(), hollow_ball()] {
        let found = placed(&hollowed, &PAIR);
        let [a, b] = &found.plan.drains[..] else {
            panic!("two holes")
        };
        let apart_mm = (mouth(a) - mouth(b)).norm();
        assert!(apart_mm > 20.0, "{apart_mm}");
    }
}

#[test]
fn resin_leaves_at_the_bottom_and_air_comes_in_at_the_top() {
    let found = placed(&hollow_ball(), &RESIN);
    let [drain, vent] = &found.plan.drains[..] else {
        panic!("two holes")
    };
    assert!(
        drain.from_mm[2] < -17.0 && vent.from_mm[2] > 17.0,
        "{found:?}"
    );
}

#[test]
fn resin_leaves_where_the_part_is_lowest_in_the_printer() {
    let need = DrainNeed {
        printed_up: Some([1.0, 0.0, 0.0]),
        ..RESIN
    };
    let found = placed(&hollow_ball(), &need);
    let [drain, vent] = &found.plan.drains[..] else {
        panic!("two holes")
    };
    assert!(
        drain.from_mm[0] < -19.0 && vent.from_mm[0] > 17.0,
        "{found:?}"
    );
}

#[test]
fn holes_keep_out_of_balls_and_off_the_contact() {
    let hollowed = hollow_ball();
    let usual = placed(&hollowed, &RESIN).plan.drains[1];
    let mut request = request();
    request.axis.point = Point::new(0.0, 0.0, -20.0);
    request.axis.direction = Vector::z();
    request.seams.keep_clear = vec![crate::cut::KeepClear {
        center_mm: usual.from_mm,
        radius_mm: 6.0,
    }];
    let moved = drain(&hollowed, &request, &RESIN).unwrap().plan.drains;
    assert!((mouth(&moved[1]) - mouth(&usual)).norm() > 6.0 + 1.75);
    assert!((mouth(&moved[0]) - request.axis.point).norm() > 2.0 * 3.5);
}

#[test]
fn a_void_behind_thick_walls_or_too_small_for_a_hole_stays_closed() {
    let outer = || cuboid([0.0; 3], [60.0; 3]);
    for body in [ball([30.0; 3], 9.0), cuboid([2.0; 3], [4.0; 3])] {
        let hollowed = Hollowed::new(outer(), vec![body]);
        let found = placed(&hollowed, &ONE);
        assert_eq!(found.closed, vec![VoidId::of(0)]);
        assert_eq!(found.plan.drains, vec![]);
    }
}

#[test]
fn a_hole_that_misses_its_void_leaves_it_closed_and_the_piece_is_refused() {
    let hollowed = hollow_box();
    let mut plan = placed(&hollowed, &ONE).plan;
    plan.drains[0].to_mm[2] = 1.0;
    let refused = parts(&hollowed, &plan, &request()).unwrap();
    assert!(matches!(
        refused,
        Verdict::No(Obstacle::ClosedCavity { cavities: 1, .. })
    ));
}
