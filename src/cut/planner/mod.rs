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
        pieces::{pose::fits, rejoin::rejoin, split::Piece},
        plan::{Cut, CutPlan, bridges_on, tree_of},
        planner::{
            extra::{Attempt, add_extra_cuts, cleanest},
            layers::snap_to_layers,
            layout::Layout,
            score::{Scene, burden},
            search::smallest_plans,
            to_plan::{rename_cuts, to_plan},
        },
        remark::Remark,
        request::PlanRequest,
        side::CutSide,
    },
    geom::{Plane, Point, Vector},
    mesh::{move_off_faces, move_off_vertices},
};

/// Greatest number of extra cuts that make parts fit the build volume.
const MAX_FITTING_CUTS: usize = 8;

/// Finds the fewest cuts that open every void by the required disc, and places pins in every joint.
/// Among plans of equally few cuts, it takes the best-scored with which every void can be cleaned
/// by the printer's rule. It adds cuts if there is none, or if a part would not fit the build
/// volume. [`is_clean`](crate::cut::VoidAccess::is_clean) is false for voids that stay uncleanable.
///
/// "Fewest" is proved by exact set cover over the family of planes tried; the notes give its size.
/// The search takes about a second for 200k triangles and ten voids.
pub fn plan(
    hollowed: &Hollowed,
    request: &PlanRequest,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    verdict(plan_fewest(hollowed, request))
}

fn plan_fewest(hollowed: &Hollowed, request: &PlanRequest) -> Result<CutPlan, CutError> {
    check_request(request)?;
    let scene = Scene::new(hollowed, request)?;
    let mut notes = Vec::new();
    let mut layout = opening_cuts(&scene, &mut notes)?;
    fit_build_volume(&scene, &mut layout, &mut notes)?;
    notes.extend(limited_cut_remarks(&layout.tree));
    let plan = to_plan(&scene, &layout, Pins::Placed, notes.clone())?;
    snap_to_layers(&scene, &layout, plan, notes)
}

/// Plans the ordered cuts, each limited to its ordered sides and without the faces ordered to stay
/// whole. Pins are as ordered, or placed as in [`plan`]. Joints and openings follow.
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

/// Plans the ordered cuts as in [`plan_by`], but the planner places pins in joints without an
/// ordered pin.
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
    unordered: UnorderedJoints,
) -> Result<CutPlan, CutError> {
    check_request(request)?;
    let scene = Scene::new(hollowed, request)?;
    let cuts = order
        .cuts
        .iter()
        .map(|cut| move_cut_off_faces(&scene, cut))
        .collect::<Result<Vec<_>, CutError>>()?;
    let (tree, numbered) = (tree_of(&cuts)?, order.numbered());
    let bridges = bridges_on(&tree.planes, &numbered.cuts, &numbered.uncut);
    let pieces = rejoin(scene.split(&tree)?, &tree, &bridges, &request.watch)?;
    let voids = accesses(&scene.chambers, &tree, request)?;
    let pins = match (&numbered.pins, unordered) {
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
        ..rename_cuts(plan, &cuts)
    })
}

/// Returns the cut as ordered, or moved off faces of which it would leave a thin sheet.
fn move_cut_off_faces(scene: &Scene, cut: &Cut) -> Result<Cut, CutError> {
    let plane = cut.plane()?;
    let moved_mm = move_off_faces(&scene.material, &plane).offset_mm - plane.offset_mm;
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

/// The pins in joints for which none were ordered.
enum UnorderedJoints {
    None,
    Placed,
}

/// Returns the plan with its voids measured again on a body that was solved again. Volumes,
/// openings, depths and visible shares change; cuts, pins and joints stay.
pub fn measure_voids_again(
    hollowed: &Hollowed,
    plan: CutPlan,
    request: &PlanRequest,
) -> Result<CutPlan, CutError> {
    Ok(CutPlan {
        voids: report(hollowed, &plan.tree()?, request)?,
        ..plan
    })
}

/// Returns an error if a length is out of range.
fn check_request(request: &PlanRequest) -> Result<(), CutError> {
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

/// Returns the layout of the best of the smallest plans.
fn opening_cuts(scene: &Scene, notes: &mut Vec<Remark>) -> Result<Layout, CutError> {
    if scene.hollowed.voids.is_empty() {
        return Layout::new(scene, Vec::new(), Vec::new());
    }
    let found = smallest_plans(scene)?;
    notes.push(Remark::Fewest(found.proof()));
    let best = cleanest(scene, &found.plans)?;
    let Attempt { planes, voids, .. } = add_extra_cuts(scene, best, notes)?;
    let score = |(index, plane): (usize, &Plane)| Remark::Score {
        cut: CutId::of(index),
        terms: burden(scene, plane).terms(scene).to_vec(),
    };
    notes.extend(planes.iter().enumerate().map(score));
    Layout::new(scene, planes, voids)
}

/// Returns a remark on each cut that is limited to sides of others.
fn limited_cut_remarks(tree: &CutTree) -> impl Iterator<Item = Remark> {
    let remark = |cut: usize| {
        let sides: Vec<CutSide> = tree.limits(cut).iter().map(Limit::side).collect();
        let cut = CutId::of(cut);
        (!sides.is_empty()).then_some(Remark::LimitedCut { cut, sides })
    };
    (0..tree.planes.len()).filter_map(remark)
}

/// Bisects pieces that do not fit the build volume, across their longest extent, until all fit.
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
        let middle = move_off_vertices(&scene.material, &middle);
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
