//! Bounds of a block, a ball and a raft whose best hollowing has a closed form.

use super::core::Core;
use super::ground::Ground;
use super::question::Question;
use super::*;
use crate::geom::{Bvh, Point};
use crate::goal::GoalKind;
use crate::mass::Moments;
use crate::mesh::TriMesh;
use crate::verify::test_meshes::{ball, block};
use crate::verify::{Aim, BoundPoint, Hull, KeptPlace, Support, WaterOrder};

const SIZE_MM: [f64; 3] = [30.0, 20.0, 40.0];
const WALL_MM: f64 = 2.0;

/// Returns a block that stands on z = 0, its middle over the origin.
fn tower() -> TriMesh {
    block(Point::new(-15.0, -10.0, 0.0), SIZE_MM)
}

fn setting(kind: GoalKind, outer: &TriMesh) -> Setting {
    let aim = Aim {
        water: Some(WaterOrder {
            liquid_g_cm3: 1.0,
            waterline_mm: 15.0,
        }),
        ..Aim::new(kind, [0.0; 3], [0.0, 0.0, 1.0])
    };
    Setting {
        density_g_cm3: 1.25,
        aim,
        support: Some(Support::of_mesh(outer, &aim.frame())),
        ends_mm: None,
        hull: Some(Hull::new(outer, &aim.frame())),
        hardware: Moments::default(),
    }
}

fn proof(point: BoundPoint, edges: Vec<[f64; 3]>) -> BoundProof {
    BoundProof {
        bound: 0.0,
        wall_mm: WALL_MM,
        keeps: Vec::new(),
        points: vec![point],
        ends: None,
        edges,
    }
}

fn point(weights: &[f64], multipliers: &[f64]) -> BoundPoint {
    BoundPoint {
        height_mm: None,
        weights: weights.to_vec(),
        multipliers: multipliers.to_vec(),
    }
}

/// Returns the bound of a body by a proof.
fn bound(kind: GoalKind, figure: FigureName, outer: &TriMesh, proof: &BoundProof) -> Option<f64> {
    let setting = setting(kind, outer);
    let frame = setting.aim.frame();
    let solid = moments_of_mesh(outer).in_frame(&frame);
    let ground = Ground::new(&setting, figure, &solid);
    let core = Core::of(&Bvh::new(outer.iter_corners()), proof, &frame, LEVELS);
    super::bound(&Question {
        ground: &ground,
        core: &core,
        proof,
    })
}

/// Returns the least height of the tower's centre: the void is all that lies above it.
fn least_height_mm() -> f64 {
    let volume: f64 = SIZE_MM.iter().product();
    let across: f64 = SIZE_MM[..2]
        .iter()
        .map(|size| size - 2.0 * WALL_MM)
        .product();
    let top = SIZE_MM[2] - WALL_MM;
    let center = |level: f64| {
        let removed = across * (top - level);
        let lever = volume * 0.5 * SIZE_MM[2] - removed * 0.5 * (top + level);
        lever / (volume - removed)
    };
    let (mut low, mut high) = (0.0, 20.0);
    for _ in 0..60 {
        let level = 0.5 * (low + high);
        if center(level) > level {
            low = level;
        } else {
            high = level;
        }
    }
    0.5 * (low + high)
}

