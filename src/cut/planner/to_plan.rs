//! The plan as data: its cuts, joints, pins and labels, and remarks for the user.

use crate::{
    cut::{
        access::void_access::VoidAccess,
        error::CutError,
        geometry::{
            chart::Chart,
            tree::{CutTree, Limit},
        },
        ids::CutId,
        joints::{
            contact::contact,
            label::labels,
            pin_size::min_room_mm,
            pins::{Pins, place_pins},
            placement::{PinScene, Placement},
        },
        pieces::split::{Joint, check_no_cavity, joints},
        plan::{Bridge, Cut, CutPlan, JointNote, UncutFace, index_of},
        planner::{layout::Layout, score::Scene},
        remark::{PinLack, Remark},
        request::PlanRequest,
    },
    geom::Plane,
};

/// Builds the plan from these cuts and pieces, and places the pins.
pub(crate) fn to_plan(
    scene: &Scene,
    layout: &Layout,
    pins: Pins,
    mut notes: Vec<Remark>,
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
    let placements = place_pins(&pin_scene, &joints, pins)?;
    let (labels, unlabelled) = labels(&pin_scene, &joints, &placements)?;
    let pairs = joints.iter().zip(&placements);
    notes.extend(
        pairs
            .clone()
            .filter_map(|(joint, placement)| pin_lack(scene.request, joint, placement)),
    );
    notes.extend(voids.iter().filter_map(|void| narrow_piece(scene, void)));
    notes.extend(unlabelled);
    Ok(CutPlan {
        cuts: cuts(tree),
        joints: pairs
            .map(|(joint, placement)| joint_note(tree, joint, placement))
            .collect(),
        pins: placements
            .into_iter()
            .flat_map(|placement| placement.sites)
            .collect(),
        uncut: uncut_faces(tree, bridges),
        labels,
        voids: voids.clone(),
        notes,
        solid: Vec::new(),
        drains: Vec::new(),
        moves: Vec::new(),
    })
}

/// Builds a plan with these cuts alone: no joint has pins, and no part a label. Voids may be closed
/// where seams are weighed against what stays solid.
pub(crate) fn to_draft(
    scene: &Scene,
    layout: &Layout,
    notes: Vec<Remark>,
) -> Result<CutPlan, CutError> {
    let Layout {
        tree,
        voids,
        pieces,
        bridges,
    } = layout;
    if !scene.request.seams.are_weighed() {
        check_no_cavity(pieces)?;
    }
    let bare = |joint: &Joint| joint_note(tree, joint, &Placement::default());
    Ok(CutPlan {
        cuts: cuts(tree),
        joints: joints(pieces, tree).iter().map(bare).collect(),
        pins: Vec::new(),
        uncut: uncut_faces(tree, bridges),
        labels: Vec::new(),
        voids: voids.clone(),
        notes,
        solid: Vec::new(),
        drains: Vec::new(),
        moves: Vec::new(),
    })
}

/// Gives the plan's cuts the names of the order. The planner itself only numbers them.
pub(crate) fn rename_cuts(mut plan: CutPlan, cuts: &[Cut]) -> CutPlan {
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
    plan.notes
        .iter_mut()
        .flat_map(Remark::cuts_mut)
        .for_each(name);
    plan.cuts = cuts.to_vec();
    plan
}

fn cuts(tree: &CutTree) -> Vec<Cut> {
    (0..tree.planes.len())
        .map(|index| cut(tree, index))
        .collect()
}

fn uncut_faces(tree: &CutTree, bridges: &[Bridge]) -> Vec<UncutFace> {
    bridges
        .iter()
        .map(|bridge| uncut_face(&tree.planes, bridge))
        .collect()
}

fn uncut_face(planes: &[Plane], bridge: &Bridge) -> UncutFace {
    let plane = &planes[bridge.cut];
    let point_mm = Chart::of_plane(plane).lift(plane, &bridge.at).into();
    UncutFace {
        cut: CutId::of(bridge.cut),
        point_mm,
    }
}

fn joint_note(tree: &CutTree, joint: &Joint, placement: &Placement) -> JointNote {
    JointNote {
        cut: CutId::of(joint.cut),
        parts: joint.parts(),
        area_mm2: joint.area_mm2(),
        pins: placement.sites.iter().map(|site| site.id.clone()).collect(),
        one_way: placement.is_one_way,
        play: placement.hold.play,
        held: placement.hold.is_enough,
        face: contact(&tree.planes, joint, &placement.sites),
    }
}

/// Returns the remark on a void with a piece whose mouth is too narrow.
fn narrow_piece(scene: &Scene, void: &VoidAccess) -> Option<Remark> {
    let least_opening_mm = void.least_opening_mm(scene.request);
    (void.opening_mm < least_opening_mm).then_some(Remark::NarrowPiece {
        void: void.void,
        opening_mm: void.opening_mm,
        least_opening_mm,
    })
}

/// Returns the remark on a joint that lacks two pins fitting one way only.
fn pin_lack(request: &PlanRequest, joint: &Joint, placement: &Placement) -> Option<Remark> {
    let (widest_mm, needed_mm) = (placement.widest_mm, min_room_mm(request));
    let cause = match placement.sites.len() {
        0 if widest_mm < needed_mm => PinLack::TooNarrow {
            widest_mm,
            needed_mm,
        },
        0 => PinLack::TooThin,
        1 => PinLack::OnePin,
        _ if !placement.is_one_way => PinLack::Ambiguous,
        _ if !placement.hold.is_enough => PinLack::Loose,
        _ => return None,
    };
    let parts = joint.parts();
    Some(Remark::LacksPins { parts, cause })
}

fn cut(tree: &CutTree, index: usize) -> Cut {
    let plane = &tree.planes[index];
    let within = tree.limits(index).iter().map(Limit::side).collect();
    Cut {
        id: CutId::of(index),
        point_mm: plane.foot().into(),
        normal: plane.normal.into(),
        within,
    }
}
