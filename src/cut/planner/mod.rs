//! The planner: the fewest planes that open every void, or the planes that were ordered.

pub(crate) mod cover;
pub(crate) mod extra;
pub(crate) mod family;
pub(crate) mod layers;
pub(crate) mod layout;
pub(crate) mod limit;
pub(crate) mod mirror;
pub(crate) mod score;
pub(crate) mod search;
pub(crate) mod to_plan;

#[cfg(test)]
mod tests;

use crate::{
    base::verdict::Verdict,
    cut::{
        access::void_access::{accesses, report},
        error::{CutError, Obstacle, verdict},
        geometry::tree::{CutTree, Limit},
        hollowed::Hollowed,
        ids::CutId,
        joints::pins::Pins,
        order::CutOrder,
        pieces::{pose::fits, rejoin::rejoined, split::Piece},
        plan::{Cut, CutPlan, bridges_on, tree_of},
        planner::{
            extra::{Tried, add_extra_cuts, cleanest},
            layers::at_layers,
            layout::Layout,
            score::{Scene, burden},
            search::smallest_plans,
            to_plan::{named_as, to_plan},
        },
        remark::Remark,
        request::PlanRequest,
        side::CutSide,
    },
    geom::{Plane, Point, Vector},
    mesh::{off_faces, off_vertices},
};

/// How many further cuts may be made so that parts fit the build volume.
const MAX_FITTING_CUTS: usize = 8;

/// The fewest cuts that open every void by at least the asked disc, the best of them by named terms
/// with which every void can be cleaned by the printer's rule; further cuts where none of them
/// does, or where a part would not fit the build volume; and pins for every joint. Voids that no
/// cut lets be cleaned are told by [`is_clean`](crate::cut::VoidAccess::is_clean).
///
/// "Fewest" is proved by exact set cover over the family of planes tried; the notes say over how
/// many. About a second for 200k triangles and ten voids.
pub fn plan(
    hollowed: &Hollowed,
    request: &PlanRequest,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    verdict(plan_fewest(hollowed, request))
}

fn plan_fewest(hollowed: &Hollowed, request: &PlanRequest) -> Result<CutPlan, CutError> {
    check(request)?;
    let scene = Scene::new(hollowed, request)?;
    let mut notes = Vec::new();
    let mut layout = opening_cuts(&scene, &mut notes)?;
    fit_build_volume(&scene, &mut layout, &mut notes)?;
    notes.extend(limited_cuts(&layout.tree));
    let plan = to_plan(&scene, &layout, Pins::Placed, notes.clone())?;
    at_layers(&scene, &layout, plan, notes)
}

/// The plan by a person's order: each cut through what lies on the sides that it is kept to, but
/// for the faces that are to stay whole; pins as ordered, or placed as in [`plan`]. Joints and
/// openings follow.
pub fn plan_by(
    hollowed: &Hollowed,
    request: &PlanRequest,
    order: &CutOrder,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    verdict(plan_ordered(
        hollowed,
        request,
        order,
        UnorderedJoints::None,
    ))
}

/// The plan by an order as in [`plan_by`], but that joints in which none of its pins stands get the
/// planner's.
pub fn plan_around(
    hollowed: &Hollowed,
    request: &PlanRequest,
    order: &CutOrder,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    verdict(plan_ordered(
        hollowed,
        request,
        order,
        UnorderedJoints::Placed,
    ))
}

fn plan_ordered(
    hollowed: &Hollowed,
    request: &PlanRequest,
    order: &CutOrder,
    others: UnorderedJoints,
) -> Result<CutPlan, CutError> {
    check(request)?;
    let scene = Scene::new(hollowed, request)?;
    let cuts = order
        .cuts
        .iter()
        .map(|cut| beside_faces(&scene, cut))
        .collect::<Result<Vec<_>, CutError>>()?;
    let (tree, own) = (tree_of(&cuts)?, order.numbered());
    let bridges = bridges_on(&tree.planes, &own.cuts, &own.uncut);
    let pieces = rejoined(scene.split(&tree)?, &tree, &bridges)?;
    let voids = accesses(&scene.chambers, &tree, request)?;
    let pins = match (&own.pins, others) {
        (None, _) => Pins::Placed,
        (Some(pins), UnorderedJoints::None) => Pins::Ordered(pins),
        (Some(pins), UnorderedJoints::Placed) => Pins::Around(pins),
    };
    let plan = to_plan(
        &scene,
        &Layout {
            tree,
            voids,
            pieces,
            bridges,
        },
        pins,
        Vec::new(),
    )?;
    Ok(CutPlan {
        solid: order.solid.clone(),
        ..named_as(plan, &cuts)
    })
}

