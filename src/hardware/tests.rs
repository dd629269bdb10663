//! Hardware against closed forms: halves moved apart, sockets, axles and tips.

use std::f64::consts::PI;

use super::*;
use crate::geom::{Point, Vector};
use crate::goal::{Contact, GoalKind, Placement, Request, SpinPoint, Up, place};
use crate::mass::{Body, Moments, RoundBar, moments_of_mesh};
use crate::mesh::{Csg, TriMesh, bodies, primitives};

/// A ball of radius 20: its 81920 triangles fall short of it by less than 2e-4 of its volume.
const RADIUS: f64 = 20.0;
const ROUND: f64 = 2e-4;

fn ball() -> Solid {
    Solid::new(primitives::ball(&Point::origin(), RADIUS, 6)).unwrap()
}

fn block(size: [f64; 3]) -> Solid {
    Solid::new(primitives::cuboid(&Point::origin(), &Point::from(size))).unwrap()
}

fn yoyo(gap: &str, axle: &str) -> Request {
    let hardware = Hardware {
        string_gap: gap.parse().ok(),
        axle: axle.parse().ok(),
        ..Hardware::default()
    };
    Request {
        hardware: Some(hardware),
        ..Request::new(GoalKind::Yoyo)
    }
}

fn top(tip: Option<&str>, stem: Option<&str>) -> Request {
    let rod = |text: &str| text.parse().unwrap();
    let hardware = Hardware {
        tip: tip.map(rod),
        stem: stem.map(rod),
        ..Hardware::default()
    };
    Request {
        hardware: Some(hardware),
        contact: Some(Contact::Center),
        ..Request::new(GoalKind::Top)
    }
}

/// Fits the hardware with no clearance and walls of 1 mm.
fn fit(solid: &Solid, request: &Request) -> (Placement, Result<Fitted, FitError>) {
    let placement = place(solid, 1.0, request).unwrap();
    let allowances = Allowances {
        clearance_mm: 0.0,
        wall_mm: 1.0,
    };
    let result = fit_hardware(
        solid,
        &placement.goal,
        &request.hardware.unwrap(),
        &allowances,
    );
    (placement, result.map(Option::unwrap))
}

/// Returns the moments of a cylinder of unit density about z through the origin, from z = `low` to
/// `high`.
fn upright(radius_mm: f64, [low, high]: [f64; 2]) -> Moments {
    RoundBar::plain(
        Point::new(0.0, 0.0, low),
        Point::new(0.0, 0.0, high),
        radius_mm,
    )
    .moments()
}

#[test]
fn a_balls_halves_moved_apart_have_the_inertia_of_the_parallel_axes() {
    // Mass m, radius R. About the axis the moment stays 2mR²/5. Across it each half's centre lies
    // 3R/8 from the cut, so that moving each by g/2 adds m (3R/8 · g + g²/4). The sockets are taken
    // out of the moved halves.
    let (gap, depth, bore) = (3.0, 8.0, 2.0);
    let (_, fitted) = fit(&ball(), &yoyo("3mm", "4mm"));
    let fitted = fitted.unwrap();
    let socket = upright(bore, [0.5 * gap, 0.5 * gap + depth])
        + upright(bore, [-0.5 * gap - depth, -0.5 * gap]);
    let body = Body::new(&(moments_of_mesh(fitted.solid.mesh()) + socket), 1.0);
    let mass = 4.0 / 3.0 * PI * RADIUS.powi(3);
    let about = 0.4 * mass * RADIUS * RADIUS;
    let across = about + mass * (0.375 * RADIUS * gap + 0.25 * gap * gap);
    assert!((body.mass_g / mass - 1.0).abs() < ROUND);
    assert!(
        (body.inertia_g_mm2[(2, 2)] / about - 1.0).abs() < 2.0 * ROUND,
        "{}",
        body.inertia_g_mm2
    );
    assert!(
        (body.inertia_g_mm2[(0, 0)] / across - 1.0).abs() < 2.0 * ROUND,
        "{}",
        body.inertia_g_mm2
    );
    assert!(body.center.coords.norm() < 1e-3);
}

#[test]
fn the_axle_weighs_what_a_steel_cylinder_weighs_and_counts_by_its_density() {
    let (_, fitted) = fit(&ball(), &yoyo("3mm", "4mm"));
    let fitted = fitted.unwrap();
    let length: f64 = 3.0 + 2.0 * 2.0 * 4.0;
    let moments = fitted.moments(1.57);
    // Steel of 7.85 g/cm³ counts five times a material of 1.57.
    assert!((moments.volume() / (5.0 * 4.0 * PI * length) - 1.0).abs() < 1e-12);
    assert!((moments.0[9] / (5.0 * 4.0 * PI * length.powi(3) / 12.0) - 1.0).abs() < 1e-12);
    assert_eq!((fitted.pieces.len(), fitted.gap_mm), (1, 3.0));
    assert_eq!(
        (fitted.pieces[0].depth_mm, fitted.pieces[0].bore_mm),
        (8.0, 4.0)
    );
}

