//! The play of joints: computed again from the pins on the checklist and the faces in the files.

use super::{Hardware, HeldBy, PartEvidence, Peg, Promise, PromisedJoint, PromisedPart};
use crate::geom::play::{Play, Spot, Stop};
use crate::geom::{Bvh, Plane, Point, Vector};

/// Corners within this distance of a joint's plane lie in it, and of a face on it, mm: far above
/// the rounding of files, far below a layer.
const ON_FACE_MM: f64 = 1e-3;

/// A joint as its pins and faces hold it.
#[derive(Debug, Clone, PartialEq)]
pub struct JointFacts {
    /// The name on the sheet, such as `J1`.
    pub id: String,
    /// The play that its pins leave; `None` if they leave a turn free, or it has fewer than two.
    pub play: Option<Play>,
}

/// Measures the play of every joint, in the order of the checklist.
pub(super) fn measure_joints(promise: &Promise, parts: &[PartEvidence]) -> Vec<JointFacts> {
    let facts = |joint: &PromisedJoint| JointFacts {
        id: joint.id.clone(),
        play: play(joint, promise, parts),
    };
    promise.joints.iter().map(facts).collect()
}

fn play(joint: &PromisedJoint, promise: &Promise, parts: &[PartEvidence]) -> Option<Play> {
    let seats = seats(joint, promise);
    let first = seats.first()?;
    let plane = Plane::through(&first.at, &first.axis);
    let (u, v) = plane.basis();
    let flat = |p: &Point| Spot::new(u.dot(&p.coords), v.dot(&p.coords));
    let around = |seat: &Seat| Stop::around(flat(&seat.at), seat.room_mm);
    let stops: Vec<Stop> = seats.iter().flat_map(around).collect();
    let rim: Vec<Spot> = rim(joint, &plane, parts)?.iter().map(flat).collect();
    Play::of(&stops, &rim)
}

/// A pin in its socket, or a dowel in both of its own.
struct Seat {
    at: Point,
    axis: Vector,
    /// The gap by which the parts move to each side, mm.
    room_mm: f64,
}

/// Returns the seats of a joint, as the checklist states their sizes.
fn seats(joint: &PromisedJoint, promise: &Promise) -> Vec<Seat> {
    let pegs = |of: fn(&PromisedPart) -> &[Peg]| {
        let all = promise.parts.iter().flat_map(of);
        all.filter(|peg| peg.joint == joint.id)
    };
    let sockets = || pegs(|part| &part.sockets);
    let seat = |socket: &Peg, diameter_mm: f64, gaps: f64| Seat {
        at: Point::from(socket.center_mm),
        axis: Vector::from(socket.axis),
        room_mm: gaps * (socket.diameter_mm - diameter_mm) / 2.0,
    };
    let printed = pegs(|part| &part.pins).filter_map(|pin| {
        let socket = sockets().find(|socket| socket.id == pin.id)?;
        Some(seat(socket, pin.diameter_mm, 1.0))
    });
    let dowels = promise.dowels.iter().filter_map(|dowel: &Hardware| {
        let socket = sockets().find(|socket| socket.id == dowel.id)?;
        Some(seat(socket, dowel.diameter_mm, 2.0))
    });
    printed.chain(dowels).collect()
}

/// Returns the corners of the faces in which both parts of a joint touch, model frame. `None` if a
/// part is missing.
fn rim(joint: &PromisedJoint, plane: &Plane, parts: &[PartEvidence]) -> Option<Vec<Point>> {
    let part = |id: &String| parts.iter().find(|part| part.id == *id);
    let [below, above] = [part(&joint.parts[0])?, part(&joint.parts[1])?];
    let faces = [below, above].map(|part| flat_faces(part, plane));
    let on = faces.each_ref().map(|faces| Bvh::new(faces.iter().copied()));
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

impl JointFacts {
    /// Returns the largest step at the rim, mm; infinite if the pins leave a turn free.
    pub fn step_mm(&self) -> f64 {
        self.play.map_or(f64::INFINITY, |play| play.step_mm)
    }
}

/// Returns the joint with the largest step of those that their pins hold; `None` without any.
pub(super) fn worst_joint<'a>(promise: &Promise, found: &'a [JointFacts]) -> Option<&'a JointFacts> {
    let joints = promise.joints.iter().zip(found);
    let held = joints.filter(|(joint, _)| joint.held_by == Some(HeldBy::Pins));
    let facts = held.map(|(_, facts)| facts);
    facts.max_by(|a, b| a.step_mm().total_cmp(&b.step_mm()))
}
