//! The steps of gluing: two bodies of parts at a time, in an order that works.

use crate::sheet::network::JunctureJointRow;
use crate::sheet::{Checklist, JointRow};

/// Number of pins that align a joint fully, if it has no note.
const ONE_WAY_PINS: usize = 2;

/// A joint that is glued.
pub(super) trait Glued {
    /// Returns the parts that meet.
    fn parts(&self) -> &[String; 2];
    /// Returns the cut in which they meet.
    fn cut(&self) -> &str;
}

impl Glued for JointRow {
    fn parts(&self) -> &[String; 2] {
        &self.parts
    }

    fn cut(&self) -> &str {
        &self.cut
    }
}

impl Glued for JunctureJointRow {
    fn parts(&self) -> &[String; 2] {
        &self.parts
    }

    fn cut(&self) -> &str {
        &self.cut
    }
}

/// A step of gluing: all joints between two bodies of parts, which close in one movement.
pub(super) struct Closing<'a, J = JointRow> {
    /// The joints that close.
    pub(super) joints: Vec<&'a J>,
    /// Ids of the parts of each body.
    pub(super) sides: [Vec<&'a str>; 2],
}

/// Returns the steps of gluing the parts of a kit.
pub(super) fn closings<'a>(sheet: &'a Checklist) -> Vec<Closing<'a>> {
    let parts = sheet.parts.iter().map(|part| part.id.as_str());
    closings_of(parts, sheet.joints.iter().collect())
}

/// Returns the steps of gluing in an order that works, cut by cut. What is closed first lies wholly
/// on one side of every later cut, so two bodies meet along one plane.
pub(super) fn closings_of<'a, J: Glued>(
    parts: impl Iterator<Item = &'a str>,
    joints: Vec<&'a J>,
) -> Vec<Closing<'a, J>> {
    let mut bodies: Vec<Vec<&str>> = parts.map(|part| vec![part]).collect();
    let mut open = sort_by_cut(joints);
    let mut closings = Vec::new();
    while let Some(first) = open.first() {
        let sides = first.parts().each_ref().map(|part| body_of(&bodies, part));
        let closes = |joint: &&J| {
            joint
                .parts()
                .iter()
                .all(|part| sides.iter().any(|side| side.contains(&part.as_str())))
        };
        let (joints, rest) = open.into_iter().partition(closes);
        bodies.retain(|body| !sides.contains(body));
        bodies.push(sides.concat());
        closings.push(Closing { joints, sides });
        open = rest;
    }
    closings
}

/// Sorts the joints by cut, with the cuts in the order of their first joints.
fn sort_by_cut<J: Glued>(joints: Vec<&J>) -> Vec<&J> {
    let first = |cut: &str| joints.iter().position(|joint| joint.cut() == cut);
    let mut sorted = joints.clone();
    sorted.sort_by_key(|joint| first(joint.cut()));
    sorted
}

/// Returns the body that holds a part; the part alone if none does.
fn body_of<'a>(bodies: &[Vec<&'a str>], part: &'a str) -> Vec<&'a str> {
    bodies
        .iter()
        .find(|body| body.contains(&part))
        .cloned()
        .unwrap_or_else(|| vec![part])
}

impl<J: Glued> Closing<'_, J> {
    /// Names the parts of the two bodies that meet: `P01 + P03`.
    pub(super) fn bodies(&self) -> [String; 2] {
        let meets = |part: &&str| {
            let mut parts = self.joints.iter().flat_map(|joint| joint.parts());
            parts.any(|met| met == part)
        };
        self.sides.each_ref().map(|side| {
            let met: Vec<&str> = side.iter().copied().filter(meets).collect();
            met.join(" + ")
        })
    }
}

