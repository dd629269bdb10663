//! Thin features of shapes whose widths are known.

use super::*;
use crate::geom::Point;
use crate::mesh::{Csg, primitives};

fn cuboid(min: [f64; 3], max: [f64; 3]) -> Csg {
    Csg::of_mesh(&primitives::cuboid(&min.into(), &max.into())).unwrap()
}

fn thin(shapes: &[Csg]) -> ThinFeatures {
    let whole = shapes[1..]
        .iter()
        .try_fold(shapes[0].clone(), |whole, shape| whole.union(shape));
    let mesh = whole.unwrap().to_mesh().unwrap();
    find_thin(&mesh, 1.0, &Watch::silent()).unwrap()
}

fn block() -> Csg {
    cuboid([-10.0, -10.0, -10.0], [10.0, 10.0, 10.0])
}

#[test]
fn edges_and_corners_of_a_thick_body_are_no_thin_features() {
    let found = thin(&[block()]);
    assert!(found.lost.is_empty() && found.ends.is_empty() && found.necks.is_empty());
}

#[test]
fn a_thin_pin_is_lost_and_a_thick_one_is_not() {
    let pin = |half: f64| cuboid([-half, -half, 5.0], [half, half, 18.0]);
    let found = thin(&[block(), pin(0.4)]);
    let [lost] = found.lost[..] else {
        panic!("{found:?}")
    };
    assert!((7.0..=9.0).contains(&lost.length_mm), "{lost:?}");
    assert!(lost.at.z > 17.0, "{lost:?}");
    let kept = thin(&[block(), pin(0.6)]);
    assert!(kept.lost.is_empty() && kept.ends.is_empty(), "{kept:?}");
}

#[test]
fn a_thin_fin_is_lost_and_a_short_one_only_told() {
    let fin = |top: f64| cuboid([-8.0, -0.35, 5.0], [8.0, 0.35, top]);
    let lost = thin(&[block(), fin(16.0)]);
    assert_eq!((lost.lost.len(), lost.ends.len()), (1, 0), "{lost:?}");
    let short = thin(&[block(), fin(12.0)]);
    assert_eq!((short.lost.len(), short.ends.len()), (0, 1), "{short:?}");
}

#[test]
fn a_ball_on_a_thin_neck_comes_off() {
    let ball = primitives::ball(&Point::new(0.0, 0.0, 20.0), 5.0, 4);
    let ball = Csg::of_mesh(&ball).unwrap();
    let neck = |half: f64| cuboid([-half, -half, 5.0], [half, half, 20.0]);
    let found = thin(&[block(), ball.clone(), neck(0.4)]);
    assert_eq!(found.necks.len(), 1, "{found:?}");
    assert!((found.necks[0].at.z - 20.0).abs() < 1.0, "{found:?}");
    let held = thin(&[block(), ball, neck(0.7)]);
    assert!(held.necks.is_empty() && held.lost.is_empty(), "{held:?}");
}

#[test]
fn two_bodies_side_by_side_hang_by_no_neck() {
    let beside = cuboid([12.0, -5.0, -5.0], [20.0, 5.0, 5.0]);
    let found = thin(&[block(), beside]);
    assert!(found.necks.is_empty(), "{found:?}");
}
