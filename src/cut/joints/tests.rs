//! Tests of bosses, dowels and glue films on bodies with known answers.

use crate::{
    cut::{
        joints::pin_shape::SIDES,
        scenes::{ball, cuboid, parts, plan, plan_by, request, with_balls},
        tests::{assert_volumes_add_up, cuts, kit},
        *,
    },
    geom::{Point, Quadric, Vector},
    mesh::Csg,
};

/// Returns a spherical shell too thin for pins, with a plan that cuts it through its centre.
fn thin_shell() -> (Hollowed, CutPlan) {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 23.5]]);
    let plan = plan(&body, &request()).unwrap();
    assert!(plan.pins.is_empty());
    (body, plan)
}

fn order_of<'a>(
    hollowed: &'a Hollowed,
    plan: &'a CutPlan,
    price: Quadric,
    request: &'a PlanRequest,
) -> BossRequest<'a> {
    let price = MaterialPrice {
        quadric: price,
        frame: crate::geom::Frame::identity(),
    };
    BossRequest {
        hollowed,
        request,
        plan,
        ordered: None,
        given_up: &[],
        refused: &[],
        price,
    }
}

fn found_bosses(request: &BossRequest) -> Vec<Boss> {
    bosses(request).unwrap().found().unwrap()
}

fn bosses_of(body: &Hollowed, plan: &CutPlan, price: Quadric) -> Vec<Boss> {
    found_bosses(&order_of(body, plan, price, &request()))
}

/// The same price everywhere.
const UNIFORM: Quadric = Quadric([1.0, 0., 0., 0., 0., 0., 0., 0., 0., 0.]);

/// Returns the body with bosses kept solid in its one void.
fn keep_solid(body: &Hollowed, bosses: &[Boss]) -> Hollowed {
    let void = Csg::of_solid(&body.voids[0].body).unwrap();
    let bodies = bosses.iter().map(|boss| Csg::of_mesh(&boss.body).unwrap());
    let rest = bodies.fold(void, |rest, boss| rest.subtract(&boss).unwrap());
    Hollowed::new(body.outer.clone(), vec![rest.to_solid().unwrap()])
}

#[test]
fn bosses_give_a_thin_shell_two_pins_that_fit_one_way_with_the_wall_around_them() {
    let (body, plan) = thin_shell();
    let found = bosses_of(&body, &plan, UNIFORM);
    assert_eq!(found.len(), 2);
    let body = keep_solid(&body, &found);
    let order = CutOrder {
        pins: Some(found.iter().map(|boss| boss.pin.clone()).collect()),
        ..CutOrder::of(&plan)
    };
    let plan = plan_around(&body, &request(), &order)
        .unwrap()
        .found()
        .unwrap();
    assert!(
        plan.joints[0].one_way && plan.pins.len() == 2,
        "{:?}",
        plan.notes
    );
    assert!(plan.voids[0].opening_mm >= request().min_opening_mm);
    assert!(
        bosses_of(&body, &plan, UNIFORM).is_empty(),
        "one round is enough"
    );
    let surface = crate::geom::Bvh::new(body.to_mesh().iter_corners());
    for pin in &plan.pins {
        let mouth = Point::from(pin.center_mm);
        let bottom = mouth + Vector::from(pin.direction) * pin.socket_depth_mm;
        let room_mm =
            surface.segment_distance(&mouth, &bottom, f64::INFINITY) - pin.socket_diameter_mm / 2.0;
        assert!(room_mm >= request().wall_mm, "{room_mm}");
    }
    assert_volumes_add_up(&body, &parts(&body, &plan, &request()).unwrap());
}

#[test]
fn a_round_joint_that_two_bosses_do_not_hold_gets_three() {
    let (body, plan) = thin_shell();
    let patterns = |max_step_mm: f64| {
        let usual = request();
        let pins = PinSettings {
            max_step_mm: Some(max_step_mm),
            ..usual.pins
        };
        let request = PlanRequest { pins, ..usual };
        found_bosses(&order_of(&body, &plan, UNIFORM, &request)).len()
    };
    // The rim has 25 mm, and pins in bosses about 22 mm. They have 0.1 mm to move, and up to half a
    // pixel. Two pins let the rim move 1.5 times as far, three 1.26 times. What even three do not
    // hold gets one, to find its place.
    assert_eq!([0.3, 0.15, 0.1].map(patterns), [2, 3, 1]);
}

