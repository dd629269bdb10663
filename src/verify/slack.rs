//! Slack: what the play of a joint does to the balance of a rotor.

use super::rotor::Unbalance;
use super::{JointFacts, PartEvidence, Promise, PromisedJoint, Setting};
use crate::geom::{Plane, Point, Vector};
use crate::mass::Moments;

/// Number of directions in which a body shifts: its worst is right to 0.5 %.
const WAYS: usize = 32;

/// A rotor whose joints have play.
pub(super) struct Slack<'a> {
    pub(super) promise: &'a Promise,
    pub(super) parts: &'a [PartEvidence],
    /// The moments of all that is put together, times the print's density, model frame.
    pub(super) whole: &'a Moments,
    pub(super) setting: &'a Setting,
}

impl Slack<'_> {
    /// States in each joint of a rotor what its play does to the balance; nothing for other goals.
    ///
    /// The lighter of the two bodies that the joint parts shifts as far as the play lets it,
    /// without a turn. If the shaft is in the lighter one, more is left. Ballast stays where it is.
    /// A joint in a ring of parts is held by the others, and states nothing. Several joints between
    /// the same parts shift together: as far as the tightest of them, which alone states it.
    pub(super) fn state(&self, facts: &mut [JointFacts]) {
        if self.setting.aim.rotor.is_none() {
            return;
        }
        let joints = &self.promise.joints;
        let shift_mm = |facts: &JointFacts| facts.play.map(|play| play.shift_mm);
        let shifts_mm: Vec<Option<f64>> = facts.iter().map(shift_mm).collect();
        for (index, facts) in facts.iter_mut().enumerate() {
            let is_tighter = |other: usize| {
                let is_beside = is_between(&joints[other], &joints[index]);
                let order = |at: usize| (shifts_mm[at].unwrap_or(f64::INFINITY), at);
                is_beside && order(other) < order(index)
            };
            if let (Some(shift_mm), false) = (shifts_mm[index], (0..joints.len()).any(is_tighter)) {
                facts.unbalance_g_mm = self.worst_g_mm(&joints[index], shift_mm);
            }
        }
    }

    /// Returns the larger unbalance in the end planes for the worst shift in a joint, g·mm. `None`
    /// unless the goal is a rotor.
    fn worst_g_mm(&self, joint: &PromisedJoint, shift_mm: f64) -> Option<f64> {
        let moved = lighter_side(joint, self.promise, self.parts)?;
        let normal = normal_of(joint, self.promise)?;
        let left = shifts(&normal, shift_mm).filter_map(|shift| self.left_g_mm(&moved, &shift));
        left.reduce(f64::max)
    }

    /// Returns the larger unbalance in the end planes once a body has shifted, g·mm.
    fn left_g_mm(&self, moved: &Moments, shift: &Vector) -> Option<f64> {
        let (order, ends_mm) = self.setting.aim.rotor.zip(self.setting.ends_mm)?;
        let shifted = *self.whole + moved.translated(shift) - *moved;
        let local = shifted.in_frame(&self.setting.aim.frame());
        let density_g_mm3 = self.setting.density_g_mm3();
        Some(Unbalance::new(&local, density_g_mm3, ends_mm, &order).end_plane_g_mm)
    }
}

/// Returns shifts of this length all around in the plane of a joint, mm.
fn shifts(normal: &Vector, length_mm: f64) -> impl Iterator<Item = Vector> {
    let (u, v) = Plane::through(&Point::origin(), normal).basis();
    (0..WAYS).map(move |way| {
        let (sin, cos) = (std::f64::consts::TAU * way as f64 / WAYS as f64).sin_cos();
        (u * cos + v * sin) * length_mm
    })
}

/// Returns the direction in which a joint closes: that of its pins or of its jig.
fn normal_of(joint: &PromisedJoint, promise: &Promise) -> Option<Vector> {
    let sockets = promise.parts.iter().flat_map(|part| &part.sockets);
    let mut sockets = sockets.filter(|socket| socket.joint == joint.id);
    let jig = promise.jigs.iter().find(|jig| jig.joint == joint.id);
    let socket = sockets.next().map(|socket| socket.axis);
    let normal = Vector::from(socket.or(jig.map(|jig| jig.normal))?);
    normal.try_normalize(0.0)
}

