use super::*;
use crate::geom::Vector;
use crate::mesh::primitives::{ball, cuboid, torus};
use crate::mesh::{Crossings, Solid, shells};

fn resolve(mesh: &TriMesh) -> Option<Untangled> {
    untangle(mesh, &Watch::silent()).unwrap()
}

/// Returns the volume of the result, which must be a solid that does not cross itself.
fn volume(untangled: Option<Untangled>) -> f64 {
    let mesh = untangled.unwrap().mesh;
    assert_eq!(Crossings::of(&mesh).pairs, 0);
    Solid::new(mesh).unwrap().mesh().signed_volume_mm3()
}

fn at(mesh: &TriMesh, x: f64, y: f64, z: f64) -> TriMesh {
    mesh.map_vertices(|p| p + Vector::new(x, y, z))
}

/// A tube around a line from z = 0 to `sections` − 1, whose ring at z has the radius `radius(z)`
/// and the middle `middle(z)`.
fn tube(sections: usize, radius: impl Fn(f64) -> f64, middle: impl Fn(f64) -> Point) -> TriMesh {
    const SIDES: u32 = 12;
    let mut vertices = Vec::new();
    for section in 0..sections {
        let z = section as f64;
        vertices.extend((0..SIDES).map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(SIDES);
            middle(z) + Vector::new(angle.cos(), angle.sin(), 0.0) * radius(z)
        }));
    }
    let mut triangles = Vec::new();
    for section in 0..sections as u32 - 1 {
        for i in 0..SIDES {
            let (a, b) = (section * SIDES + i, section * SIDES + (i + 1) % SIDES);
            triangles.extend([[a, b, b + SIDES], [a, b + SIDES, a + SIDES]]);
        }
    }
    let top = (sections as u32 - 1) * SIDES;
    triangles.extend((1..SIDES - 1).map(|i| [0, i + 1, i]));
    triangles.extend((1..SIDES - 1).map(|i| [top, top + i, top + i + 1]));
    TriMesh::new(vertices, triangles).unwrap()
}

#[test]
fn boxes_in_general_position_become_one_with_their_common_volume() {
    let cube = cuboid(&Point::origin(), &Point::new(2.0, 2.0, 2.0));
    let found = resolve(&cube.clone().joined(&at(&cube, 0.7, 0.9, 1.1))).unwrap();
    assert!(
        found.pairs > 0 && found.moved_mm < 1e-12,
        "{}",
        found.moved_mm
    );
    assert_eq!(shells(&found.mesh).len(), 1);
    // The common part is 1.3 × 1.1 × 0.9; places of the seam are rounded to some 1e-16.
    let expected = 16.0 - 1.3 * 1.1 * 0.9;
    assert!((volume(Some(found)) - expected).abs() < 1e-12);
}

#[test]
fn boxes_with_faces_in_one_plane_are_moved_aside_by_a_hair() {
    let cube = cuboid(&Point::origin(), &Point::new(2.0, 2.0, 2.0));
    let found = resolve(&cube.clone().joined(&at(&cube, 1.0, 0.0, 0.0))).unwrap();
    let reach_mm = SHAKES[4] * 17f64.sqrt();
    assert!(found.moved_mm <= reach_mm, "{}", found.moved_mm);
    // Each face of at most 6 mm² moves by the reach at most: 28 mm² in all.
    assert!((volume(Some(found)) - 12.0).abs() < 28.0 * reach_mm);
}

#[test]
fn three_bodies_that_meet_in_one_region_are_counted_once() {
    let cube = cuboid(&Point::origin(), &Point::new(4.0, 4.0, 4.0));
    let (b, c) = (at(&cube, 1.1, 1.3, 1.7), at(&cube, 1.9, 0.6, 0.7));
    let all = cube.joined(&b).joined(&c);
    // By inclusion and exclusion: three pairs share boxes, and all three share one.
    let pairs = 2.9 * 2.7 * 2.3 + 2.1 * 3.4 * 3.3 + 3.2 * 3.3 * 3.0;
    let expected = 192.0 - pairs + 2.1 * 2.7 * 2.3;
    let found = volume(resolve(&all));
    assert!((found - expected).abs() < 1e-11, "{found} {expected}");
}