#[test]
fn the_inside_of_a_ball_is_a_smaller_ball() {
    let outer = ball(Point::new(3.0, -2.0, 5.0), 20.0, 48);
    let proof = proof(point(&[], &[]), Vec::new());
    let frame = Aim::new(GoalKind::Top, [3.0, -2.0, 5.0], [0.2, -0.4, 0.9]).frame();
    let core = Core::of(&Bvh::new(outer.iter_corners()), &proof, &frame, LEVELS);
    let (moments, integral) = core.emptied(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    // The facets take 0.2 % of the ball, and as much of the smaller one.
    let whole = moments_of_mesh(&outer).volume();
    let expected = whole * (18.0_f64 / 20.0).powi(3);
    assert!(
        (integral / expected - 1.0).abs() < 1e-3,
        "{integral} {expected}"
    );
    assert!(moments.centroid().coords.norm() < 2e-3);
}

#[test]
fn a_kept_place_stays_out_of_the_inside() {
    let outer = tower();
    let one = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let inside = |keeps: Vec<KeptPlace>| {
        let proof = BoundProof {
            keeps,
            ..proof(point(&[], &[]), Vec::new())
        };
        let frame = Aim::new(GoalKind::Stand, [0.0; 3], [0.0, 0.0, 1.0]).frame();
        let tree = Bvh::new(outer.iter_corners());
        Core::of(&tree, &proof, &frame, LEVELS).emptied(&one).1
    };
    let keep = KeptPlace {
        from_mm: [0.0, 0.0, 15.0],
        to_mm: [0.0, 0.0, 25.0],
        radius_mm: 5.0,
    };
    let capsule = std::f64::consts::PI * (25.0 * 10.0 + 4.0 / 3.0 * 125.0);
    let lost = inside(Vec::new()) - inside(vec![keep]);
    assert!((lost / capsule - 1.0).abs() < 5e-3, "{lost} {capsule}");
}

#[test]
fn the_lowest_centre_of_a_block_is_where_its_void_begins() {
    let proof = proof(point(&[], &[0.0; 2]), Vec::new());
    let found = bound(
        GoalKind::Stand,
        FigureName::CenterHeightMm,
        &tower(),
        &proof,
    )
    .unwrap();
    let expected = least_height_mm();
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
}

#[test]
fn a_block_topples_over_its_nearer_edges_at_the_angle_of_its_lowest_centre() {
    let edges = vec![[0.0, 1.0, -10.0], [0.0, -1.0, -10.0]];
    let proof = proof(point(&[0.5, 0.5], &[]), edges);
    let found = bound(GoalKind::Stand, FigureName::TopplesDeg, &tower(), &proof).unwrap();
    let expected = 10f64.atan2(least_height_mm()).to_degrees();
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
}

#[test]
fn a_raft_of_the_right_mass_has_its_void_above_a_level() {
    // Its mass is that of 15 mm of water. The metacentre is at T/2 + B²/(12 T).
    let outer = block(Point::new(-15.0, -20.0, 0.0), [30.0, 40.0, 20.0]);
    let material = 15.0 * 30.0 * 40.0 / 1.25;
    let across = 26.0 * 36.0;
    let removed = 20.0 * 30.0 * 40.0 - material;
    let level = 18.0 - removed / across;
    let center = (20.0 * 30.0 * 40.0 * 10.0 - removed * 0.5 * (18.0 + level)) / material;
    let metacentre = 7.5 + 30.0 * 30.0 / (12.0 * 15.0);
    let multiplier = -level / material;
    let proof = proof(point(&[], &[0.0, 0.0, multiplier]), Vec::new());
    let figure = FigureName::MetacentricHeightMm;
    let found = bound(GoalKind::Float, figure, &outer, &proof).unwrap();
    let expected = metacentre - center;
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
}

#[test]
fn numbers_that_are_no_proof_prove_nothing() {
    let topples =
        |proof: &BoundProof| bound(GoalKind::Stand, FigureName::TopplesDeg, &tower(), proof);
    let edges = || vec![[0.0, 1.0, -10.0], [0.0, -1.0, -10.0]];
    assert!(topples(&proof(point(&[0.5, 0.5], &[]), edges())).is_some());
    // Too much weight, a negative one, one too few, and one multiplier too many.
    assert_eq!(topples(&proof(point(&[0.5, 0.6], &[]), edges())), None);
    assert_eq!(topples(&proof(point(&[1.5, -0.5], &[]), edges())), None);
    assert_eq!(topples(&proof(point(&[1.0], &[]), edges())), None);
    assert_eq!(topples(&proof(point(&[0.5, 0.5], &[1.0]), edges())), None);
    // An edge nearer than the support's, and one that is no unit vector.
    let near = vec![[0.0, 1.0, -8.0], [0.0, -1.0, -8.0]];
    assert_eq!(topples(&proof(point(&[0.5, 0.5], &[]), near)), None);
    let long = vec![[0.0, 2.0, -20.0], [0.0, -2.0, -20.0]];
    assert_eq!(topples(&proof(point(&[0.5, 0.5], &[]), long)), None);
}

#[test]
fn a_poor_point_proves_less_and_never_more() {
    let expected = 10f64.atan2(least_height_mm()).to_degrees();
    for share in [0.0, 0.2, 0.4, 0.6] {
        let edges = vec![[0.0, 1.0, -10.0], [0.0, -1.0, -10.0]];
        let proof = proof(point(&[share, 1.0 - share], &[]), edges);
        let found = bound(GoalKind::Stand, FigureName::TopplesDeg, &tower(), &proof);
        assert!(
            found.is_none_or(|found| found > expected * 1.001),
            "{share} {found:?}"
        );
    }
}
