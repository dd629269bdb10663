//! The play of joints: computed again from the pins on the checklist and the faces in the files.

use super::rim::rim_of;
use super::{Hardware, HeldBy, JigFacts, PartEvidence, Peg, Promise, PromisedJoint, PromisedPart};
use crate::geom::play::{Play, Spot, Stop};
use crate::geom::{Plane, Point, Vector};

/// A joint as its pins and faces hold it.
#[derive(Debug, Clone, PartialEq)]
pub struct JointFacts {
    /// The name on the sheet, such as `J1`.
    pub id: String,
    /// The play that its pins or its jig leave; `None` if they leave a turn free, or there are
    /// none.
    pub play: Option<Play>,
    /// The unbalance in an end plane of a rotor if the lighter side shifts by this play, g·mm.
    /// `None` for other goals, and where other joints hold it.
    pub unbalance_g_mm: Option<f64>,
}

/// Measures the play of every joint, in the order of the checklist.
pub(super) fn measure_joints(
    promise: &Promise,
    parts: &[PartEvidence],
    jigs: &[JigFacts],
) -> Vec<JointFacts> {
    let in_jig = |joint: &PromisedJoint| {
        let jig = jigs.iter().find(|jig| jig.joint == joint.id);
        jig.and_then(|jig| jig.play)
    };
    let facts = |joint: &PromisedJoint| JointFacts {
        id: joint.id.clone(),
        play: match joint.held_by {
            Some(HeldBy::Jig) => in_jig(joint),
            _ => play(joint, promise, parts),
        },
        unbalance_g_mm: None,
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
    let rim = rim_of(joint, &plane, parts)?;
    let rim: Vec<Spot> = rim.iter().map(flat).collect();
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

impl JointFacts {
    /// Returns the largest step at the rim, mm; infinite if the pins leave a turn free.
    pub fn step_mm(&self) -> f64 {
        self.play.map_or(f64::INFINITY, |play| play.step_mm)
    }
}

/// Returns the joint with the largest step of those that pins or a jig hold; `None` without any.
pub(super) fn worst_joint<'a>(
    promise: &Promise,
    found: &'a [JointFacts],
) -> Option<&'a JointFacts> {
    let joints = promise.joints.iter().zip(found);
    let held =
        joints.filter(|(joint, _)| matches!(joint.held_by, Some(HeldBy::Pins | HeldBy::Jig)));
    let facts = held.map(|(_, facts)| facts);
    facts.max_by(|a, b| a.step_mm().total_cmp(&b.step_mm()))
}

#[cfg(test)]
mod tests {
    use super::super::judge_tests::{failures, judge, kit_with_two_pins};
    use super::super::{Evidence, HeldBy};
    use super::*;
    use crate::geom::play::step_bound_mm;

    #[test]
    fn the_step_follows_from_the_pins_and_the_faces_in_the_files() {
        let evidence = kit_with_two_pins();
        let found = judge(&evidence).joints.remove(0);
        let corners = [(30.0, 20.0), (-30.0, 20.0), (-30.0, -20.0), (30.0, -20.0)];
        let rim = corners.map(|(x, y)| Spot::new(x, y));
        let pins = [Spot::new(28.5, 0.0), Spot::new(-28.5, 0.0)];
        let ratio = found.step_mm() / step_bound_mm(&pins, 0.1, &rim);
        assert!((ratio - 1.0).abs() < 3e-3, "{found:?}");
    }

    #[test]
    fn a_step_above_that_of_the_process_breaks_the_promise() {
        let breaks = |limit_mm: f64, evidence: &Evidence| {
            let mut evidence = evidence.clone();
            evidence.promise.printer.seam_step_mm = Some(limit_mm);
            failures(&evidence).contains(&"joint step".to_owned())
        };
        let mut evidence = kit_with_two_pins();
        assert!(!breaks(0.15, &evidence) && breaks(0.13, &evidence));
        // One pin leaves the turn free.
        evidence.promise.parts[0].pins.pop();
        assert!(breaks(9.0, &evidence));
        evidence.promise.joints[0].held_by = Some(HeldBy::Eye);
        assert!(!breaks(0.0, &evidence));
    }
}
