//! Promises of cut plans and parts, on bodies whose answer is known.

use crate::{
    cut::{
        joints::pin_shape::SIDES,
        scenes::{ball, cuboid, parts, plan, plan_by, request, with_balls},
        *,
    },
    geom::{Point, Vector},
    mass::moments_of_mesh,
    mesh::{Solid, shells},
};

fn volume(solid: &Solid) -> f64 {
    moments_of_mesh(solid.mesh()).volume()
}

/// Plans and cuts, and checks the promises of every kit. Voids open wide enough, parts have no
/// cavities and rest on the plate, and volumes add up.
pub(crate) fn kit(hollowed: &Hollowed, request: &PlanRequest) -> (CutPlan, Vec<Part>) {
    let plan = plan(hollowed, request).unwrap();
    let parts = parts(hollowed, &plan, request).unwrap();
    for void in &plan.voids {
        assert!(void.opening_mm >= request.min_opening_mm, "{void:?}");
        assert!(!void.opened_by.is_empty());
    }
    for part in &parts {
        assert!(
            shells(part.solid.mesh())
                .iter()
                .all(|shell| shell.signed_volume_mm3() > 0.0)
        );
        let heights = part
            .solid
            .mesh()
            .vertices()
            .iter()
            .map(|p| apply(&part.pose.print_from_model, p).z);
        assert_eq!(heights.fold(f64::INFINITY, f64::min), 0.0);
    }
    assert_volumes_add_up(hollowed, &parts);
    (plan, parts)
}

/// Returns an order of these cuts; the planner places the pins.
pub(crate) fn cuts(cuts: Vec<Cut>) -> CutOrder {
    CutOrder {
        cuts,
        ..CutOrder::default()
    }
}

pub(crate) fn assert_volumes_add_up(hollowed: &Hollowed, parts: &[Part]) {
    let body = moments_of_mesh(&hollowed.to_mesh()).volume();
    let written: f64 = parts.iter().map(|part| volume(&part.solid)).sum();
    let promised = body + parts.iter().map(Part::added_volume_mm3).sum::<f64>();
    assert!(
        (written - promised).abs() <= 1e-6 * body,
        "{written} against {promised}"
    );
}

#[test]
fn a_solid_body_needs_no_cut() {
    let body = with_balls(cuboid([0.0; 3], [30.0; 3]), &[]);
    let (plan, parts) = kit(&body, &request());
    assert!(plan.cuts.is_empty());
    assert_eq!(parts.len(), 1);
}

#[test]
fn a_ball_with_one_void_is_cut_once_into_two_parts_with_pins_that_fit_one_way() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let (plan, parts) = kit(&body, &request());
    assert_eq!((plan.cuts.len(), parts.len()), (1, 2));
    assert!(
        plan.pins.len() >= 2 && plan.joints[0].one_way,
        "{:?}",
        plan.notes
    );
    assert_eq!(parts[0].voids, [VoidId::of(0)]);
    assert_eq!(parts[0].pins.len() + parts[1].pins.len(), plan.pins.len());
    assert_eq!(
        parts[0].sockets.len() + parts[1].sockets.len(),
        plan.pins.len()
    );
}

#[test]
fn no_two_joints_can_be_confused() {
    let body = with_balls(cuboid([0.0; 3], [60.0, 20.0, 20.0]), &[]);
    let planes: Vec<Cut> = (1..3)
        .map(|i| Cut {
            id: CutId::from(format!("C{i}").as_str()),
            point_mm: [20.0 * f64::from(i), 0.0, 0.0],
            normal: [1.0, 0.0, 0.0],
            within: Vec::new(),
        })
        .collect();
    let plan = plan_by(&body, &request(), &cuts(planes)).unwrap();
    assert_eq!(plan.joints.len(), 2);
    assert!(
        plan.joints
            .iter()
            .all(|joint| joint.one_way && joint.pins.len() >= 2),
        "{:?}",
        plan.joints
    );
}

