//! A plan told from its cuts and the pieces they leave: pins, joints, and what a person should
//! know.

use super::{
    access::VoidAccess,
    error::CutError,
    label::labels,
    pin_shape::PinSite,
    pin_size::needed_room_mm,
    pins::{PinScene, Pins, Placement, pinned},
    plan::{Cut, CutPlan, CutSide, JointNote, Side, UncutFace, cut_id, part_id},
    planner::Layout,
    rejoin::Bridge,
    request::PlanRequest,
    score::Scene,
    section::Chart,
    split::{Joint, Piece, check_no_cavity, joints},
    tree::{CutTree, Limit},
};
use crate::{geom::Plane, mass::FlatFace};

/// The plan's data for these cuts and pieces, with these pins.
pub(crate) fn described(
    scene: &Scene,
    layout: &Layout,
    (pins, mut notes): (Pins, Vec<String>),
) -> Result<CutPlan, CutError> {
    let Layout {
        tree,
        voids,
        pieces,
        bridges,
    } = layout;
    check_no_cavity(pieces)?;
    let pin_scene = PinScene {
        request: scene.request,
        tree,
        material: &scene.material,
    };
    let joints = joints(pieces, tree);
    let placements = pinned(&pin_scene, &joints, pins)?;
    let proofs = notes.clone();
    let (labels, unlabelled) = labels(&pin_scene, &joints, &placements);
    let told = joints.iter().zip(&placements);
    notes.extend(
        told.clone()
            .filter_map(|(joint, placement)| shortage(scene.request, joint, placement)),
    );
    notes.extend(voids.iter().filter_map(|void| narrow(scene, void)));
    notes.extend(unlabelled);
    Ok(CutPlan {
        cuts: (0..tree.planes.len())
            .map(|index| cut(tree, index))
            .collect(),
        joints: told
            .map(|(joint, placement)| joint_note(&pin_scene, joint, placement))
            .collect(),
        pins: placements
            .into_iter()
            .flat_map(|placement| placement.sites)
            .collect(),
        uncut: bridges
            .iter()
            .map(|bridge| uncut_face(&tree.planes, bridge))
            .collect(),
        labels,
        voids: voids.clone(),
        notes,
        solid: Vec::new(),
        moves: Vec::new(),
        proofs,
    })
}

/// The plan with its cuts called as in the order it was made by: the planner numbers them.
pub(crate) fn named_as(mut plan: CutPlan, cuts: &[Cut]) -> CutPlan {
    let name = |id: &mut String| {
        let index = plan.cuts.iter().position(|cut| cut.id == *id);
        if let Some(cut) = index.and_then(|index| cuts.get(index)) {
            id.clone_from(&cut.id);
        }
    };
    plan.pins.iter_mut().for_each(|pin| name(&mut pin.cut));
    plan.joints
        .iter_mut()
        .for_each(|joint| name(&mut joint.cut));
    plan.labels
        .iter_mut()
        .for_each(|label| name(&mut label.cut));
    plan.uncut.iter_mut().for_each(|face| name(&mut face.cut));
    plan.voids
        .iter_mut()
        .flat_map(|void| &mut void.opened_by)
        .for_each(name);
    plan.cuts = cuts.to_vec();
    plan
}

fn uncut_face(planes: &[Plane], bridge: &Bridge) -> UncutFace {
    let plane = &planes[bridge.cut];
    let point_mm = Chart::of_plane(plane).lift(plane, &bridge.at).into();
    UncutFace {
        cut: cut_id(bridge.cut),
        point_mm,
    }
}

fn joint_note(scene: &PinScene, joint: &Joint, placement: &Placement) -> JointNote {
    JointNote {
        cut: cut_id(joint.cut),
        parts: [part_id(joint.below), part_id(joint.above)],
        area_mm2: joint.area_mm2(),
        pins: placement.sites.iter().map(|site| site.id.clone()).collect(),
        one_way: placement.is_one_way,
        face: contact(&scene.tree.planes, joint, &placement.sites),
    }
}

/// Where the parts of a joint touch: its faces less the mouths of its sockets.
fn contact<'a>(
    planes: &[Plane],
    joint: &Joint,
    pins: impl IntoIterator<Item = &'a PinSite>,
) -> FlatFace {
    let plane = &planes[joint.cut];
    let chart = Chart::of_plane(plane);
    let triangles = joint.faces.iter().flat_map(|face| &face.triangles);
    let faces = triangles.map(|corners| (corners.map(|p| chart.lift(plane, &p)), 1.0));
    let mouths = pins
        .into_iter()
        .flat_map(PinSite::mouth)
        .map(|corners| (corners, -1.0));
    FlatFace::of_triangles(faces.chain(mouths))
}

/// The plan with the faces of its joints as they are between these pieces, of a body that was
/// solved for again.
pub(crate) fn refaced(pieces: &[Piece], tree: &CutTree, mut plan: CutPlan) -> CutPlan {
    for joint in joints(pieces, tree) {
        let (cut, parts) = (
            &plan.cuts[joint.cut].id,
            [part_id(joint.below), part_id(joint.above)],
        );
        let Some(note) = plan
            .joints
            .iter_mut()
            .find(|note| note.cut == *cut && note.parts == parts)
        else {
            continue;
        };
        let pins = plan.pins.iter().filter(|pin| note.pins.contains(&pin.id));
        note.face = contact(&tree.planes, &joint, pins);
        note.area_mm2 = joint.area_mm2();
    }
    plan
}

/// What to say of a void one of whose pieces has a narrow mouth, where two cuts leave a pocket
/// behind one of them.
fn narrow(scene: &Scene, void: &VoidAccess) -> Option<String> {
    let (index, opening) = (void.void, void.opening_mm);
    let asked = scene.request.needed_mm(index, scene.hollowed.voids.len());
    let note = || {
        format!(
            "void {index}: a piece of it opens by {opening:.2} mm only, asked are {asked:.2} mm"
        )
    };
    (opening < asked).then(note)
}

/// What to say of a joint that has not at least two pins that fit one way only.
fn shortage(request: &PlanRequest, joint: &Joint, placement: &Placement) -> Option<String> {
    let name = format!("joint {}–{}", part_id(joint.below), part_id(joint.above));
    let (widest, needed) = (placement.widest_mm, needed_room_mm(request));
    match placement.sites.len() {
        0 if widest < needed => Some(format!(
            "{name}: no room for pins: widest section {widest:.1} mm, needs {needed:.1} mm"
        )),
        0 => Some(format!(
            "{name}: no room for pins: the material behind the cut is too thin for a socket"
        )),
        1 => Some(format!(
            "{name}: room for one pin only; mind the turn when gluing"
        )),
        _ if !placement.is_one_way => Some(format!(
            "{name}: the pins fit in more than one way; mind the turn when gluing"
        )),
        _ => None,
    }
}

fn cut(tree: &CutTree, index: usize) -> Cut {
    let plane = &tree.planes[index];
    let side = |limit: &Limit| CutSide {
        cut: cut_id(limit.cut),
        side: Side::of(limit.is_above),
    };
    let within = tree.limits(index).iter().map(side).collect();
    Cut {
        id: cut_id(index),
        point_mm: plane.foot().into(),
        normal: plane.normal.into(),
        within,
    }
}
