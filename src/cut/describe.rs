//! A plan told from its cuts and the pieces they leave: pins, joints, and what a person should know.

use super::{
    access::VoidAccess,
    error::CutError,
    pattern::Peg,
    pin_shape::PinSite,
    pins::{PinScene, Placement, needed_room_mm, place},
    plan::{Cut, CutPlan, JointNote, UncutFace, cut_id, part_id, pin_id},
    planner::Layout,
    rejoin::Bridge,
    request::PlanRequest,
    score::Scene,
    section::Chart,
    split::{Joint, Piece, check_no_cavity, joints},
};
use crate::geom::Plane;

/// The plan's data for these cuts and pieces.
pub(crate) fn described(scene: &Scene, layout: Layout, mut notes: Vec<String>) -> Result<CutPlan, CutError> {
    let Layout { planes, voids, pieces, bridges } = layout;
    check_no_cavity(&pieces)?;
    let pin_scene =
        PinScene { request: scene.request, planes: &planes, pieces: &pieces, material: &scene.material };
    let (mut pins, mut joint_notes) = (Vec::new(), Vec::new());
    let mut placed: Vec<Vec<Peg>> = Vec::new();
    for joint in joints(&pieces) {
        let placement = place(&pin_scene, &joint, &placed);
        placed.push(placement.pegs.clone());
        notes.extend(shortage(scene.request, &joint, &placement));
        joint_notes.push(joint_note(&pieces, &joint, &placement, pins.len()));
        pins.extend(placement.sites.into_iter().map(|site| PinSite { cut: cut_id(joint.cut), ..site }));
    }
    for (index, pin) in pins.iter_mut().enumerate() {
        pin.id = pin_id(index);
    }
    let cuts = planes.iter().enumerate().map(|(i, plane)| cut(i, plane)).collect();
    notes.extend(voids.iter().filter_map(|void| narrow(scene, void)));
    let uncut = bridges.iter().map(|bridge| uncut_face(&planes, bridge)).collect();
    Ok(CutPlan { cuts, pins, joints: joint_notes, voids, uncut, notes })
}

fn uncut_face(planes: &[Plane], bridge: &Bridge) -> UncutFace {
    let plane = &planes[bridge.cut];
    let point_mm = Chart::of_plane(plane).lift(plane, &bridge.at).into();
    UncutFace { cut: cut_id(bridge.cut), point_mm }
}

fn joint_note(pieces: &[Piece], joint: &Joint, placement: &Placement, first_pin: usize) -> JointNote {
    JointNote {
        cut: cut_id(joint.cut),
        parts: [part_id(joint.below), part_id(joint.above)],
        area_mm2: joint.caps.iter().map(|&cap| pieces[joint.below].caps[cap].area_mm2).sum(),
        pins: (0..placement.sites.len()).map(|i| pin_id(first_pin + i)).collect(),
        one_way: placement.is_one_way,
    }
}

/// What to say of a void one of whose pieces has a narrow mouth, where two cuts leave a pocket behind one of them.
fn narrow(scene: &Scene, void: &VoidAccess) -> Option<String> {
    let (index, opening) = (void.void, void.opening_mm);
    let asked = scene.request.needed_mm(index, scene.hollowed.voids.len());
    let note =
        || format!("void {index}: a piece of it opens by {opening:.2} mm only, asked are {asked:.2} mm");
    (opening < asked).then(note)
}

/// What to say of a joint that has not at least two pins that fit one way only.
fn shortage(request: &PlanRequest, joint: &Joint, placement: &Placement) -> Option<String> {
    let name = format!("joint {}–{}", part_id(joint.below), part_id(joint.above));
    let (widest, needed) = (placement.widest_mm, needed_room_mm(request));
    match placement.sites.len() {
        0 if widest < needed => {
            Some(format!("{name}: no room for pins: widest section {widest:.1} mm, needs {needed:.1} mm"))
        }
        0 => Some(format!("{name}: no room for pins: the material behind the cut is too thin for a socket")),
        1 => Some(format!("{name}: room for one pin only; mind the turn when gluing")),
        _ if !placement.is_one_way => {
            Some(format!("{name}: the pins fit in more than one way; mind the turn when gluing"))
        }
        _ => None,
    }
}

fn cut(index: usize, plane: &Plane) -> Cut {
    Cut { id: cut_id(index), point_mm: plane.foot().into(), normal: plane.normal.into() }
}