#[test]
fn a_pin_has_its_clearance_on_every_side_and_its_socket_the_wall_around() {
    let request = request();
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let (plan, parts) = kit(&body, &request);
    for pin in &plan.pins {
        let carrier = parts.iter().find(|part| part.pins.contains(pin)).unwrap();
        let receiver = parts
            .iter()
            .find(|part| part.sockets.contains(pin))
            .unwrap();
        let axis = Vector::from(pin.direction);
        let radii = |part: &Part, from: f64, to: f64| -> Vec<f64> {
            let arms = part
                .solid
                .mesh()
                .vertices()
                .iter()
                .map(|p| p - Point::from(pin.center_mm));
            let near = arms.map(|arm| (axis.dot(&arm), (arm - axis * axis.dot(&arm)).norm()));
            near.filter(|&(h, r)| from < h && h < to && r < pin.socket_diameter_mm)
                .map(|(_, r)| r)
                .collect()
        };
        let pin_radius = radii(carrier, 1e-3, pin.length_mm - pin.chamfer_mm + 1e-6)
            .into_iter()
            .fold(0.0, f64::max);
        let corner = radii(
            receiver,
            pin.socket_chamfer_mm - 1e-6,
            pin.socket_depth_mm + 1e-6,
        )
        .into_iter()
        .filter(|&r| r > pin_radius)
        .fold(f64::INFINITY, f64::min);
        // The socket's flats lie nearer to the axis than its corners, by the cosine of half a side.
        let flat = corner * (std::f64::consts::PI / SIDES as f64).cos();
        let gap_mm = (pin.socket_diameter_mm - pin.diameter_mm) / 2.0;
        assert!(
            (flat - pin_radius - gap_mm).abs() < 1e-9,
            "{flat} {pin_radius}"
        );
        let clearance_mm = request.pins.clearance_mm;
        assert!(
            clearance_mm <= gap_mm && gap_mm < clearance_mm + request.hole_step_mm,
            "{gap_mm}"
        );
        let far = Point::from(pin.center_mm) + axis * pin.socket_depth_mm;
        let surface = crate::geom::Bvh::new(body.to_mesh().iter_corners());
        let least = surface.segment_distance(&Point::from(pin.center_mm), &far, f64::INFINITY);
        assert!(least >= corner + request.wall_mm - 1e-9);
    }
}

#[test]
fn a_thin_shell_has_no_room_for_pins_and_the_plan_says_so() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 23.5]]);
    let (plan, parts) = kit(&body, &request());
    assert!(plan.pins.is_empty());
    assert!(
        plan.notes.iter().any(|note| {
            note.to_string()
                .contains("no room for pins: widest section 1.")
        }),
        "{:?}",
        plan.notes
    );
    assert_eq!(parts.len(), 2);
}

#[test]
fn a_long_bar_is_cut_until_its_parts_fit_the_printer() {
    let request = PlanRequest {
        build_volume_mm: Some([80.0, 60.0, 50.0]),
        ..request()
    };
    let (_, parts) = kit(
        &with_balls(cuboid([0.0; 3], [200.0, 20.0, 20.0]), &[]),
        &request,
    );
    assert!(parts.len() >= 3);
    for part in &parts {
        assert!(part.pose.fits);
        let placed = part
            .solid
            .mesh()
            .map_vertices(|p| apply(&part.pose.print_from_model, p))
            .aabb();
        assert!(placed.min.x >= 0.0 && placed.max.x <= 80.0 && placed.max.z <= 50.0);
    }
}

#[test]
fn the_part_with_sockets_lies_on_its_cut_face_and_open_hollows_look_up_when_asked() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let up = |request: &PlanRequest| -> Vec<f64> {
        let (plan, parts) = kit(&body, request);
        let normal = Vector::from(plan.cuts[0].normal);
        let vertical = |part: &Part| {
            let outward = if part.pins.is_empty() {
                -normal
            } else {
                normal
            };
            (0..3)
                .map(|i| part.pose.print_from_model[2][i] * outward[i])
                .sum::<f64>()
        };
        let mut looks: Vec<(bool, f64)> = parts
            .iter()
            .map(|p| (p.pins.is_empty(), vertical(p)))
            .collect();
        looks.sort_by_key(|(flat, _)| *flat);
        looks.into_iter().map(|(_, z)| z.round()).collect()
    };
    assert_eq!(up(&request()), vec![1.0, -1.0]);
    let open_up = PlanRequest {
        pose: PosePreference::OpenHollowUp,
        ..request()
    };
    assert_eq!(up(&open_up), vec![1.0, 1.0]);
}