#[test]
fn two_pins_that_close_the_void_are_found_if_no_place_leaves_it_open() {
    // A tube of 10 mm whose bore of 7 mm must stay open over nearly its whole width.
    let body = Hollowed::new(
        cuboid([0.0; 3], [10.0, 10.3, 60.0]),
        vec![cuboid([1.5, 1.5, 2.0], [8.5, 8.8, 58.0])],
    );
    let request = PlanRequest {
        min_opening_mm: 6.5,
        ..request()
    };
    let across = Cut {
        id: "C1".into(),
        point_mm: [0.0, 0.0, 30.0],
        normal: [0.0, 0.0, 1.0],
        within: Vec::new(),
    };
    let plan = plan_by(&body, &request, &cuts(vec![across])).unwrap();
    let order = order_of(&body, &plan, UNIFORM, &request);
    let found = found_bosses(&order);
    assert_eq!(found.len(), 2);
    let left = plan_by(&keep_solid(&body, &found), &request, &CutOrder::of(&plan));
    assert!(left.map_or(0.0, |plan| plan.voids[0].opening_mm) < request.min_opening_mm);
    // A joint that was given up gets no bosses.
    let given_up = [found[0].joint()];
    assert_eq!(
        found_bosses(&BossRequest {
            given_up: &given_up,
            ..order
        }),
        vec![]
    );
}

#[test]
fn bosses_stand_where_material_is_cheapest() {
    let (body, plan) = thin_shell();
    let cut = plan.cuts[0].plane().unwrap();
    let (u, _) = cut.basis();
    // The price grows along u, so both pins lie on the far side of the centre.
    let slope = Quadric([30.0, u.x, u.y, u.z, 0., 0., 0., 0., 0., 0.]);
    let found = bosses_of(&body, &plan, slope);
    assert_eq!(found.len(), 2);
    let sum: f64 = found
        .iter()
        .map(|boss| u.dot(&Vector::from(boss.pin.center_mm)))
        .sum();
    assert!(sum < -10.0, "{sum}");
    let apart = (Point::from(found[0].pin.center_mm) - Point::from(found[1].pin.center_mm)).norm();
    assert!(apart > 15.0, "{apart}");
}

#[test]
fn ordered_pins_in_air_get_bosses_and_no_others_do() {
    let (body, plan) = thin_shell();
    let pins: Vec<PinSite> = bosses_of(&body, &plan, UNIFORM)
        .into_iter()
        .map(|boss| boss.pin)
        .collect();
    let price = MaterialPrice {
        quadric: UNIFORM,
        frame: crate::geom::Frame::identity(),
    };
    let count_bosses = |pins: &[PinSite]| {
        let order = BossRequest {
            hollowed: &body,
            request: &request(),
            plan: &plan,
            ordered: Some(pins),
            given_up: &[],
            refused: &[],
            price,
        };
        found_bosses(&order).len()
    };
    assert_eq!(
        (
            count_bosses(&pins),
            count_bosses(&pins[..1]),
            count_bosses(&[])
        ),
        (2, 1, 0)
    );
    let outside = PinSite {
        center_mm: (Vector::from(pins[0].center_mm) * 3.0).into(),
        ..pins[0].clone()
    };
    assert_eq!(count_bosses(&[outside]), 0);
}