/// The cut as ordered, or beside the faces that it would leave a sheet of.
fn beside_faces(scene: &Scene, cut: &Cut) -> Result<Cut, CutError> {
    let plane = cut.plane()?;
    let moved_mm = off_faces(&scene.material, &plane).offset_mm - plane.offset_mm;
    let point_mm = if moved_mm == 0.0 {
        cut.point_mm
    } else {
        (Point::from(cut.point_mm) + plane.normal * moved_mm).into()
    };
    Ok(Cut {
        point_mm,
        ..cut.clone()
    })
}

/// Which pins joints get where a person ordered none.
enum UnorderedJoints {
    None,
    Placed,
}

/// The plan with what it does to the voids of a body that was solved for again: their volumes,
/// openings, depths and sights. Cuts, pins and joints stay.
pub fn plan_of(
    hollowed: &Hollowed,
    plan: CutPlan,
    request: &PlanRequest,
) -> Result<CutPlan, CutError> {
    Ok(CutPlan {
        voids: report(hollowed, &plan.tree()?, request)?,
        ..plan
    })
}

/// Refuses lengths that cannot be.
fn check(request: &PlanRequest) -> Result<(), CutError> {
    let pins = &request.pins;
    let positive = [
        ("min_opening_mm", request.min_opening_mm),
        ("wall_mm", request.wall_mm),
        ("pins.min_diameter_mm", pins.min_diameter_mm),
        ("pins.length_ratio", pins.length_ratio),
        ("axis.direction", request.axis.direction.norm()),
    ];
    let not_negative = [
        ("pins.clearance_mm", pins.clearance_mm),
        ("pins.chamfer_mm", pins.chamfer_mm),
        ("pins.bottom_relief_mm", pins.bottom_relief_mm),
        ("pixel_mm", request.pixel_mm),
        ("hole_step_mm", request.hole_step_mm),
        ("layer_mm", request.layer_mm),
    ];
    let bad = positive
        .into_iter()
        .find(|(_, value)| !(*value > 0.0 && value.is_finite()));
    let bad = bad.or(not_negative
        .into_iter()
        .find(|(_, value)| !(*value >= 0.0 && value.is_finite())));
    bad.map_or(Ok(()), |(name, value)| {
        Err(CutError::BadRequest { name, value })
    })
}

/// The best of the smallest plans, and its pieces.
fn opening_cuts(scene: &Scene, notes: &mut Vec<Remark>) -> Result<Layout, CutError> {
    if scene.hollowed.voids.is_empty() {
        return Layout::new(scene, Vec::new(), Vec::new());
    }
    let found = smallest_plans(scene)?;
    notes.push(Remark::Fewest(found.proof()));
    let best = cleanest(scene, &found.plans)?;
    let Tried { planes, voids, .. } = add_extra_cuts(scene, best, notes)?;
    let score = |(index, plane): (usize, &Plane)| Remark::Score {
        cut: CutId::of(index),
        terms: burden(scene, plane).terms(scene).to_vec(),
    };
    notes.extend(planes.iter().enumerate().map(score));
    Layout::new(scene, planes, voids)
}

/// The cuts that are made on sides of others only.
fn limited_cuts(tree: &CutTree) -> impl Iterator<Item = Remark> {
    let remark = |cut: usize| {
        let sides: Vec<CutSide> = tree.limits(cut).iter().map(Limit::side).collect();
        let cut = CutId::of(cut);
        (!sides.is_empty()).then_some(Remark::LimitedCut { cut, sides })
    };
    (0..tree.planes.len()).filter_map(remark)
}

/// Cuts pieces that do not fit the build volume in two, across their longest extent, until all fit.
fn fit_build_volume(
    scene: &Scene,
    layout: &mut Layout,
    notes: &mut Vec<Remark>,
) -> Result<(), CutError> {
    for _ in 0..MAX_FITTING_CUTS {
        let is_large = |piece: &&Piece| !fits(piece, &layout.tree.planes, scene.request);
        let Some(piece) = layout.pieces.iter().find(is_large) else {
            return Ok(());
        };
        let aabb = piece.mesh.aabb();
        let middle = Plane::through(&aabb.center(), &Vector::ith(aabb.size().imax(), 1.0));
        let middle = off_vertices(&scene.material, &middle);
        let planes: Vec<Plane> = layout.tree.planes.iter().copied().chain([middle]).collect();
        let voids = accesses(
            &scene.chambers,
            &CutTree::everywhere(&planes),
            scene.request,
        )?;
        *layout = Layout::new(scene, planes, voids)?;
        let cut = CutId::of(layout.tree.planes.len() - 1);
        notes.push(Remark::FittingCut(cut));
    }
    Ok(())
}