#[test]
fn plans_and_parts_are_the_same_on_one_thread_and_on_two() {
    let body = with_balls(
        cuboid([-25.0; 3], [25.0; 3]),
        &[[-10.0, 3.0, 0.0, 7.0], [12.0, -2.0, 5.0, 8.0]],
    );
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| kit(&body, &request()))
    };
    let (one, two) = (on(1), on(2));
    assert_eq!(one.0, two.0);
    assert_eq!(one.1, two.1);
}

#[test]
fn a_plan_survives_being_written_and_read() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let plan = plan(&body, &request()).unwrap();
    let read: CutPlan = serde_json::from_str(&serde_json::to_string(&plan).unwrap()).unwrap();
    assert_eq!(
        read,
        CutPlan {
            moves: Vec::new(),
            ..plan.clone()
        },
        "how its cuts were moved is not in the file"
    );
    assert_eq!(
        parts(&body, &read, &request()),
        parts(&body, &plan, &request())
    );
}

#[test]
fn degenerate_cuts_and_requests_are_refused_without_panic() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    for normal in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0]] {
        let cut = Cut {
            id: "C1".into(),
            point_mm: [0.0; 3],
            normal,
            within: Vec::new(),
        };
        let refused = plan_by(&body, &request(), &cuts(vec![cut])).unwrap_err();
        assert_eq!(refused, CutError::DegenerateCut { cut: "C1".into() });
    }
    let aside = Cut {
        id: "C1".into(),
        point_mm: [0.0, 0.0, 99.0],
        normal: [0.0, 0.0, 1.0],
        within: Vec::new(),
    };
    assert!(matches!(
        plan_by(&body, &request(), &cuts(vec![aside])),
        Err(CutError::Obstacle(Obstacle::ClosedCavity { .. }))
    ));
    let asked = PlanRequest {
        wall_mm: f64::NAN,
        ..request()
    };
    assert!(matches!(
        plan(&body, &asked),
        Err(CutError::BadRequest {
            name: "wall_mm",
            ..
        })
    ));
}

#[test]
fn a_cut_along_a_face_leaves_no_sheets() {
    let body = with_balls(cuboid([0.0; 3], [30.0; 3]), &[]);
    let cut = Cut {
        id: "C1".into(),
        point_mm: [0.0; 3],
        normal: [0.0, 0.0, 1.0],
        within: Vec::new(),
    };
    let plan = plan_by(&body, &request(), &cuts(vec![cut])).unwrap();
    assert_eq!(parts(&body, &plan, &request()).unwrap().len(), 1);
}

#[test]
fn a_section_of_a_box_is_a_rectangle_with_the_holes_of_its_voids() {
    let body = with_balls(
        cuboid([0.0; 3], [30.0, 20.0, 20.0]),
        &[[8.0, 10.0, 10.0, 4.0], [22.0, 10.0, 10.0, 4.0]],
    );
    let plane = crate::geom::Plane {
        normal: Vector::z(),
        offset_mm: 10.0,
    };
    let section = Section::of_mesh(&body.to_mesh(), &plane);
    let polygons = section.polygons();
    assert_eq!((polygons.0.len(), polygons.0[0].interiors().len()), (1, 2));
    // The equator of the test ball is a regular 24-gon.
    let hole = 24.0 / 2.0 * 16.0 * (2.0 * std::f64::consts::PI / 24.0).sin();
    assert!((section.area_mm2() - (600.0 - 2.0 * hole)).abs() < 1e-9);
}

#[test]
fn a_body_left_uncut_keeps_its_closed_voids_in_one_part() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let plan = CutPlan::uncut(&body);
    let parts = parts(&body, &plan, &request()).unwrap();
    assert_eq!((parts.len(), plan.voids[0].opening_mm), (1, 0.0));
    assert_eq!(parts[0].pose.lies, Lie::Upright);
    assert_volumes_add_up(&body, &parts);
}

#[test]
fn a_plan_still_cuts_a_body_whose_voids_have_changed_a_little() {
    let body = |radius| with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, radius]]);
    let plan = plan(&body(12.0), &request()).unwrap();
    let ids = |radius| -> Vec<(PartId, usize)> {
        let parts = parts(&body(radius), &plan, &request()).unwrap();
        parts
            .iter()
            .map(|part| (part.id, part.pins.len()))
            .collect()
    };
    assert_eq!(ids(12.0), ids(12.02));
}
