//! The planner finds the least number of cuts for twenty-two interiors of one to eight voids, for
//! which that number is known.
//!
//! A plane opens a ball by the asked disc if it passes near enough to its middle. So one plane
//! opens several balls if their middles lie between two parallel planes near each other. Their
//! distance is the width of a set of points, found here by trying every pair of edges. The least
//! number of planes follows by trying every partition of the balls.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use equipoise::base::watch::Watch;
use equipoise::cut::{
    GoalAxis, Hollowed, JigShelf, LeastPart, PinSettings, PlanRequest, PosePreference, Seams, plan,
};
use equipoise::geom::{Point, Vector};
use equipoise::mesh::{Csg, Solid, TriMesh, primitives};
use equipoise::printer::Cleaning;

/// The disc that must pass through every opening, mm.
const OPENING_MM: f64 = 3.0;

fn request() -> PlanRequest {
    PlanRequest {
        wants_wide_joints: false,
        worth_ratio: 0.0,
        part_weight: PlanRequest::PART_WEIGHT,
        min_opening_mm: OPENING_MM,
        cleaning: Cleaning::MELT_OUT,
        build_volume_mm: None,
        wall_mm: 1.0,
        pins: PinSettings {
            min_diameter_mm: 1.0,
            length_ratio: 1.25,
            clearance_mm: 0.1,
            chamfer_mm: 0.2,
            bottom_relief_mm: 0.5,
            spread_ratio: PlanRequest::SPREAD_RATIO,
            snug_gap_mm: 0.05,
            max_step_mm: Some(0.3),
        },
        axis: GoalAxis {
            point: Point::new(0.0, 0.0, -60.0),
            direction: Vector::z(),
        },
        pixel_mm: 0.05,
        hole_step_mm: 0.05,
        layer_mm: 0.05,
        pose: PosePreference::CutFaceDown,
        rods: Vec::new(),
        labels: None,
        seams: Seams::default(),
        least_part: LeastPart::NONE,
        jigs: JigShelf::default(),
        watch: Watch::silent(),
    }
}

fn solid(mesh: TriMesh) -> Solid {
    Solid::new(mesh).unwrap()
}

fn block() -> Solid {
    solid(primitives::cuboid(
        &Point::new(-45.0, -45.0, -45.0),
        &Point::new(45.0, 45.0, 45.0),
    ))
}

/// Plans the cuts; returns their number, and that of the voids with too narrow an opening.
fn count_cuts(outer: Solid, voids: Vec<Solid>) -> (usize, usize) {
    let plan = plan(&Hollowed::new(outer, voids), &request()).unwrap();
    let plan = plan.found().unwrap();
    (
        plan.cuts.len(),
        plan.voids
            .iter()
            .filter(|void| void.opening_mm < OPENING_MM)
            .count(),
    )
}

/// Balls of one radius about these middles.
fn beads(middles: &[[f64; 3]], radius: f64) -> Vec<Solid> {
    middles
        .iter()
        .map(|&at| solid(primitives::ball(&Point::from(at), radius, 3)))
        .collect()
}