/// Returns the moments of the lighter of the bodies that a joint parts; `None` if other joints
/// connect them.
fn lighter_side(
    joint: &PromisedJoint,
    promise: &Promise,
    parts: &[PartEvidence],
) -> Option<Moments> {
    let [below, above] = joint.parts.each_ref().map(|id| reach(id, joint, promise));
    if below.iter().any(|id| above.contains(id)) {
        return None;
    }
    let sides = [below, above].map(|side| {
        let own = parts.iter().filter(|part| side.contains(&part.id.as_str()));
        own.map(PartEvidence::moments)
            .fold(Moments::default(), |sum, part| sum + part)
    });
    sides
        .into_iter()
        .min_by(|a, b| a.volume().total_cmp(&b.volume()))
}

/// Returns whether a joint is between the same two parts as another.
fn is_between(joint: &PromisedJoint, other: &PromisedJoint) -> bool {
    other.parts.iter().all(|id| joint.parts.contains(id))
}

/// Returns the parts connected with a part by joints other than those between the same two parts as
/// `left_out`.
fn reach<'a>(from: &'a str, left_out: &PromisedJoint, promise: &'a Promise) -> Vec<&'a str> {
    let mut reached = vec![from];
    let mut next = 0;
    while let Some(&part) = reached.get(next) {
        next += 1;
        let joints = promise.joints.iter();
        let others = joints.filter(|joint| !is_between(joint, left_out));
        let at = others.filter(|joint| joint.parts.iter().any(|id| id == part));
        for id in at.flat_map(|joint| &joint.parts) {
            if !reached.contains(&id.as_str()) {
                reached.push(id);
            }
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::super::judge_tests::{judge, kit_with_two_pins};
    use super::super::{Aim, Evidence, RotorOrder};
    use crate::goal::GoalKind;

    /// Returns a kit with two pins, which leave 0.1 mm of room, as a rotor about z.
    fn rotor() -> Evidence {
        let mut evidence = kit_with_two_pins();
        evidence.promise.goal = Aim {
            rotor: Some(RotorOrder {
                speed_rpm: 3000.0,
                grade_mm_s: 6.3,
            }),
            ..Aim::new(GoalKind::Balance, [0.0; 3], [0.0, 0.0, 1.0])
        };
        evidence
    }

    #[test]
    fn half_a_box_that_shifts_by_its_play_unbalances_the_end_next_to_it() {
        let found = judge(&rotor()).joints.remove(0);
        // Half of the box, by hand: a block of 60 × 40 × 6 mm less one of 54 × 34 × 3 mm, at
        // 1.2 g/cm³.
        let (block, hollow) = (60.0 * 40.0 * 6.0, 54.0 * 34.0 * 3.0);
        let volume_mm3 = block - hollow;
        let height_mm = (block * 13.0 - hollow * 14.5) / volume_mm3;
        let mass_g = volume_mm3 * 1.2e-3;
        // The planes lie at 10 and 22 mm: by the lever of its centre, most is left at the nearer.
        let left_g_mm = mass_g * 0.1 * (22.0 - height_mm) / 12.0;
        let ratio = found.unbalance_g_mm.unwrap() / left_g_mm;
        assert!((ratio - 1.0).abs() < 5e-3, "{ratio}, {found:?}");
    }

    #[test]
    fn only_a_rotor_states_it_and_no_joint_of_a_ring() {
        let mut evidence = rotor();
        evidence.promise.goal = kit_with_two_pins().promise.goal;
        assert_eq!(judge(&evidence).joints[0].unbalance_g_mm, None);
        // A third part that both halves are glued to.
        let mut evidence = rotor();
        for (id, part) in [("J2", "P01"), ("J3", "P02")] {
            let mut joint = evidence.promise.joints[0].clone();
            joint.id = id.to_owned();
            joint.parts = [part.to_owned(), "P03".to_owned()];
            evidence.promise.joints.push(joint);
        }
        assert_eq!(judge(&evidence).joints[0].unbalance_g_mm, None);
    }
}