#[test]
fn dowels_have_a_socket_in_either_part_and_leave_all_cut_faces_flat() {
    let request = PlanRequest {
        rods: rods().unwrap(),
        ..request()
    };
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let (plan, parts) = kit(&body, &request);
    assert!(
        plan.pins.len() >= 2 && plan.joints[0].one_way,
        "{:?}",
        plan.notes
    );
    let surface = crate::geom::Bvh::new(body.to_mesh().iter_corners());
    for pin in &plan.pins {
        let dowel = pin.dowel.as_ref().unwrap();
        assert_eq!(dowel.length_mm, 2.0 * pin.length_mm);
        let [first, second] =
            [0, 1].map(|part: usize| parts[part].sockets.iter().find(|s| s.id == pin.id).unwrap());
        assert_eq!(
            Vector::from(first.direction),
            -Vector::from(second.direction)
        );
        let end = |socket: &PinSite| {
            Point::from(socket.center_mm) + Vector::from(socket.direction) * socket.socket_depth_mm
        };
        let room_mm = surface.segment_distance(&end(first), &end(second), f64::INFINITY);
        assert!(room_mm - pin.socket_diameter_mm / 2.0 >= request.wall_mm);
    }
    for part in &parts {
        assert!(
            part.pins.is_empty() && matches!(part.pose.lies, Lie::CutFaceDown(_)),
            "{}",
            part.pose.lies
        );
    }
    let text = CutOrder::of(&plan).to_toml().unwrap();
    let order = CutOrder::from_toml("cuts.toml", &text).unwrap();
    assert_eq!(plan_by(&body, &request, &order).unwrap().pins, plan.pins);
}

#[test]
fn no_two_dowelled_joints_can_be_confused_from_either_side() {
    let request = PlanRequest {
        rods: rods().unwrap(),
        ..request()
    };
    let body = with_balls(cuboid([0.0; 3], [60.0, 20.0, 20.0]), &[]);
    let at = |x: f64| Cut {
        id: CutId::from(format!("C{x}").as_str()),
        point_mm: [x, 0.0, 0.0],
        normal: [1.0, 0.0, 0.0],
        within: Vec::new(),
    };
    let plan = plan_by(&body, &request, &cuts(vec![at(20.0), at(40.0)])).unwrap();
    assert!(
        plan.joints
            .iter()
            .all(|joint| joint.one_way && joint.pins.len() >= 2),
        "{:?}",
        plan.joints
    );
    let [first, second] = [0, 1].map(|joint: usize| signature(&plan, &plan.joints[joint]));
    assert!(
        first.len() != second.len() || first.iter().zip(&second).any(|(a, b)| (a - b).abs() > 0.1),
        "{first:?}"
    );
}

/// Returns the invariants of a joint's pins under rotation and mirroring: their diameters, and
/// their distances from the thickest, mm.
fn signature(plan: &CutPlan, joint: &JointNote) -> Vec<f64> {
    let mut pins: Vec<&PinSite> = plan
        .pins
        .iter()
        .filter(|pin| joint.pins.contains(&pin.id))
        .collect();
    pins.sort_by(|a, b| b.diameter_mm.total_cmp(&a.diameter_mm));
    let apart =
        |pin: &&&PinSite| (Point::from(pin.center_mm) - Point::from(pins[0].center_mm)).norm();
    let mut arms: Vec<f64> = pins[1..].iter().map(|pin| apart(&pin)).collect();
    arms.sort_by(f64::total_cmp);
    pins.iter().map(|pin| pin.diameter_mm).chain(arms).collect()
}

#[test]
fn the_film_of_a_joint_is_its_section_less_the_mouths_of_its_sockets() {
    let body = with_balls(cuboid([0.0; 3], [60.0, 20.0, 20.0]), &[]);
    let cut = Cut {
        id: "C1".into(),
        point_mm: [20.0, 0.0, 0.0],
        normal: [1.0, 0.0, 0.0],
        within: Vec::new(),
    };
    let plan = plan_by(&body, &request(), &cuts(vec![cut])).unwrap();
    let mouths: f64 = plan
        .pins
        .iter()
        .map(|pin| {
            let radius = PinSite::socket_corner_mm(pin.socket_diameter_mm) + pin.socket_chamfer_mm;
            let sides = SIDES as f64;
            sides / 2.0 * (std::f64::consts::TAU / sides).sin() * radius * radius
        })
        .sum();
    let face = plan.joints[0].face;
    assert!(
        mouths > 1.0 && (face.area_mm2 - (400.0 - mouths)).abs() < 1e-9,
        "{face:?}"
    );
    let flat: f64 = (0..3).map(|i| face.squares_mm4[0][i].abs()).sum();
    assert!((face.center_mm[0] - 20.0).abs() < 1e-5 && flat < 1e-6);
}
