//! `motion.glb`: the parts and their motion for other programs.
//!
//! Every shell is a node on the one before it, so a joint moves one node. A move takes a second.
//! The format goes straight between its keys, so a slide along a helix gets as many as it needs.

use std::f64::consts::PI;

use super::moving::{Moving, MovingBody};
use crate::draw::part_color;
use crate::geom::Frame;
use crate::io::glb::{Animation, MovingScene, Painted, SceneNode, Track};
use crate::page::FilmPlace;
use crate::telescope::motion::{Key, between};
use crate::telescope::nest::JointState;
use crate::verify::{MOTION_SCENE_FILE, OPENING};
use crate::wing::Unwritable;

/// The most by which a chord between two keys leaves the path of a slide, mm.
const CHORD_MM: f64 = 0.002;
/// The most that turns between two keys, rad.
const TURN_RAD: f64 = PI / 16.0;
/// The most keys of a move.
const MOST_KEYS: usize = 1_000;

/// Returns the file of a motion.
pub fn motion_scene(name: &str, moving: &Moving) -> Result<Vec<u8>, Unwritable> {
    let tree = Tree::of(moving);
    let scene = MovingScene {
        name: name.to_owned(),
        up: moving.up,
        animations: tree.animations(),
        nodes: tree.nodes,
    };
    let bytes = scene.encode();
    bytes.map_err(|error| Unwritable::new(MOTION_SCENE_FILE, &error))
}

/// The nodes, and which of them is moved by each joint of each limb.
struct Tree<'a> {
    moving: &'a Moving,
    nodes: Vec<SceneNode<'a>>,
    joints: Vec<Vec<usize>>,
}

/// A joint of a limb, both from 0.
#[derive(Clone, Copy)]
struct Joint {
    limb: usize,
    joint: usize,
}

impl<'a> Tree<'a> {
    fn of(moving: &'a Moving) -> Self {
        let mut tree = Self {
            moving,
            nodes: Vec::new(),
            joints: Vec::new(),
        };
        let mut junctures = vec![None; moving.network.junctures];
        junctures[0] = tree.juncture(0, None, Frame::identity());
        for limb in 0..moving.network.limbs.len() {
            let [from, to] = [
                moving.network.limbs[limb].from,
                moving.network.limbs[limb].to,
            ];
            let last = tree.limb(limb, junctures[from]);
            let telescope = &moving.network.limbs[limb].telescope;
            let out = telescope.frames(&telescope.open());
            let back = out.last().map_or_else(Frame::identity, Frame::inverse);
            junctures[to] = tree.juncture(to, last, back);
        }
        tree
    }

    /// Adds the node of a juncture, if it has a body. Its other parts are fixed to the first.
    fn juncture(&mut self, index: usize, parent: Option<usize>, place: Frame) -> Option<usize> {
        let mut bodies = self.body(FilmPlace::Juncture(index));
        let own = self.add(bodies.next()?, parent, place);
        for part in bodies {
            self.add(part, Some(own), Frame::identity());
        }
        Some(own)
    }

    /// Adds the nodes of a limb with all shells in, and returns that of its last shell.
    fn limb(&mut self, limb: usize, base: Option<usize>) -> Option<usize> {
        let telescope = &self.moving.network.limbs[limb].telescope;
        let closed = telescope.closed();
        let mut carrier = base;
        let mut joints = Vec::new();
        for shell in 0..telescope.shells.len() {
            let place = match shell.checked_sub(1) {
                Some(joint) => telescope.step(joint, &closed[joint]),
                None => telescope.start,
            };
            let mut bodies = self.body(FilmPlace::Shell { limb, shell });
            let (Some(tube), caps) = (bodies.next(), bodies.collect::<Vec<_>>()) else {
                continue;
            };
            let own = self.add(tube, carrier, place);
            for cap in caps {
                self.add(cap, Some(own), Frame::identity());
            }
            if shell > 0 {
                joints.push(own);
            }
            carrier = Some(own);
        }
        self.joints.push(joints);
        carrier
    }

    fn body(&self, place: FilmPlace) -> impl Iterator<Item = &'a MovingBody> + use<'a> {
        let bodies = self.moving.bodies.iter();
        bodies.filter(move |body| body.place == place)
    }

    fn add(&mut self, body: &'a MovingBody, parent: Option<usize>, place: Frame) -> usize {
        self.nodes.push(SceneNode {
            name: body.id.clone(),
            parent,
            place,
            body: Some(Painted {
                mesh: &body.mesh,
                color: part_color(body.color),
            }),
        });
        self.nodes.len() - 1
    }

    /// Returns the opening of all joints, and of each joint alone.
    fn animations(&self) -> Vec<Animation> {
        let limbs = self.joints.iter().enumerate();
        let joints: Vec<Joint> = limbs
            .flat_map(|(limb, joints)| (0..joints.len()).map(move |joint| Joint { limb, joint }))
            .collect();
        let whole = joints.iter().filter_map(|joint| self.track(*joint, false));
        let whole = Animation {
            name: OPENING.to_owned(),
            tracks: whole.collect(),
        };
        let alone = joints.iter().filter_map(|joint| {
            Some(Animation {
                name: self.moving.motions[joint.limb].joints[joint.joint]
                    .id
                    .clone(),
                tracks: vec![self.track(*joint, true)?],
            })
        });
        // A single shell has no motion, and the format no animation without one.
        let whole = Some(whole).filter(|whole| !whole.tracks.is_empty());
        whole.into_iter().chain(alone).collect()
    }

    /// Returns the motion of a joint's inner shell; `None` if it has none. Alone, it begins at
    /// once, and does not wait for others.
    fn track(&self, joint: Joint, is_alone: bool) -> Option<Track> {
        let telescope = &self.moving.network.limbs[joint.limb].telescope;
        let state = |keys: &[Key]| keys[joint.limb][joint.joint];
        let moves = self.moving.keys.windows(2).enumerate();
        let moves = moves.map(|(start, pair)| (start, [state(&pair[0]), state(&pair[1])]));
        let mut track = Track {
            node: self.joints[joint.limb][joint.joint],
            times_s: Vec::new(),
            places: Vec::new(),
        };
        let mut moved = 0;
        for (start, [from, to]) in moves.filter(|(_, [from, to])| from != to) {
            let start_s = if is_alone { moved } else { start } as f64;
            moved += 1;
            let count = self.keys_of(joint, [&from, &to]);
            for key in 0..=count {
                let share = key as f64 / count as f64;
                let time_s = start_s + share;
                if track.times_s.last().is_some_and(|last| *last >= time_s) {
                    continue;
                }
                let at = between(&[from], &[to], share);
                track.times_s.push(time_s);
                track.places.push(telescope.step(joint.joint, &at[0]));
            }
        }
        (moved > 0).then_some(track)
    }

    /// Returns the number of keys after the first that a move needs.
    fn keys_of(&self, joint: Joint, [from, to]: [&JointState; 2]) -> usize {
        let shells = &self.moving.network.limbs[joint.limb].telescope.shells;
        let helix = &shells[joint.joint + 1].helix;
        let slide_mm = (to.slide_mm - from.slide_mm).abs();
        let turn_rad =
            (to.turn_rad - from.turn_rad).abs() + slide_mm * helix.curvature.hypot(helix.torsion);
        let by_chord = slide_mm * (helix.curvature / (8.0 * CHORD_MM)).sqrt();
        let needed = by_chord.max(turn_rad / TURN_RAD).ceil() as usize;
        needed.clamp(1, MOST_KEYS)
    }
}
