//! Tests of the number of cuts that the planner finds, on bodies with a known answer.

use crate::{
    cut::{
        scenes::{ball, cuboid, plan, request, with_balls},
        tests::kit,
        *,
    },
    geom::{Point, Vector},
    mesh::Csg,
};

#[test]
fn pearls_on_a_skew_string_need_one_cut() {
    let direction = Vector::new(1.0, 2.0, -1.5).normalize();
    let pearls: Vec<[f64; 4]> = (-3..=3)
        .map(|i| direction * (7.0 * f64::from(i)))
        .map(|p| [p.x, p.y, p.z, 3.0])
        .collect();
    let (plan, _) = kit(&with_balls(ball([0.0; 3], 32.0), &pearls), &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn two_voids_side_by_side_only_in_a_skew_direction_need_one_cut() {
    // Their extents along x, y and z do not overlap, so no plane normal to an axis meets both.
    let body = with_balls(
        cuboid([-30.0; 3], [30.0; 3]),
        &[[-15.0, -15.0, -15.0, 6.0], [15.0, 15.0, 15.0, 6.0]],
    );
    let (plan, _) = kit(&body, &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn a_table_with_a_void_in_every_leg_needs_one_cut() {
    let legs = [[5.0, 5.0], [45.0, 5.0], [5.0, 45.0], [45.0, 45.0]];
    let mut body = Csg::of_solid(&cuboid([0.0, 0.0, 30.0], [50.0, 50.0, 40.0])).unwrap();
    for [x, y] in legs {
        let leg = cuboid([x - 5.0, y - 5.0, 0.0], [x + 5.0, y + 5.0, 31.0]);
        body = body.union(&Csg::of_solid(&leg).unwrap()).unwrap();
    }
    let outer = body.to_solid().unwrap();
    let voids = legs.map(|[x, y]| cuboid([x - 3.0, y - 3.0, 4.0], [x + 3.0, y + 3.0, 25.0]));
    let (plan, _) = kit(&Hollowed::new(outer, voids.to_vec()), &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn three_voids_in_a_triangle_need_the_one_plane_through_them_all() {
    let body = with_balls(
        ball([0.0; 3], 40.0),
        &[
            [20.0, 0.0, 12.0, 4.0],
            [-12.0, 18.0, -4.0, 4.0],
            [-10.0, -18.0, 0.0, 4.0],
        ],
    );
    let (plan, _) = kit(&body, &request());
    assert_eq!(plan.cuts.len(), 1);
}

#[test]
fn four_small_voids_at_the_corners_of_a_tetrahedron_need_two_cuts() {
    // A plane within 1.5 mm of three corners misses the fourth by some 40 mm. Two planes take two
    // corners each.
    let corner = |x: f64, y: f64, z: f64| [15.0 * x, 15.0 * y, 15.0 * z, 2.5];
    let tetrahedron = [
        corner(1.0, 1.0, 1.0),
        corner(1.0, -1.0, -1.0),
        corner(-1.0, 1.0, -1.0),
        corner(-1.0, -1.0, 1.0),
    ];
    let (plan, parts) = kit(
        &with_balls(cuboid([-25.0; 3], [25.0; 3]), &tetrahedron),
        &request(),
    );
    assert_eq!(plan.cuts.len(), 2);
    assert!(
        plan.notes[0].to_string().contains("fewer do not"),
        "{:?}",
        plan.notes
    );
    assert!(parts.len() >= 3);
}

#[test]
fn a_void_too_narrow_to_open_is_named() {
    let body = with_balls(
        cuboid([0.0; 3], [30.0; 3]),
        &[[10.0, 10.0, 10.0, 5.0], [22.0, 22.0, 22.0, 1.0]],
    );
    let refused = plan(&body, &request()).unwrap_err();
    let CutError::Obstacle(Obstacle::Unopenable { voids, .. }) = refused else {
        panic!("{refused}")
    };
    assert_eq!(voids, [VoidId::of(1)]);
}

/// Returns a body of 60 × 30 × 30 mm with a void. Behind it are pockets for balls of 5 mm with a
/// clearance of 0.2 mm.
fn with_pockets(pockets: &[[f64; 3]]) -> Hollowed {
    let voids = [
        &[[15.0, 15.0, 15.0, 9.0]][..],
        &pockets
            .iter()
            .map(|&[x, y, z]| [x, y, z, 2.7])
            .collect::<Vec<_>>(),
    ];
    let mut body = with_balls(cuboid([0.0; 3], [60.0, 30.0, 30.0]), &voids.concat());
    let seat = |&center: &[f64; 3]| Seat {
        center: Point::from(center),
        axis: None,
        radius_mm: 2.7,
        opening_mm: 5.0,
    };
    for (void, center) in body.voids[1..].iter_mut().zip(pockets) {
        void.holds = Some(seat(center));
    }
    body
}

#[test]
fn one_cut_opens_a_void_and_lets_a_ball_into_its_pocket() {
    let body = with_pockets(&[[50.0, 22.0, 8.0]]);
    let (plan, _) = kit(&body, &request());
    assert_eq!(plan.cuts.len(), 1);
    assert!(plan.voids[1].opening_mm >= 5.0, "{:?}", plan.voids);
    let plane = plan.cuts[0].plane().unwrap();
    // Distance from the middle of the pocket: √(2.7² − 2.5²).
    assert!(plane.distance(&Point::new(50.0, 22.0, 8.0)).abs() <= 1.02);
}

#[test]
fn three_pockets_without_order_are_opened_by_the_plane_through_them() {
    let body = with_pockets(&[[40.0, 6.0, 22.0], [54.0, 24.0, 7.0], [36.0, 22.0, 11.0]]);
    let (plan, _) = kit(&body, &request());
    assert!(plan.cuts.len() <= 2, "{:?}", plan.notes);
    assert!(
        plan.voids[1..].iter().all(|void| void.opening_mm >= 5.0),
        "{:?}",
        plan.voids
    );
}

/// Returns the requirements of a test with balls that no seam enters.
fn clear_of(balls: &[[f64; 4]]) -> PlanRequest {
    let ball = |&[x, y, z, radius_mm]: &[f64; 4]| KeepClear {
        center_mm: [x, y, z],
        radius_mm,
    };
    PlanRequest {
        seams: Seams {
            keep_clear: balls.iter().map(ball).collect(),
            ..Seams::default()
        },
        ..request()
    }
}

#[test]
fn no_seam_of_the_planner_enters_a_ball_to_keep_clear() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let usual = plan(&body, &request()).unwrap();
    let cut = usual.cuts[0].plane().unwrap();
    let at = cut.foot() + cut.basis().0 * 24.0;
    let marked = clear_of(&[[at.x, at.y, at.z, 9.0]]);
    let balls = &marked.seams.keep_clear;
    let balls = seam::clear::ClearBalls::new(balls, body.outer.mesh(), 0.0);
    let enters = |plan: &CutPlan| {
        let mut cuts = plan.partings().unwrap().into_iter();
        cuts.any(|cut| balls.entered_within(&cut).is_some())
    };
    let clear = plan(&body, &marked).unwrap();
    assert!(enters(&usual) && !enters(&clear), "{:?}", clear.cuts);
}

#[test]
fn balls_that_leave_no_plane_are_named_in_the_refusal() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let refused = plan(&body, &clear_of(&[[0.0, 0.0, 0.0, 60.0]])).unwrap_err();
    let words = refused.to_string();
    assert!(words.contains("no plane opens void V1"), "{words}");
    assert!(
        words.contains("make the balls of `keep_clear = …` smaller"),
        "{words}"
    );
}

#[test]
fn an_ordered_cut_into_a_ball_is_refused_by_its_name() {
    let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
    let text = "[[cuts]]\nid = \"waist\"\npoint_mm = [0, 0, 1]\nnormal = [0, 0, 1]\n";
    let order = CutOrder::from_toml("cuts.toml", text).unwrap();
    let ordered = |balls: &[[f64; 4]]| scenes::plan_by(&body, &clear_of(balls), &order);
    let refused = ordered(&[[25.0, 0.0, 0.0, 3.0]]).unwrap_err().to_string();
    assert!(
        refused.contains("cut waist enters the ball 25,0,0,3"),
        "{refused}"
    );
    assert!(ordered(&[[0.0, 0.0, 25.0, 3.0]]).is_ok());
}

#[test]
fn balls_in_a_file_of_cuts_are_read_and_checked() {
    let text = "[[keep_clear]]\ncenter_mm = [1, 2, 3]\nradius_mm = 4\n";
    let order = CutOrder::from_toml("cuts.toml", text).unwrap();
    assert!(order.is_only_clear() && order.keep_clear[0].radius_mm == 4.0);
    let flat = text.replace("radius_mm = 4", "radius_mm = 0");
    let refused = CutOrder::from_toml("cuts.toml", &flat)
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("ball 1 to keep clear is none"),
        "{refused}"
    );
}

#[test]
fn a_slice_of_a_bar_is_below_the_least_part_and_its_half_is_not() {
    use crate::{
        cut::{
            access::void_access::accesses,
            geometry::tree::CutTree,
            planner::{layout::Layout, score::Scene},
        },
        geom::Plane,
    };
    let body = with_balls(
        cuboid([0.0; 3], [60.0, 20.0, 20.0]),
        &[[30.0, 10.0, 10.0, 6.0]],
    );
    let count = |x: f64, least_part: LeastPart| {
        let request = PlanRequest {
            least_part,
            ..request()
        };
        let scene = Scene::new(&body, &request).unwrap();
        let planes = vec![30.013, x].into_iter().map(|offset_mm| Plane {
            normal: Vector::x(),
            offset_mm,
        });
        let planes: Vec<Plane> = planes.collect();
        let tree = CutTree::everywhere(&planes);
        let voids = accesses(&scene.chambers, &tree, &request).unwrap();
        let pieces = scene.split(&tree).unwrap();
        let layout = Layout {
            tree,
            voids,
            pieces,
            bridges: Vec::new(),
        };
        layout.count_small(&scene)
    };
    assert_eq!(count(59.0, LeastPart::USUAL), 1);
    assert_eq!(count(50.0, LeastPart::USUAL), 0);
    assert_eq!(count(59.0, LeastPart::NONE), 0);
}
