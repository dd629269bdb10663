//! Tests of whole poses: support, cups and the choice.

use super::choice::{PoseRules, Want, rank_poses};
use super::columns::Columns;
use super::cups::{cup_volume_mm3, find_cups};
use super::shape::{Peg, Shape, Side};
use super::support::{Support, SupportRule, find_overhangs};
use crate::base::watch::Watch;
use crate::geom::{Point, Vector};
use crate::mesh::{Csg, TriMesh, primitives};

const RULE: SupportRule = SupportRule {
    overhang_deg: 45.0,
    layer_mm: 0.2,
};

fn block(low: [f64; 3], high: [f64; 3]) -> Csg {
    Csg::of_mesh(&primitives::cuboid(&low.into(), &high.into())).unwrap()
}

/// Returns a top of 20 by 20 by 2 mm on a leg of 10 by 10 by 20 mm.
fn table() -> TriMesh {
    let top = block([-5.0, -5.0, 20.0], [15.0, 15.0, 22.0]);
    let leg = block([0.0; 3], [10.0, 10.0, 20.0]);
    leg.union(&top).unwrap().to_mesh().unwrap()
}

/// Returns a block of 20 mm with a hollow of 10 by 10 mm that is 12 mm deep, open at its top.
fn cup() -> TriMesh {
    let hollow = block([5.0, 5.0, 8.0], [15.0, 15.0, 25.0]);
    let body = block([0.0; 3], [20.0; 3]);
    body.subtract(&hollow).unwrap().to_mesh().unwrap()
}

fn support(mesh: &TriMesh, up: Vector) -> Support {
    let shape = Shape::plain(mesh);
    Support::of(&shape, &Columns::of(&shape, &up, 0.25), &up, &RULE)
}

fn best(shape: &Shape, faces: &[Vector], want: Want) -> Vector {
    let rules = PoseRules { want, wall_mm: 2.0 };
    rank_poses(shape, faces, &rules, &Watch::silent()).unwrap()[0]
}

#[test]
fn the_support_of_a_table_is_a_ring_of_columns_around_its_leg() {
    let found = support(&table(), Vector::z());
    // A line more or less along a rim of 80 + 40 mm is 30 mm².
    for (value, want, slack) in [
        (found.outside_mm2, 300.0, 30.0),
        (found.columns_mm3, 6000.0, 600.0),
        (found.sides_mm2, 2400.0, 120.0),
        (found.foot_mm2, 100.0, 10.0),
    ] {
        assert!(
            (value - want).abs() <= slack,
            "{value} for {want}: {found:?}"
        );
    }
    let turned = support(&table(), -Vector::z());
    assert_eq!((turned.columns_mm3, turned.outside_mm2), (0.0, 0.0));
}

#[test]
fn support_in_a_hollow_stands_on_the_part() {
    let body = block([0.0; 3], [20.0; 3]);
    let tunnel = block([-1.0, 5.0, 4.0], [21.0, 15.0, 16.0]);
    let mesh = body.subtract(&tunnel).unwrap().to_mesh().unwrap();
    let found = support(&mesh, Vector::z());
    assert!((found.columns_mm3 - 2400.0).abs() < 240.0, "{found:?}");
}

#[test]
fn the_underside_of_a_table_is_an_overhang_and_its_feet_are_not() {
    let mesh = table();
    let held = find_overhangs(&mesh, &RULE);
    let area = |index: usize| {
        let [a, b, c] = mesh.corners(index);
        0.5 * (b - a).cross(&(c - a)).norm()
    };
    let held_mm2: f64 = (0..held.len()).filter(|i| held[*i]).map(area).sum();
    assert!((held_mm2 - 300.0).abs() < 1e-9, "{held_mm2}");
}

#[test]
fn a_cup_is_open_toward_the_film_or_flat_on_the_platform_but_not_when_it_leans() {
    let mesh = cup();
    let shape = Shape::plain(&mesh);
    let enclosed = |up: Vector| cup_volume_mm3(&Columns::of(&shape, &up.normalize(), 0.5));
    for up in [Vector::z(), -Vector::z()] {
        // A line more or less on either side of the 10 mm.
        assert!((enclosed(up) - 1200.0).abs() < 120.0, "{}", enclosed(up));
    }
    assert_eq!(enclosed(Vector::new(0.0, 0.6, -0.8)), 0.0);
    // On its side, its floor is at the same level as its mouth's lower edge.
    assert!(enclosed(Vector::y()) < 30.0);
    assert!(enclosed(Vector::new(0.0, 0.8, 0.6)) > 300.0);
}

