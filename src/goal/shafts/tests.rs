//! Bores and shaft ends of shapes whose axes are known.

use std::f64::consts::TAU;

use super::*;
use crate::geom::Frame;
use crate::mesh::{Csg, TriMesh, primitives};

fn find(mesh: TriMesh) -> Vec<ShaftAxis> {
    find_shafts(&Solid::new(mesh).unwrap(), &Watch::silent()).unwrap()
}

fn block(half: [f64; 3]) -> Csg {
    let corner = Point::from(half);
    Csg::of_mesh(&primitives::cuboid(&-corner, &corner)).unwrap()
}

/// Returns a cylinder about a line, from a point on.
fn rod(from: Point, axis: Vector, [radius_mm, length_mm]: [f64; 2]) -> Csg {
    let frame = Frame::with_axis(from, &axis.normalize());
    let upright = primitives::cylinder(radius_mm, length_mm, 64);
    Csg::of_mesh(&upright.map_vertices(|p| frame.to_model(p))).unwrap()
}

fn mesh(csg: &Csg) -> TriMesh {
    csg.to_mesh().unwrap()
}

#[test]
fn a_slanted_bore_is_found_with_its_axis_diameter_and_length() {
    let axis = Vector::new(0.2, -0.1, 1.0).normalize();
    let at = Point::new(5.0, 3.0, 0.0);
    let drill = rod(at - axis * 40.0, axis, [4.0, 80.0]);
    let axes = find(mesh(&block([30.0, 20.0, 10.0]).subtract(&drill).unwrap()));
    let [found] = &axes[..] else {
        panic!("{axes:?}")
    };
    assert!(found.direction.dot(&axis) > 1.0 - 1e-6, "{found:?}");
    assert!((found.point - at).cross(&axis).norm() < 0.01, "{found:?}");
    let [bore] = found.surfaces[..] else {
        panic!("{found:?}")
    };
    assert_eq!(bore.kind, RoundKind::Bore);
    assert!((bore.diameter_mm - 8.0).abs() < 0.02, "{bore:?}");
    // Between the slanted mouths it is 20 mm along z; at its sides it reaches 0.9 mm further.
    assert!((18.0..24.0).contains(&bore.length_mm), "{bore:?}");
}

#[test]
fn two_bearing_seats_on_one_axis_are_one_and_a_second_bore_is_another() {
    let up = Vector::z();
    let body = block([30.0, 15.0, 25.0]);
    let seat = |z: f64| rod(Point::new(-10.0, 0.0, z), up, [6.0, 8.0]);
    let through = rod(Point::new(-10.0, 0.0, -40.0), up, [3.0, 80.0]);
    let other = rod(Point::new(14.0, 0.0, -40.0), up, [4.0, 80.0]);
    let bored = [seat(-26.0), seat(18.0), through, other]
        .iter()
        .try_fold(body, |body, drill| body.subtract(drill));
    let axes = find(mesh(&bored.unwrap()));
    assert_eq!(axes.len(), 2, "{axes:?}");
    let places: Vec<f64> = axes.iter().map(|axis| axis.point.x.round()).collect();
    assert!(
        places.contains(&-10.0) && places.contains(&14.0),
        "{places:?}"
    );
    let stepped = axes.iter().find(|axis| axis.point.x < 0.0).unwrap();
    assert_eq!(stepped.surfaces.len(), 3, "{stepped:?}");
    let wide = |surface: &&RoundSurface| surface.diameter_mm > 10.0;
    let mut seats = stepped.surfaces.iter().filter(wide);
    assert!(
        seats.all(|seat| (6.0..9.0).contains(&seat.length_mm)),
        "{stepped:?}"
    );
}

#[test]
fn a_wheel_on_its_shaft_turns_on_the_shaft() {
    let wheel = rod(Point::new(0.0, 0.0, -5.0), Vector::z(), [30.0, 10.0]);
    let shaft = rod(Point::new(0.0, 0.0, -25.0), Vector::z(), [4.0, 50.0]);
    let axes = find(mesh(&wheel.union(&shaft).unwrap()));
    let [axis] = &axes[..] else {
        panic!("{axes:?}")
    };
    assert!(axis.is_along(&Point::origin(), &Vector::z()));
    assert!(
        axis.surfaces
            .iter()
            .all(|end| end.kind == RoundKind::ShaftEnd)
    );
    assert!((axis.surfaces[0].diameter_mm - 8.0).abs() < 0.02);
}

#[test]
fn discs_balls_blocks_and_dents_have_nothing_to_turn_on() {
    let disc = rod(Point::origin(), Vector::x(), [30.0, 10.0]);
    let dent = primitives::ball(&Point::new(0.0, 0.0, 14.0), 8.0, 4);
    let dented = block([20.0, 20.0, 10.0]).subtract(&Csg::of_mesh(&dent).unwrap());
    let half_pipe = rod(Point::new(-40.0, 0.0, 12.0), Vector::x(), [8.0, 80.0]);
    let gutter = block([20.0, 20.0, 10.0]).subtract(&half_pipe);
    for (name, shape) in [
        ("disc", mesh(&disc)),
        ("ball", primitives::ball(&Point::origin(), 20.0, 5)),
        ("block", mesh(&block([20.0, 10.0, 5.0]))),
        ("dent", mesh(&dented.unwrap())),
        ("gutter", mesh(&gutter.unwrap())),
    ] {
        let axes = find(shape);
        assert!(axes.is_empty(), "{name}: {axes:?}");
    }
}

#[test]
fn the_axes_turn_with_the_model() {
    let drill = rod(Point::new(4.0, 2.0, -40.0), Vector::z(), [5.0, 80.0]);
    let bored = mesh(&block([25.0, 18.0, 12.0]).subtract(&drill).unwrap());
    for turn in 0..5 {
        let angle = TAU * f64::from(turn) / 7.3;
        let up = Vector::new(angle.sin(), 0.4, angle.cos());
        let frame = Frame::with_axis(Point::new(3.0, -2.0, 1.0), &up.normalize());
        let axes = find(bored.map_vertices(|p| frame.to_model(p)));
        let [axis] = &axes[..] else {
            panic!("{turn}: {axes:?}")
        };
        let at = frame.to_model(&Point::new(4.0, 2.0, 0.0));
        assert!(axis.is_along(&at, &frame.axis()), "{turn}: {axis:?}");
    }
}
