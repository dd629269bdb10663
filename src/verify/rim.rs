//! The rim of a joint in the files: the faces in which its parts touch.

use super::{PartEvidence, PromisedJoint};
use crate::geom::{Bvh, Plane, Point};

/// Corners within this distance of a joint's plane lie in it, and of a face on it, mm. It is far
/// above the rounding of files, far below a layer.
const ON_FACE_MM: f64 = 1e-3;

/// Returns the corners of the faces in which both parts of a joint touch, model frame. `None` if a
/// part is missing.
pub(super) fn rim_of(
    joint: &PromisedJoint,
    plane: &Plane,
    parts: &[PartEvidence],
) -> Option<Vec<Point>> {
    let part = |id: &String| parts.iter().find(|part| part.id == *id);
    let [below, above] = [part(&joint.parts[0])?, part(&joint.parts[1])?];
    let faces = [below, above].map(|part| flat_faces(part, plane));
    let on = faces
        .each_ref()
        .map(|faces| Bvh::new(faces.iter().copied()));
    let shared = |face: usize| {
        let other = &on[1 - face];
        let corners = faces[face].iter().flatten();
        corners.filter(move |p| other.closest(p, ON_FACE_MM, &[]).is_some())
    };
    Some(shared(0).chain(shared(1)).copied().collect())
}

/// Returns the triangles of a part in a plane of the model, model frame.
fn flat_faces(part: &PartEvidence, plane: &Plane) -> Vec<[Point; 3]> {
    let is_flat = |corners: &[Point; 3]| {
        let mut corners = corners.iter();
        corners.all(|p| plane.distance(p).abs() <= ON_FACE_MM)
    };
    let corners = part.mesh.iter_corners();
    let corners = corners.map(|corners| corners.map(|p| part.pose.to_model(&p)));
    corners.filter(is_flat).collect()
}