#[test]
fn a_cup_is_found_with_its_floor_and_its_inside() {
    let (mesh, other) = (
        cup(),
        cup().map_vertices(|p| p + Vector::new(40.0, 0.0, 3.0)),
    );
    let both = mesh.joined(&other);
    let columns = Columns::of(&Shape::plain(&both), &Vector::z(), 0.5);
    let cups = find_cups(&columns);
    assert_eq!(cups.len(), 2, "{cups:?}");
    let sum: f64 = cups.iter().map(|cup| cup.volume_mm3).sum();
    assert!((sum - cup_volume_mm3(&columns)).abs() < 1e-6);
    for cup in &cups {
        assert!((cup.body.signed_volume_mm3() - cup.volume_mm3).abs() < 1e-6);
        let floor = both.corners(cup.floor.unwrap() as usize);
        let inside = cup.body.aabb();
        assert!(floor.iter().all(|p| (p.z - inside.min.z).abs() < 1e-9));
        // A line more or less on either side of the 10 by 10 by 12 mm.
        let size = inside.size();
        assert!(
            (size.x - 10.0).abs() < 1.0 && (size.y - 10.0).abs() < 1.0,
            "{size}"
        );
        assert!((size.z - 12.0).abs() < 1e-9, "{size}");
    }
}

#[test]
fn cups_are_found_where_they_are_in_a_leaning_part() {
    let mesh = cup();
    let up = Vector::new(0.0, 0.3, 1.0).normalize();
    let cups = find_cups(&Columns::of(&Shape::plain(&mesh), &up, 0.25));
    let inside = cups[0].body.aabb();
    // The hollow is x and y from 5 to 15 and z from 8; a cell's corner may stick out of it.
    assert!(inside.min.x > 4.7 && inside.max.x < 15.3, "{inside:?}");
    assert!(inside.min.y > 4.7 && inside.max.y < 15.3, "{inside:?}");
    assert!(inside.min.z > 7.7, "{inside:?}");
}

#[test]
fn a_table_is_printed_on_its_top_unless_pins_stand_there() {
    let mesh = table();
    let want = Want::LittleSupport(RULE);
    assert!(best(&Shape::plain(&mesh), &[], want).z < -0.999);
    let peg = Peg {
        center: Point::new(5.0, 5.0, 22.0),
        axis: Vector::z(),
        length_mm: 3.0,
        diameter_mm: 3.0,
    };
    let pin = block([3.5, 3.5, 21.0], [6.5, 6.5, 25.0]);
    let pinned = Csg::of_mesh(&mesh)
        .unwrap()
        .union(&pin)
        .unwrap()
        .to_mesh()
        .unwrap();
    let shape = Shape::new(&pinned, vec![peg], |_| Side::Outside);
    let up = best(&shape, &[Vector::z()], want);
    assert!(up.z > -0.9, "{up}");
}

#[test]
fn a_cup_leans_with_its_mouth_toward_the_platform_of_a_vat() {
    let mesh = cup();
    let up = best(&Shape::plain(&mesh), &[Vector::z()], Want::NoCup(RULE));
    assert!(up.z < 0.2 && up.z > -0.985, "{up}");
    let shape = Shape::plain(&mesh);
    assert!(cup_volume_mm3(&Columns::of(&shape, &up, 0.5)) < 150.0);
}

#[test]
fn a_line_through_a_solid_has_a_gap_below_and_one_above() {
    let mesh = table();
    let columns = Columns::of(&Shape::plain(&mesh), &Vector::z(), 1.0);
    let counts = |line: usize| columns.gaps(line).len();
    let through = (0..columns.lines())
        .filter(|line| counts(*line) == 2)
        .count();
    assert!((through as i64 - 400).abs() <= 40, "{through}");
    assert!((0..columns.lines()).all(|line| counts(line) <= 2));
}
