//! The planner: the fewest planes that open every void, or the planes that were ordered.

pub(crate) mod attempt;
pub(crate) mod cover;
pub(crate) mod draft;
pub(crate) mod extra;
pub(crate) mod family;
pub(crate) mod fewer;
pub(crate) mod fit;
pub(crate) mod layers;
pub(crate) mod layout;
pub(crate) mod limit;
pub(crate) mod mirror;
pub(crate) mod scene;
pub(crate) mod score;
pub(crate) mod search;
pub(crate) mod shift;
pub(crate) mod straighten;
pub(crate) mod to_plan;
pub(crate) mod turns;
pub(crate) mod whole;

#[cfg(test)]
mod tests;

use crate::{
    base::verdict::Verdict,
    cut::{
        access::void_access::{accesses, report},
        drains::measure_drained,
        error::{CutError, Obstacle, verdict},
        geometry::tree::{CutTree, Limit},
        hollowed::Hollowed,
        ids::{CutId, PartId},
        joints::pins::Pins,
        order::CutOrder,
        pieces::{rejoin::rejoin, split::Piece},
        plan::{Cut, CutPlan, bridges_on, tree_of},
        planner::{
            attempt::{Attempt, cleanest},
            extra::add_extra_cuts,
            fewer::fewer_clean_cuts,
            fit::fit_build_volume,
            layers::snap_to_layers,
            layout::Layout,
            score::{Scene, burden},
            search::{Found, smallest_plans},
            shift::shift_to_creases,
            straighten::straighten,
            to_plan::{rename_cuts, to_plan},
            whole::whole_parts,
        },
        remark::Remark,
        request::PlanRequest,
        seam::clear::ClearBalls,
        side::CutSide,
    },
    geom::{Plane, Point},
    mesh::move_off_faces,
};

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
    let Fewest { layout, notes, .. } = fewest_cuts(&scene, find_plans(&scene)?.as_ref())?;
    let plan = to_plan(&scene, &layout, Pins::Placed, notes.clone())?;
    snap_to_layers(&scene, &layout, plan, notes)
}

/// Finds the smallest plans for a body; `None` if it has no voids.
fn find_plans(scene: &Scene) -> Result<Option<Found>, CutError> {
    let has_voids = !scene.hollowed.voids.is_empty();
    has_voids.then(|| smallest_plans(scene)).transpose()
}

/// The fewest cuts that open every void, with those that clean and those that make parts fit.
struct Fewest {
    layout: Layout,
    /// The remarks on the cuts.
    notes: Vec<Remark>,
    /// The planes that the search found, before they were moved and others added.
    sought: Vec<Plane>,
}

/// Returns the fewest cuts of the plans found.
fn fewest_cuts(scene: &Scene, found: Option<&Found>) -> Result<Fewest, CutError> {
    let mut notes = Vec::new();
    let mut sought = Vec::new();
    let mut layout = match found {
        Some(found) => {
            let attempt = cleanest(scene, &found.plans)?;
            sought.clone_from(&attempt.planes);
            opening_cuts(scene, attempt, found, &mut notes)?
        }
        None => Layout::new(scene, Vec::new(), Vec::new())?,
    };
    fit_build_volume(scene, &mut layout, &mut notes)?;
    notes.extend(limited_cut_remarks(&layout.tree));
    notes.extend(small_part_remarks(scene, &layout));
    Ok(Fewest {
        layout,
        notes,
        sought,
    })
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
    check_clear(&scene, &tree, &cuts)?;
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

/// Returns an error if the seam of an ordered cut enters a ball that is to be kept clear.
fn check_clear(scene: &Scene, tree: &CutTree, cuts: &[Cut]) -> Result<(), CutError> {
    let outer = scene.hollowed.outer.mesh();
    let balls = ClearBalls::new(&scene.request.seams.keep_clear, outer, 0.0);
    let mut cut_and_parting = cuts.iter().zip(tree.partings());
    let entered = cut_and_parting.find_map(|(cut, parting)| {
        let ball = balls.entered_within(&parting)?;
        let cut = cut.id.clone();
        Some(Obstacle::SeamInBall { cut, ball })
    });
    entered.map_or(Ok(()), |obstacle| Err(obstacle.into()))
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
/// openings, depths and visible shares change; cuts, pins, joints and drain holes stay.
pub fn measure_voids_again(
    hollowed: &Hollowed,
    plan: CutPlan,
    request: &PlanRequest,
) -> Result<CutPlan, CutError> {
    if !plan.drains.is_empty() {
        return measure_drained(hollowed, plan);
    }
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

/// Returns the layout of the best of the smallest plans, with more cuts where they are needed to
/// clean.
fn opening_cuts(
    scene: &Scene,
    best: Attempt,
    found: &Found,
    notes: &mut Vec<Remark>,
) -> Result<Layout, CutError> {
    notes.push(Remark::Fewest(found.proof()));
    let best = shift_to_creases(scene, straighten(scene, best)?)?;
    let mut of_extra = Vec::new();
    let full = add_extra_cuts(scene, best.clone(), &mut of_extra)?;
    let has_extra = full.planes.len() > best.planes.len();
    // With more cuts, each has more room to move.
    let full = if has_extra {
        shift_to_creases(scene, full)?
    } else {
        full
    };
    let (full, has_extra) = match fewer_clean_cuts(scene, &full, found)? {
        Some(clean) => {
            of_extra.clear();
            (clean, false)
        }
        None => (full, has_extra),
    };
    let lack_ratio = full.lack_ratio();
    let layout = Layout::new(scene, full.planes, full.voids)?;
    let layout = if layout.count_small(scene) == 0 {
        notes.extend(of_extra);
        layout
    } else {
        let others = has_extra.then(|| best.planes.clone()).into_iter();
        let plans = others.chain(found.plans.iter().map(|plan| plan.planes.clone()));
        match whole_parts(scene, plans, lack_ratio)? {
            Some(whole) => whole,
            None => {
                notes.extend(of_extra);
                layout
            }
        }
    };
    let score = |(index, plane): (usize, &Plane)| Remark::Score {
        cut: CutId::of(index),
        terms: burden(scene, plane).terms(scene).to_vec(),
    };
    notes.extend(layout.tree.planes.iter().enumerate().map(score));
    Ok(layout)
}

/// Returns a remark on each part that is below the least all the same.
fn small_part_remarks(scene: &Scene, layout: &Layout) -> Vec<Remark> {
    let pieces = layout.pieces.iter().enumerate();
    let small = pieces.filter(|(_, piece)| layout.is_small(scene, piece));
    let remark = |(index, piece): (usize, &Piece)| Remark::SmallPart {
        part: PartId::of(index),
        mass_ratio: piece.volume_mm3 / scene.volume_mm3,
    };
    small.map(remark).collect()
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