#[test]
fn nuts_and_bearings_have_the_mass_that_was_given() {
    let mut request = yoyo("3mm", "4mm");
    request.hardware = request.hardware.map(|hardware| Hardware {
        mass_g: Some(2.5),
        ..hardware
    });
    let fitted = fit(&ball(), &request).1.unwrap();
    let ring = fitted.pieces[1];
    assert_eq!(ring.kind, Kind::Ring);
    let body = Body::new(&ring.bar.moments(), ring.density_g_cm3 / 1000.0);
    assert!((body.mass_g - 2.5).abs() < 1e-12);
    // m (R² + r²)/2 about the axle, with R = 4 and r = 2.
    assert!((body.inertia_g_mm2[(2, 2)] - 2.5 * (16.0 + 4.0) / 2.0).abs() < 1e-9);
}

#[test]
fn the_cut_passes_through_the_spin_point_that_was_chosen() {
    let at = [0.0, 0.0, 5.0];
    let request = Request {
        spin_point: Some(SpinPoint::At(at)),
        ..yoyo("2mm", "3mmx10mm")
    };
    let (placement, fitted) = fit(&ball(), &request);
    let fitted = fitted.unwrap();
    let mut halves = bodies(fitted.solid.mesh());
    halves.sort_by(|a, b| a.signed_volume_mm3().total_cmp(&b.signed_volume_mm3()));
    // The cap above z = 5 of height h = 15 has the volume πh²(3R − h)/3; its socket goes 4 mm deep.
    let cap = PI * 225.0 * (3.0 * RADIUS - 15.0) / 3.0 - PI * 1.5 * 1.5 * 4.0;
    assert!((halves[0].signed_volume_mm3() / cap - 1.0).abs() < 5.0 * ROUND);
    let q = placement.goal.frame.origin;
    assert_eq!(q, Point::from(at));
    assert!(
        (halves[0].aabb().min.z - 6.0).abs() < 1e-3 && (halves[1].aabb().max.z - 4.0).abs() < 1e-3
    );
}

#[test]
fn an_axle_goes_as_deep_as_both_halves_allow_and_never_breaks_out() {
    // A plate 10 mm thick has 5 mm on each side of its middle, 1 mm of it wall. So a 3 mm axle goes
    // 3.75 mm deep, 1.25 diameters.
    let plate = block([40.0, 40.0, 10.0]);
    let fitted = fit(&plate, &yoyo("2mm", "3mm")).1.unwrap();
    assert_eq!(fitted.pieces[0].depth_mm, 3.75);
    let refused = fit(&plate, &yoyo("2mm", "3mmx11mm")).1;
    let Err(FitError::Seat(SeatError::BreaksOut { depth_mm, .. })) = refused else {
        panic!("{refused:?}")
    };
    assert_eq!(depth_mm, 4.5);
    // A bolt right through is no socket that comes out.
    let through = fit(&plate, &yoyo("2mm", "3mmx30mm")).1.unwrap();
    let drilled = 2.0 * 5.0 * (1600.0 - PI * 2.25);
    assert!((through.solid.mesh().signed_volume_mm3() / drilled - 1.0).abs() < 1e-4);
}

#[test]
fn a_piece_that_the_cut_separates_stays_with_the_half_it_grows_from() {
    // A block with a hook: an arm out of its lower half that ends in a finger pointing up past the
    // middle.
    let csg = |min: [f64; 3], max: [f64; 3]| {
        Csg::of_mesh(&primitives::cuboid(&min.into(), &max.into())).unwrap()
    };
    let arm = csg([10.0, -2.0, -9.0], [20.0, 2.0, -5.0])
        .union(&csg([16.0, -2.0, -9.0], [20.0, 2.0, 6.0]))
        .unwrap();
    let hooked = csg([-12.0, -12.0, -10.0], [12.0, 12.0, 10.0])
        .union(&arm)
        .unwrap()
        .to_solid()
        .unwrap();
    let request = Request {
        spin_point: Some(SpinPoint::At([0.0; 3])),
        ..yoyo("2mm", "4mm")
    };
    let fitted = fit(&hooked, &request).1.unwrap();
    let volumes: Vec<f64> = bodies(fitted.solid.mesh())
        .iter()
        .map(TriMesh::signed_volume_mm3)
        .collect();
    let socket = PI * 4.0 * 8.0;
    let (block, finger) = (24.0 * 24.0 * 10.0, 16.0 * 6.0);
    let arm_below = 8.0 * 4.0 * 4.0 + 16.0 * 5.0;
    let found = volumes.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(volumes.len(), 2);
    assert!((found / (block - socket) - 1.0).abs() < 1e-4, "{found}");
    let whole: f64 = volumes.iter().sum();
    assert!(
        (whole / (2.0 * (block - socket) + finger + arm_below) - 1.0).abs() < 1e-4,
        "{whole}"
    );
}

