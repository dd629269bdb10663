//! A plan told from its cuts and the pieces they leave: pins, joints, and what a person should
//! know.

use crate::{
    cut::{
        access::void_access::VoidAccess,
        error::CutError,
        geometry::{
            chart::Chart,
            tree::{CutTree, Limit},
        },
        ids::{CutId, PartId},
        joints::{
            contact::contact,
            label::labels,
            pin_size::needed_room_mm,
            pins::{Pins, pinned},
            placement::{PinScene, Placement},
        },
        pieces::split::{Joint, check_no_cavity, joints},
        plan::{Bridge, Cut, CutPlan, CutSide, JointNote, Side, UncutFace, index_of},
        planner::{layout::Layout, score::Scene},
        request::PlanRequest,
    },
    geom::Plane,
};

/// The plan's data for these cuts and pieces, with these pins.
pub(crate) fn to_plan(
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
    let name = |id: &mut CutId| {
        let index = index_of(&plan.cuts, id);
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
        cut: CutId::of(bridge.cut),
        point_mm,
    }
}

fn joint_note(scene: &PinScene, joint: &Joint, placement: &Placement) -> JointNote {
    JointNote {
        cut: CutId::of(joint.cut),
        parts: joint.parts(),
        area_mm2: joint.area_mm2(),
        pins: placement.sites.iter().map(|site| site.id.clone()).collect(),
        one_way: placement.is_one_way,
        face: contact(&scene.tree.planes, joint, &placement.sites),
    }
}

/// What to say of a void one of whose pieces has a narrow mouth, where two cuts leave a pocket
/// behind one of them.
fn narrow(scene: &Scene, void: &VoidAccess) -> Option<String> {
    let (index, opening) = (void.void.index(), void.opening_mm);
    let asked = scene
        .request
        .needed_mm(void.void, scene.hollowed.voids.len());
    let note = || {
        format!(
            "void {index}: a piece of it opens by {opening:.2} mm only, asked are {asked:.2} mm"
        )
    };
    (opening < asked).then(note)
}

/// What to say of a joint that has not at least two pins that fit one way only.
fn shortage(request: &PlanRequest, joint: &Joint, placement: &Placement) -> Option<String> {
    let name = format!(
        "joint {}–{}",
        PartId::of(joint.below),
        PartId::of(joint.above)
    );
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
        cut: CutId::of(limit.cut),
        side: Side::of(limit.is_above),
    };
    let within = tree.limits(index).iter().map(side).collect();
    Cut {
        id: CutId::of(index),
        point_mm: plane.foot().into(),
        normal: plane.normal.into(),
        within,
    }
}
