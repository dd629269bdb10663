//! The joints between the parts of a juncture: as many pins and sockets as they state.

use super::juncture::{JunctureJointPromise, JuncturePartPromise, JuncturePromise};

/// The least number of pins that let two parts together in one way only.
const ONE_WAY_PINS: usize = 2;

/// Returns what is wrong with the joints of a juncture in several parts, in words. `joints` are
/// those of all junctures.
pub(super) fn joint_faults(own: &JuncturePromise, joints: &[JunctureJointPromise]) -> Vec<String> {
    let joints = joints.iter().filter(|joint| joint.juncture == own.id);
    let joints: Vec<&JunctureJointPromise> = joints.collect();
    let mut faults: Vec<String> = joints
        .iter()
        .filter_map(|joint| fault(own, joint))
        .collect();
    let stated: usize = joints.iter().map(|joint| joint.pins).sum();
    let pins: usize = own.parts.iter().map(|part| part.pins.len()).sum();
    let sockets: usize = own.parts.iter().map(|part| part.sockets.len()).sum();
    if [pins, sockets] != [stated, stated] {
        faults.push(format!(
            "the joints of {} have {stated} pins, its parts have {pins} and {sockets} sockets",
            own.id
        ));
    }
    if !are_joined(own, &joints) {
        faults.push(format!(
            "the joints of {} do not join all its parts",
            own.id
        ));
    }
    faults
}

fn fault(own: &JuncturePromise, joint: &JunctureJointPromise) -> Option<String> {
    let [below, above] = &joint.parts;
    let part = |id: &String| own.parts.iter().find(|part| part.id == *id);
    let Some((a, b)) = part(below).zip(part(above)) else {
        return Some(format!("{} has no parts {below} and {above}", own.id));
    };
    let found = count_pins(a, b) + count_pins(b, a);
    if found != joint.pins {
        return Some(format!(
            "{below} and {above} have {found} pins with sockets, {} are stated",
            joint.pins
        ));
    }
    let is_loose = joint.is_aligned && found < ONE_WAY_PINS;
    is_loose.then(|| format!("{below} and {above} do not fit one way only: pins {found}"))
}

/// Counts the pins of a part that have a socket in another.
fn count_pins(carrier: &JuncturePartPromise, receiver: &JuncturePartPromise) -> usize {
    let has_socket = |id: &String| receiver.sockets.iter().any(|socket| socket.id == *id);
    let pins = carrier.pins.iter();
    pins.filter(|pin| has_socket(&pin.id)).count()
}

/// Returns true if one can go from the first part to every other by joints.
fn are_joined(own: &JuncturePromise, joints: &[&JunctureJointPromise]) -> bool {
    let mut reached: Vec<&String> = own.parts.iter().map(|part| &part.id).take(1).collect();
    let mut looked = 0;
    while let Some(part) = reached.get(looked).copied() {
        let met = joints.iter().filter(|joint| joint.parts.contains(part));
        for id in met.flat_map(|joint| &joint.parts) {
            if !reached.contains(&id) {
                reached.push(id);
            }
        }
        looked += 1;
    }
    own.parts.iter().all(|part| reached.contains(&&part.id))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{Peg, Pose};

    fn peg(id: &str) -> Peg {
        Peg {
            id: id.to_owned(),
            joint: String::new(),
            center_mm: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            diameter_mm: 3.0,
            length_mm: 5.0,
            volume_mm3: 30.0,
        }
    }

    /// Returns a juncture of two parts with pins and sockets of these names, and its joint.
    fn juncture(pins: &[&str], sockets: &[&str]) -> (JuncturePromise, JunctureJointPromise) {
        let part = |id: &str| JuncturePartPromise {
            id: id.to_owned(),
            file: String::new(),
            sha256: String::new(),
            print_from_model: Pose {
                rows: [[0.0; 4]; 4],
            },
            pins: Vec::new(),
            sockets: Vec::new(),
            marks: Vec::new(),
        };
        let pegs = |ids: &[&str]| ids.iter().map(|id| peg(id)).collect();
        let below = JuncturePartPromise {
            pins: pegs(pins),
            ..part("N01-P01")
        };
        let above = JuncturePartPromise {
            sockets: pegs(sockets),
            ..part("N01-P02")
        };
        let own = JuncturePromise {
            id: "N01".to_owned(),
            parts: vec![below, above],
            divided: None,
        };
        let joint = JunctureJointPromise {
            juncture: "N01".to_owned(),
            parts: ["N01-P01", "N01-P02"].map(str::to_owned),
            pins: 2,
            is_aligned: true,
        };
        (own, joint)
    }

    fn count_faults(pins: &[&str], sockets: &[&str]) -> usize {
        let (own, joint) = juncture(pins, sockets);
        joint_faults(&own, &[joint]).len()
    }

    #[test]
    fn a_joint_has_as_many_pins_and_sockets_as_it_states() {
        assert_eq!(count_faults(&["D1", "D2"], &["D1", "D2"]), 0);
        assert_ne!(count_faults(&[], &[]), 0);
        assert_ne!(count_faults(&["D1"], &["D1", "D2"]), 0);
        assert_ne!(count_faults(&["D1", "D2"], &["D1"]), 0);
        assert_ne!(count_faults(&["D1", "D2"], &["D1", "D3"]), 0);
    }

    #[test]
    fn one_pin_does_not_align_and_a_part_without_a_joint_is_told() {
        let (own, joint) = juncture(&["D1"], &["D1"]);
        let one = JunctureJointPromise { pins: 1, ..joint };
        assert_eq!(joint_faults(&own, std::slice::from_ref(&one)).len(), 1);
        let loose = JunctureJointPromise {
            is_aligned: false,
            ..one
        };
        assert!(joint_faults(&own, &[loose]).is_empty());
        let (bare, _) = juncture(&[], &[]);
        assert_eq!(
            joint_faults(&bare, &[]),
            ["the joints of N01 do not join all its parts"]
        );
    }
}