#[test]
fn a_top_touches_with_the_end_of_its_tip_and_stands_higher_by_as_much() {
    let solid = block([30.0, 30.0, 12.0]);
    let (placement, fitted) = fit(&solid, &top(Some("4mmx10mmx6mm"), Some("5mmx20mmx5mm")));
    let fitted = fitted.unwrap();
    assert!((placement.goal.frame.origin - Point::new(15.0, 15.0, -4.0)).norm() < 1e-12);
    assert!(placement.keeps.is_empty() && placement.warnings.is_empty());
    let [tip, stem] = fitted.pieces[..] else {
        panic!("{fitted:?}")
    };
    assert!((tip.bar.to - placement.goal.frame.origin).norm() < 1e-12 && tip.bar.is_round);
    assert!((tip.bar.from.z - 6.0).abs() < 1e-12);
    assert!((stem.bar.from.z - 7.0).abs() < 1e-12 && (stem.bar.to.z - 27.0).abs() < 1e-12);
    let sockets = PI * (4.0 * 6.0 + 6.25 * 5.0);
    // A socket of 48 sides about its circle is larger by 0.14 %.
    let taken = 30.0 * 30.0 * 12.0 - fitted.solid.mesh().signed_volume_mm3();
    assert!(taken > sockets && taken < sockets * 1.0015, "{taken}");
}

#[test]
fn a_heavier_tip_puts_the_centre_of_the_same_top_lower() {
    let solid = block([30.0, 30.0, 12.0]);
    let height = |tip: &str| {
        let (placement, fitted) = fit(&solid, &top(Some(tip), None));
        let fitted = fitted.unwrap();
        let whole = moments_of_mesh(fitted.solid.mesh()) + fitted.moments(1.18);
        Body::new(&whole.in_frame(&placement.goal.frame), 1.0)
            .center
            .z
    };
    let [light, steel, tungsten] =
        ["6mmx10mmx5mm:1.18", "6mmx10mmx5mm", "6mmx10mmx5mm:19.3"].map(height);
    assert!(
        tungsten < steel && steel < light,
        "{tungsten} {steel} {light}"
    );
}

#[test]
fn a_socket_in_a_sharp_point_is_refused_for_lack_of_a_wall() {
    // An octahedron on its corner is as wide as it is high there. At a height of 3 mm it has no
    // wall of 1 mm around a 4 mm rod.
    let corner = |x: f64, y: f64, z: f64| Point::new(20.0 * x, 20.0 * y, 20.0 * z);
    let vertices = vec![
        corner(1., 0., 0.),
        corner(-1., 0., 0.),
        corner(0., 1., 0.),
        corner(0., -1., 0.),
        corner(0., 0., 1.),
        corner(0., 0., -1.),
    ];
    let faces = [
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    let solid = Solid::new(TriMesh::new(vertices, faces.to_vec()).unwrap()).unwrap();
    let held = |tip: &str| fit(&solid, &top(Some(tip), None)).1;
    assert!(matches!(
        held("4mmx8mmx3mm"),
        Err(FitError::Seat(SeatError::BreaksOut { rod: Kind::Tip, .. }))
    ));
    assert!(matches!(
        held("4mmx12mmx6mm"),
        Err(FitError::Seat(SeatError::HardlyHeld { .. }))
    ));
    assert!(held("4mmx20mmx14mm").is_ok());
}

#[test]
fn a_turned_axis_gives_the_same_halves() {
    let solid = block([30.0, 24.0, 36.0]);
    let along = |up: Up| {
        let (placement, fitted) = fit(
            &solid,
            &Request {
                up,
                ..yoyo("3mm", "4mm")
            },
        );
        let local = moments_of_mesh(fitted.unwrap().solid.mesh()).in_frame(&placement.goal.frame);
        Body::new(&local, 1.0).inertia_g_mm2[(2, 2)]
    };
    // The cut itself is moved by micrometres to be clear of vertices.
    assert!((along(Up::X) / along(Up::NegX) - 1.0).abs() < 1e-6);
    let tilted = along(Up::Along(Vector::new(1.0, 1e-9, 0.0).into()));
    assert!((tilted / along(Up::X) - 1.0).abs() < 1e-6);
}
