//! Bodies and requests for the tests of this folder.

use crate::{
    base::watch::Watch,
    cut::{
        self, CutError, CutOrder, CutPlan, GoalAxis, JigShelf, LeastPart, Part, PinSettings,
        PlanRequest, PosePreference, Seams, hollowed::Hollowed,
    },
    geom::{Point, Vector},
    mesh::{Solid, TriMesh},
    printer::{Cleaning, CleaningRule},
};

/// Returns a solid box.
pub(crate) fn cuboid(min: [f64; 3], max: [f64; 3]) -> Solid {
    let pick = |i: usize, axis: usize| {
        if i >> axis & 1 == 0 {
            min[axis]
        } else {
            max[axis]
        }
    };
    let vertices = (0..8)
        .map(|i| Point::new(pick(i, 0), pick(i, 1), pick(i, 2)))
        .collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    Solid::new(TriMesh::new(vertices, triangles).unwrap()).unwrap()
}

/// Returns a ball of 24 × 12 faces, its poles along z. It is inscribed, so a little smaller than
/// the true ball.
pub(crate) fn ball(center: [f64; 3], radius: f64) -> Solid {
    let (around, rows) = (24u32, 12u32);
    let center = Point::from(center);
    let point = |row: u32, side: u32| {
        let (polar, turn) = (
            std::f64::consts::PI * f64::from(row) / f64::from(rows),
            2.0 * std::f64::consts::PI * (f64::from(side) + 0.25) / f64::from(around),
        );
        center
            + Vector::new(
                polar.sin() * turn.cos(),
                polar.sin() * turn.sin(),
                polar.cos(),
            ) * radius
    };
    let rings = (1..rows).flat_map(|row| (0..around).map(move |side| (row, side)));
    let mut vertices: Vec<Point> = rings.map(|(row, side)| point(row, side)).collect();
    vertices.extend([center + Vector::z() * radius, center - Vector::z() * radius]);
    let (top, bottom) = (around * (rows - 1), around * (rows - 1) + 1);
    let mut triangles = Vec::new();
    for side in 0..around {
        let next = (side + 1) % around;
        triangles.push([top, side, next]);
        for upper in (0..rows - 2).map(|row| row * around) {
            let lower = upper + around;
            triangles.push([upper + side, lower + side, lower + next]);
            triangles.push([upper + side, lower + next, upper + next]);
        }
        let last = around * (rows - 2);
        triangles.push([bottom, last + next, last + side]);
    }
    Solid::new(TriMesh::new(vertices, triangles).unwrap()).unwrap()
}

/// Returns a bar with two balls of air, and a request in which all their walls must be in sight.
pub(crate) fn two_balls() -> (Hollowed, PlanRequest) {
    let bar = cuboid([0.0; 3], [60.0, 30.0, 30.0]);
    let balls = [[18.0, 15.0, 15.0, 10.0], [42.0, 15.0, 15.0, 10.0]];
    let request = PlanRequest {
        cleaning: Cleaning {
            rule: CleaningRule::InSight,
            sight_ratio: 0.95,
            ..Cleaning::MELT_OUT
        },
        ..request()
    };
    (with_balls(bar, &balls), request)
}

/// Returns a body with balls of air in it, each (x, y, z, radius).
pub(crate) fn with_balls(outer: Solid, balls: &[[f64; 4]]) -> Hollowed {
    let voids = balls
        .iter()
        .map(|&[x, y, z, radius]| ball([x, y, z], radius))
        .collect();
    Hollowed::new(outer, voids)
}

/// Returns settings like those of a PolyJet printer. The axis runs along z through a point below
/// everything.
pub(crate) fn request() -> PlanRequest {
    PlanRequest {
        worth_ratio: 0.0,
        part_weight: PlanRequest::PART_WEIGHT,
        wants_wide_joints: false,
        min_opening_mm: 3.0,
        cleaning: Cleaning::MELT_OUT,
        build_volume_mm: None,
        wall_mm: 1.0,
        pins: PinSettings {
            min_diameter_mm: 1.0,
            length_ratio: 1.25,
            clearance_mm: 0.1,
            chamfer_mm: 0.3,
            bottom_relief_mm: 0.5,
            spread_ratio: PlanRequest::SPREAD_RATIO,
            snug_gap_mm: 0.05,
            max_step_mm: Some(0.3),
        },
        axis: GoalAxis {
            point: Point::new(0.0, 0.0, -100.0),
            direction: Vector::z(),
        },
        pixel_mm: 0.042,
        hole_step_mm: 0.042,
        layer_mm: 0.03,
        pose: PosePreference::CutFaceDown,
        rods: Vec::new(),
        labels: None,
        seams: Seams::default(),
        least_part: LeastPart::NONE,
        jigs: JigShelf::default(),
        watch: Watch::silent(),
    }
}

/// Returns a plan as in [`cut::plan`], with an obstacle as an error.
pub(crate) fn plan(hollowed: &Hollowed, request: &PlanRequest) -> Result<CutPlan, CutError> {
    cut::plan(hollowed, request)?.or_error()
}

/// Returns a plan as in [`cut::plan_by`], with an obstacle as an error.
pub(crate) fn plan_by(
    hollowed: &Hollowed,
    request: &PlanRequest,
    order: &CutOrder,
) -> Result<CutPlan, CutError> {
    cut::plan_by(hollowed, request, order)?.or_error()
}

/// Returns the parts as in [`cut::parts`], with an obstacle as an error.
pub(crate) fn parts(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Vec<Part>, CutError> {
    cut::parts(hollowed, plan, request)?.or_error()
}
