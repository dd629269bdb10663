//! Faces in which the parts of a joint touch.

use crate::{
    cut::{
        geometry::{chart::Chart, tree::CutTree},
        joints::pin_shape::PinSite,
        pieces::split::{Joint, Piece, joints},
        plan::CutPlan,
    },
    geom::Plane,
    mass::FlatFace,
};

/// Returns the contact face of a joint: its faces less the mouths of its sockets.
pub(crate) fn contact<'a>(
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

/// Updates the joints' faces in a plan to those between these pieces, after the body was solved
/// again.
pub(crate) fn update_faces(pieces: &[Piece], tree: &CutTree, mut plan: CutPlan) -> CutPlan {
    for joint in joints(pieces, tree) {
        let (cut, parts) = (&plan.cuts[joint.cut].id, joint.parts());
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