/// The least distance of two parallel planes with all points between them; 0 for points on a line.
///
/// Either the planes touch one point and three others, or they touch two edges.
fn width(points: &[Point]) -> f64 {
    let edges: Vec<Vector> = (0..points.len())
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .map(|(i, j)| points[i] - points[j])
        .collect();
    let pairs = (0..edges.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let normals = pairs.filter_map(|(i, j)| edges[i].cross(&edges[j]).try_normalize(1e-9));
    let thickness = |n: Vector| {
        let heights = || points.iter().map(|p| n.dot(&p.coords));
        heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
    };
    normals.map(thickness).reduce(f64::min).unwrap_or(0.0)
}

/// The fewest planes that together pass within `reach` of all middles, found by exhaustion.
fn least_planes(middles: &[[f64; 3]], reach: f64) -> usize {
    let all = (1usize << middles.len()) - 1;
    let members = |set: usize| (0..middles.len()).filter(move |i| set >> i & 1 == 1);
    let one_plane = |set: usize| {
        let points: Vec<Point> = members(set).map(|i| Point::from(middles[i])).collect();
        points.len() <= 3 || width(&points) <= 2.0 * reach
    };
    let shared: Vec<bool> = (0..=all).map(one_plane).collect();
    let mut least = vec![usize::MAX; all + 1];
    least[0] = 0;
    for set in 1..=all {
        let mut part = set;
        while part > 0 {
            if shared[part] {
                least[set] = least[set].min(1 + least[set & !part]);
            }
            part = (part - 1) & set;
        }
    }
    least[all]
}

/// Asserts that the planner needs as few cuts for beads in a block as is possible. That number must
/// be the same for a reach a tenth smaller and larger, so that facets decide nothing.
fn assert_least(name: &str, expected: usize, middles: &[[f64; 3]], radius: f64) {
    let reach = (radius * radius - OPENING_MM * OPENING_MM / 4.0).sqrt();
    for reach in [0.9 * reach, 1.1 * reach] {
        assert_eq!(
            least_planes(middles, reach),
            expected,
            "{name}: this interior needs another number of cuts"
        );
    }
    assert_eq!(
        count_cuts(block(), beads(middles, radius)),
        (expected, 0),
        "{name}"
    );
}

/// Samples a curve.
fn sample(count: usize, at: impl Fn(f64) -> [f64; 3]) -> Vec<[f64; 3]> {
    (0..count).map(|i| at(i as f64)).collect()
}

const TETRAHEDRON: [[f64; 3]; 4] = [
    [15.0, 15.0, 15.0],
    [15.0, -15.0, -15.0],
    [-15.0, 15.0, -15.0],
    [-15.0, -15.0, 15.0],
];

fn cube(half: f64) -> Vec<[f64; 3]> {
    sample(8, |i| {
        [0, 1, 2].map(|axis| {
            if i as usize >> axis & 1 == 1 {
                half
            } else {
                -half
            }
        })
    })
}

fn octahedron(half: f64) -> Vec<[f64; 3]> {
    sample(6, |i| {
        [0, 1, 2].map(|axis| {
            if i as usize / 2 == axis {
                half * (1.0 - 2.0 * (i % 2.0))
            } else {
                0.0
            }
        })
    })
}

/// Points in general position: no plane is within reach of four of them.
const FIVE: [[f64; 3]; 5] = [
    [-21.0, 5.0, -5.0],
    [4.0, 26.0, -5.0],
    [14.0, 3.0, 26.0],
    [3.0, -9.0, 2.0],
    [21.0, 8.0, -22.0],
];
const SIX: [[f64; 3]; 6] = [
    [-19.0, -4.0, -21.0],
    [16.0, -21.0, 11.0],
    [-19.0, 3.0, 11.0],
    [22.0, -8.0, 19.0],
    [25.0, 0.0, -20.0],
    [17.0, 16.0, -12.0],
];
const SEVEN: [[f64; 3]; 7] = [
    [-6.0, -4.0, -20.0],
    [-7.0, -7.0, 23.0],
    [-4.0, -23.0, 20.0],
    [21.0, 6.0, -14.0],
    [22.0, -5.0, -25.0],
    [-25.0, 13.0, -23.0],
    [7.0, 25.0, -22.0],
];
const EIGHT: [[f64; 3]; 8] = [
    [-25.0, 5.0, -1.0],
    [16.0, 26.0, 24.0],
    [25.0, 6.0, 7.0],
    [-16.0, 5.0, -24.0],
    [-13.0, 19.0, 10.0],
    [9.0, 24.0, -5.0],
    [26.0, 17.0, -13.0],
    [-25.0, -18.0, 0.0],
];

#[test]
fn one_cut_opens_a_bead_a_string_of_pearls_or_a_ring_of_eight() {
    assert_least("one bead", 1, &[[3.0, -5.0, 8.0]], 6.0);
    assert_least(
        "a string",
        1,
        &sample(7, |i| [7.0, 11.0, -8.0].map(|x| x * (i - 3.0) / 2.0)),
        3.0,
    );
    assert_least(
        "eight on a string",
        1,
        &sample(8, |i| [4.0, -7.0, 9.0].map(|x| x * (i - 3.5))),
        2.5,
    );
    let ring = |i: f64| {
        let (sin, cos) = (i * std::f64::consts::FRAC_PI_4).sin_cos();
        [20.0 * cos, 20.0 * sin, 9.0 * cos - 5.0 * sin]
    };
    assert_least("a tilted ring", 1, &sample(8, ring), 4.0);
}

#[test]
fn one_cut_opens_two_voids_askew_or_any_three() {
    assert_least("two askew", 1, &[[-15.0; 3], [15.0; 3]], 6.0);
    assert_least(
        "three",
        1,
        &[[20.0, 0.0, 12.0], [-12.0, 18.0, -4.0], [-10.0, -18.0, 0.0]],
        2.0,
    );
    assert_least(
        "a row behind a row",
        1,
        &sample(6, |i| {
            [
                10.0 * (i % 3.0) - 10.0,
                0.0,
                24.0 * (i / 3.0).floor() - 12.0,
            ]
        }),
        4.0,
    );
}

#[test]
fn two_cuts_open_the_corners_of_a_tetrahedron_an_octahedron_and_a_cube() {
    assert_least("tetrahedron", 2, &TETRAHEDRON, 2.5);
    assert_least("octahedron", 2, &octahedron(22.0), 2.5);
    assert_least("cube", 2, &cube(15.0), 2.5);
}

#[test]
fn beads_in_general_position_need_a_cut_for_every_three() {
    assert_least("five", 2, &FIVE, 2.5);
    assert_least("six", 2, &SIX, 2.5);
    assert_least("seven", 3, &SEVEN, 1.8);
    assert_least("eight", 3, &EIGHT, 1.65);
}

#[test]
fn a_spiral_of_beads_is_opened_by_the_fewest_planes() {
    let spiral = |i: f64| {
        [
            20.0 * (i * 1.9).cos(),
            20.0 * (i * 1.9).sin(),
            7.0 * (i - 3.5),
        ]
    };
    assert_least("a spiral", 2, &sample(8, spiral), 1.65);
}

#[test]
fn one_cut_opens_a_void_in_every_leg_of_a_table() {
    let legs = [[-20.0, -20.0], [20.0, -20.0], [-20.0, 20.0], [20.0, 20.0]];
    let cuboid = |low: [f64; 3], high: [f64; 3]| primitives::cuboid(&low.into(), &high.into());
    let leg = |[x, y]: [f64; 2], half: f64, z: [f64; 2]| {
        cuboid([x - half, y - half, z[0]], [x + half, y + half, z[1]])
    };
    let top = Csg::of_mesh(&cuboid([-25.0, -25.0, 30.0], [25.0, 25.0, 40.0])).unwrap();
    let table = legs.iter().fold(top, |body, &at| {
        body.union(&Csg::of_mesh(&leg(at, 5.0, [0.0, 31.0])).unwrap())
            .unwrap()
    });
    let voids = legs.map(|at| solid(leg(at, 3.0, [4.0, 25.0]))).to_vec();
    assert_eq!(count_cuts(table.to_solid().unwrap(), voids), (1, 0));
}

#[test]
fn one_cut_opens_a_head_and_both_its_ears() {
    let ball = |at: [f64; 3], radius: f64| primitives::ball(&at.into(), radius, 4);
    let head = [
        ([0.0, 0.0, 0.0], 30.0),
        ([-26.0, 4.0, 22.0], 10.0),
        ([26.0, -3.0, 22.0], 10.0),
    ];
    let bodies = head.map(|(at, radius)| Csg::of_mesh(&ball(at, radius)).unwrap());
    let outer = bodies
        .into_iter()
        .reduce(|sum, body| sum.union(&body).unwrap())
        .unwrap();
    let voids = head
        .map(|(at, radius)| solid(ball(at, 0.6 * radius)))
        .to_vec();
    assert_eq!(count_cuts(outer.to_solid().unwrap(), voids), (1, 0));
}

#[test]
fn one_cut_opens_a_ring_a_slab_over_two_pearls_or_two_crossing_shafts() {
    let ring = solid(primitives::torus(20.0, 6.0, 48, 24));
    assert_eq!(count_cuts(block(), vec![ring]), (1, 0));
    let cuboid =
        |low: [f64; 3], high: [f64; 3]| solid(primitives::cuboid(&low.into(), &high.into()));
    let slab = cuboid([-25.0, -25.0, 10.0], [25.0, 25.0, 16.0]);
    let pearls = beads(&[[-20.0, -13.0, -10.0], [20.0, 13.0, -10.0]], 3.0);
    assert_eq!(count_cuts(block(), [vec![slab], pearls].concat()), (1, 0));
    let shafts = vec![
        cuboid([-30.0, -12.0, -4.0], [30.0, -4.0, 4.0]),
        cuboid([-4.0, 4.0, -30.0], [4.0, 12.0, 30.0]),
    ];
    assert_eq!(count_cuts(block(), shafts), (1, 0));
}

#[test]
fn a_ring_with_pearls_above_and_beside_it_needs_one_cut_or_two() {
    // The ring lies flat. A plane through both pearls, above and beside it, meets it too. More
    // pearls off that plane and off the ring's own need a second cut.
    let ring = || solid(primitives::torus(20.0, 4.0, 48, 24));
    let two = beads(&[[0.0, 0.0, 34.0], [0.0, 36.0, 20.0]], 2.0);
    assert_eq!(count_cuts(block(), [vec![ring()], two].concat()), (1, 0));
    let three = beads(
        &[
            [0.0, 0.0, 34.0],
            [0.0, 36.0, 20.0],
            [36.0, 0.0, 20.0],
            [-36.0, -36.0, 34.0],
        ],
        2.0,
    );
    assert_eq!(count_cuts(block(), [vec![ring()], three].concat()), (2, 0));
}