#[test]
fn a_snake_that_bites_itself_loses_the_doubled_part_only() {
    // A tube bent into a little more than a full turn, and raised by less than its thickness.
    let straight = tube(22, |z| 1.5 - 0.01 * z, |z| Point::new(0.0, 0.0, z));
    let snake = straight.map_vertices(|p| {
        let (turn, away) = (0.35 * p.z, 6.0 - p.x);
        Point::new(away * turn.cos(), away * turn.sin(), p.y + 0.05 * p.z)
    });
    let solid = Solid::new(snake.clone()).unwrap();
    assert!(Crossings::of(&snake).pairs > 0);
    let found = volume(resolve(&snake));
    let (low, size) = (snake.aabb().min, snake.aabb().size());
    let steps = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_3,
    ];
    let count = 1 << 18;
    let is_inside = |i: &i32| {
        let unit = steps.map(|step| (step * f64::from(*i)).fract());
        solid
            .bvh()
            .winding(&(low + size.component_mul(&Vector::from(unit))))
            > 0
    };
    let inside = (0..count).filter(is_inside).count() as f64 / f64::from(count);
    let expected = inside * size.product();
    // The winding number of evenly spread points is the oracle; they err by less than the 0.4 % of
    // as many random ones.
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
}

#[test]
fn a_tube_that_turns_inside_out_loses_that_end_and_tells_how_far_it_moved() {
    let width = |z: f64| 3.7 - z;
    let turned = tube(9, width, |z| Point::new(0.0, 0.0, z));
    // Only x goes through zero, so that the far end is a mirror image: inside out.
    let turned = turned.map_vertices(|p| Point::new(p.x, 2.0 * p.y / width(p.z), p.z));
    let found = resolve(&turned).unwrap();
    assert!(found.moved_mm > 1.0, "{}", found.moved_mm);
    // A section of twelve corners has the area 3 · width · 2, up to where the width is zero. There
    // the sides are cut along diagonals, which a share of 3 % allows for.
    let expected = 6.0 * 3.7 * 3.7 / 2.0;
    let volume = volume(Some(found));
    assert!((volume / expected - 1.0).abs() < 0.03, "{volume}");
}

#[test]
fn a_side_pierced_by_very_many_spikes_is_given_up() {
    let plate = cuboid(&Point::new(0.0, 0.0, -1.0), &Point::new(100.0, 100.0, 0.0));
    let spike = cuboid(&Point::new(0.1, 0.2, -0.5), &Point::new(0.6, 0.7, 0.5));
    let spikes = (0..300).map(|i| {
        at(
            &spike,
            f64::from(i % 20) * 2.0 + 50.0,
            f64::from(i / 20),
            0.0,
        )
    });
    let all = spikes.fold(plate, |all, spike| all.joined(&spike));
    assert!(resolve(&all).is_none());
}

#[test]
fn sound_surfaces_are_left_alone() {
    for mesh in [torus(3.0, 1.0, 20, 10), ball(&Point::origin(), 1.0, 2)] {
        assert!(resolve(&mesh).is_none());
    }
}

#[test]
fn many_random_boxes_have_the_volume_of_their_union_by_booleans() {
    let cube = cuboid(&Point::origin(), &Point::new(1.0, 1.3, 0.9));
    let mut state = 7u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as f64 / f64::from(1u32 << 31)
    };
    let mut all = TriMesh::default();
    let mut union: Option<Csg> = None;
    for _ in 0..12 {
        let axis = nalgebra::Unit::new_normalize(Vector::new(next(), next(), next() + 0.1));
        let turn = nalgebra::Rotation3::from_axis_angle(&axis, 6.0 * next());
        let by = Vector::new(next(), next(), next()) * 1.5;
        let one = cube.map_vertices(|p| turn * p + by);
        all = all.joined(&one);
        let body = Csg::of_mesh(&one).unwrap();
        union = Some(match union {
            Some(sum) => sum.union(&body).unwrap(),
            None => body,
        });
    }
    let expected = union.unwrap().to_mesh().unwrap().signed_volume_mm3();
    let found = volume(resolve(&all));
    assert!((found - expected).abs() < 1e-6, "{found} {expected}");
}