impl Closing<'_> {
    /// Names the joints: `J6 and J7 together`.
    pub(super) fn name(&self) -> String {
        let ids: Vec<&str> = self.joints.iter().map(|joint| joint.id.as_str()).collect();
        match ids.split_last() {
            Some((last, [])) => (*last).to_owned(),
            Some((last, others)) => format!("{} and {last} together", others.join(", ")),
            None => String::new(),
        }
    }

    /// Words how the bodies come together, the lighter onto the heavier: `push P03 onto P01`.
    pub(super) fn movement(&self, sheet: &Checklist) -> String {
        let [one, other] = self.bodies();
        let mass_g = |side: &[&str]| -> f64 {
            let parts = sheet.parts.iter();
            let parts = parts.filter(|part| side.contains(&part.id.as_str()));
            parts.map(|part| part.mass_g).sum()
        };
        let [one_g, other_g] = self.sides.each_ref().map(|side| mass_g(side));
        if one_g <= other_g {
            format!("push {one} onto {other}")
        } else {
            format!("push {other} onto {one}")
        }
    }

    /// Returns the joint whose pins align another that has too few, since both close in one
    /// movement. `None` if the joint needs no guide or no other joint can be one.
    pub(super) fn guide_of(&self, joint: &JointRow) -> Option<&JointRow> {
        let is_sound = |row: &JointRow| row.pins >= ONE_WAY_PINS && row.note.is_none();
        let others = self
            .joints
            .iter()
            .copied()
            .filter(|other| other.id != joint.id);
        others
            .into_iter()
            .find(|other| is_sound(other))
            .filter(|_| !is_sound(joint))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::testing::sample;

    /// Returns a sheet with this many parts and these joints: two parts and the cut.
    pub(in crate::page) fn sheet(count: usize, joints: &[(usize, usize, &str)]) -> Checklist {
        let mut sheet = sample().0;
        let id = |index: usize| format!("P{:02}", index);
        let (part, joint) = (sheet.parts[0].clone(), sheet.joints[0].clone());
        sheet.parts = (1..=count)
            .map(|index| crate::sheet::PartRow {
                id: id(index),
                ..part.clone()
            })
            .collect();
        let row = |(index, (a, b, cut)): (usize, &(usize, usize, &str))| JointRow {
            id: format!("J{}", index + 1),
            parts: [id(*a), id(*b)],
            cut: (*cut).to_owned(),
            ..joint.clone()
        };
        sheet.joints = joints.iter().enumerate().map(row).collect();
        sheet
    }

    fn names(sheet: &Checklist) -> Vec<String> {
        closings(sheet).iter().map(Closing::name).collect()
    }

    #[test]
    fn quarters_are_glued_to_halves_and_the_halves_in_one_movement() {
        let crossed = sheet(4, &[(1, 2, "C1"), (1, 3, "C2"), (3, 4, "C1"), (2, 4, "C2")]);
        assert_eq!(names(&crossed), ["J1", "J3", "J2 and J4 together"]);
        assert_eq!(closings(&crossed)[2].bodies(), ["P01 + P02", "P03 + P04"]);
    }

    #[test]
    fn eight_octants_close_in_seven_movements_each_along_one_cut() {
        let bit = |index: usize, axis: usize| (index >> axis) & 1;
        let pairs =
            (0..8usize).flat_map(|a| (0..3usize).map(move |axis| (a, a | (1 << axis), axis)));
        let joints: Vec<(usize, usize, &str)> = pairs
            .filter(|&(a, _, axis)| bit(a, axis) == 0)
            .map(|(a, b, axis)| (a + 1, b + 1, ["C1", "C2", "C3"][axis]))
            .collect();
        let octants = sheet(8, &joints);
        let made = closings(&octants);
        assert_eq!(made.len(), 7);
        assert_eq!(
            made.iter()
                .map(|closing| closing.joints.len())
                .sum::<usize>(),
            12
        );
        assert!(made.iter().all(|closing| {
            closing
                .joints
                .iter()
                .all(|joint| joint.cut == closing.joints[0].cut)
        }));
    }

    #[test]
    fn the_side_to_which_a_cut_is_limited_is_closed_first() {
        let kept = sheet(3, &[(3, 2, "C2"), (2, 1, "C1"), (3, 1, "C1")]);
        assert_eq!(names(&kept), ["J1", "J2 and J3 together"]);
        assert_eq!(closings(&kept)[1].bodies(), ["P03 + P02", "P01"]);
    }

    #[test]
    fn a_ring_of_parts_on_one_plane_closes_every_joint_once() {
        let fan = sheet(5, &[(2, 4, "C1"), (3, 1, "C1"), (3, 4, "C1"), (5, 4, "C1")]);
        assert_eq!(names(&fan), ["J1", "J2", "J3", "J4"]);
    }
}
