//! `motion.glb`: whether it holds the parts as they are judged, and moves them as the keys do.

use super::checks::none;
use super::course::{BETWEEN, mixed};
use super::evidence::TelescopeEvidence;
use super::juncture::Piece;
use super::motion::TelescopeMotion;
use super::network::NetworkEvidence;
use super::standing::upright;
use crate::geom::{Frame, Point, Vector};
use crate::io::glb::{GlbError, ReadAnimation, ReadScene, decode_glb};
use crate::mesh::TriMesh;
use crate::verify::kind_packages::is_same;
use crate::verify::kit_folder::KitFolder;
use crate::verify::{Check, CheckKind};

/// The moving parts in a kit, for other programs.
pub const MOTION_SCENE_FILE: &str = "motion.glb";
/// The name of the animation of all joints. Each of its moves takes a second.
pub const OPENING: &str = "open";
/// By how much a point of a part may be off, mm: single precision, and chords of a path.
const PLACE_LIMIT_MM: f64 = 0.02;
/// The scale of a scene in mm.
const SCALE: f64 = 0.001;
/// By how much that may be off: single precision.
const SCALE_LIMIT: f64 = 1e-9;
/// By how much the direction up, of length 1, may be off.
const UP_LIMIT: f64 = 1e-6;

/// Slide (mm) and turn (rad) of the joints of every limb. A single telescope is one limb.
type State = Vec<Vec<[f64; 2]>>;

/// A body in its own frame.
struct Wanted<'a> {
    name: &'a str,
    mesh: &'a TriMesh,
}

/// A motion of a scene: its states, a second apart.
struct Play {
    name: String,
    states: Vec<[State; 2]>,
}

/// Returns the frames of all bodies at a state.
type Places<'a> = dyn Fn(&State) -> Vec<Frame> + 'a;

/// The bodies, the states between moves, and where the bodies are in a state.
struct Script<'a> {
    bodies: Vec<Wanted<'a>>,
    /// The ids of the joints of every limb.
    joints: Vec<Vec<&'a str>>,
    keys: Vec<State>,
    up: Vector,
    places: Box<Places<'a>>,
}

/// Checks the moving scene of a telescope.
pub fn scene_check(folder: &KitFolder, evidence: &TelescopeEvidence) -> Check {
    let (motion, parts) = (&evidence.motion, &evidence.promise.parts);
    let bodies = parts.iter().zip(&evidence.parts);
    let keys = motion.keys.iter();
    let script = Script {
        bodies: bodies
            .map(|(part, mesh)| Wanted {
                name: &part.id,
                mesh,
            })
            .collect(),
        joints: vec![joint_ids(motion)],
        keys: keys.map(|key| vec![key.states.clone()]).collect(),
        up: upright(motion).axes.column(2).into(),
        places: Box::new(|state| {
            let frames = motion.frames(&state[0]);
            parts.iter().map(|part| frames[part.shell - 1]).collect()
        }),
    };
    script.check(folder)
}

fn joint_ids(motion: &TelescopeMotion) -> Vec<&str> {
    let joints = motion.joints.iter();
    joints.map(|joint| joint.id.as_str()).collect()
}

/// Checks the moving scene of several telescopes.
pub fn network_scene_check(folder: &KitFolder, evidence: &NetworkEvidence) -> Check {
    let motion = &evidence.motion;
    let limbs = evidence.limbs.iter().flat_map(|limb| {
        let parts = limb.promise.parts.iter().zip(&limb.parts);
        parts.map(|(part, mesh)| Wanted {
            name: &part.id,
            mesh,
        })
    });
    let pieces: Vec<Piece> = evidence.pieces().collect();
    let junctures = pieces.iter().map(|piece| Wanted {
        name: &piece.promise.id,
        mesh: &piece.mesh,
    });
    let script = Script {
        bodies: limbs.chain(junctures).collect(),
        joints: motion.limbs.iter().map(joint_ids).collect(),
        keys: motion.keys.iter().map(|key| key.states.clone()).collect(),
        up: Vector::from(motion.up),
        places: Box::new(|state| {
            let places = evidence.places(state);
            let limbs = evidence.limbs.iter().zip(&places.shells);
            let shells = limbs.flat_map(|(limb, frames)| {
                let parts = limb.promise.parts.iter();
                parts.map(|part| frames[part.shell - 1])
            });
            let junctures = pieces.iter().map(|piece| places.junctures[piece.juncture]);
            shells.chain(junctures).collect()
        }),
    };
    script.check(folder)
}

impl Script<'_> {
    fn check(&self, folder: &KitFolder) -> Check {
        let bytes = std::fs::read(folder.path.join(MOTION_SCENE_FILE));
        let faults = match bytes {
            Ok(bytes) => self.faults(decode_glb(&bytes)),
            Err(_) => vec![format!("{MOTION_SCENE_FILE} is missing")],
        };
        none(
            CheckKind::MotionScene,
            "motion.glb holds the parts as they are judged, and moves them as the keys do",
            &faults,
        )
    }

    fn faults(&self, scene: Result<ReadScene, GlbError>) -> Vec<String> {
        let scene = match scene {
            Ok(scene) => scene,
            Err(error) => return vec![format!("{MOTION_SCENE_FILE}: {error}")],
        };
        let mut faults = self.root_faults(&scene);
        let named = self.bodies.iter().map(|body| {
            let mut own = scene.nodes.iter().enumerate();
            let own = own.find(|(_, node)| node.name == body.name);
            own.filter(|(_, node)| node.mesh.as_ref().is_some_and(|m| is_same(m, body.mesh)))
                .map(|(index, _)| index)
                .ok_or_else(|| format!("{} is not in {MOTION_SCENE_FILE} as it is", body.name))
        });
        let nodes: Vec<Result<usize, String>> = named.collect();
        faults.extend(nodes.iter().filter_map(|node| node.as_ref().err().cloned()));
        let painted = scene
            .nodes
            .iter()
            .filter(|node| node.mesh.is_some())
            .count();
        if painted != self.bodies.len() {
            let count = self.bodies.len();
            faults.push(format!(
                "{MOTION_SCENE_FILE} holds {painted} bodies in place of {count}"
            ));
        }
        let plays = self.plays();
        let mut names: Vec<&str> = scene.animations.iter().map(|own| &*own.name).collect();
        let mut wanted: Vec<&str> = plays.iter().map(|play| &*play.name).collect();
        names.sort_unstable();
        wanted.sort_unstable();
        if names != wanted {
            let [names, wanted] = [names, wanted].map(|names| names.join(", "));
            faults.push(format!(
                "{MOTION_SCENE_FILE} has the animations {names} in place of {wanted}"
            ));
        }
        for play in &plays {
            let mut own = scene.animations.iter();
            if let Some(own) = own.find(|animation| animation.name == play.name) {
                faults.extend(self.misplaced(play, &scene, own, &nodes));
            }
        }
        faults
    }

    /// Returns whether the root stands for metres, and for the direction up: y in the format.
    fn root_faults(&self, scene: &ReadScene) -> Vec<String> {
        let is_metric = (scene.scale - SCALE).abs() <= SCALE_LIMIT;
        let is_upright = (scene.root.axes * self.up - Vector::y()).norm() <= UP_LIMIT;
        let is_still = scene.root.origin == Point::origin();
        let promises = [
            (is_metric, "is not in metres"),
            (is_upright, "does not stand upright"),
            (is_still, "does not stand where the model does"),
        ];
        let broken = promises.into_iter().filter(|(is_held, _)| !is_held);
        broken
            .map(|(_, why)| format!("{MOTION_SCENE_FILE} {why}"))
            .collect()
    }

    /// Returns the motions that the scene must have: of all joints by the keys, and of each joint
    /// that moves. That is its own moves, one after the other, with all others in.
    fn plays(&self) -> Vec<Play> {
        let moves: Vec<[&State; 2]> = self
            .keys
            .windows(2)
            .map(|pair| [&pair[0], &pair[1]])
            .collect();
        let opening = Play {
            name: OPENING.to_owned(),
            states: moves.iter().map(|pair| pair.map(Clone::clone)).collect(),
        };
        let limbs = self.joints.iter().enumerate();
        let joints = limbs.flat_map(|(limb, ids)| {
            let own = ids.iter().enumerate();
            own.map(move |(joint, id)| (limb, joint, id))
        });
        let alone = joints.map(|(limb, joint, id)| {
            let own = moves
                .iter()
                .map(|pair| pair.map(|state| state[limb][joint]));
            let state = |at: [f64; 2]| {
                let mut state = self.keys[0].clone();
                state[limb][joint] = at;
                state
            };
            Play {
                name: (*id).to_owned(),
                states: own
                    .filter(|[a, b]| a != b)
                    .map(|pair| pair.map(state))
                    .collect(),
            }
        });
        let all = [opening].into_iter().chain(alone);
        all.filter(|play| !play.states.is_empty()).collect()
    }

    /// Returns for each body that is off in an animation the first time at which it is.
    fn misplaced(
        &self,
        play: &Play,
        scene: &ReadScene,
        animation: &ReadAnimation,
        nodes: &[Result<usize, String>],
    ) -> Vec<String> {
        let mut is_told = vec![false; self.bodies.len()];
        let mut faults = Vec::new();
        for (start, [from, to]) in play.states.iter().enumerate() {
            for share in [0.0].into_iter().chain(BETWEEN).chain([1.0]) {
                let time_s = start as f64 + share;
                let found = scene.places(animation, time_s);
                let limbs = from.iter().zip(to);
                let state: State = limbs.map(|(a, b)| mixed(a, b, share)).collect();
                let wanted = (self.places)(&state);
                for (index, (node, wanted)) in nodes.iter().zip(&wanted).enumerate() {
                    let (Ok(node), false) = (node, is_told[index]) else {
                        continue;
                    };
                    let off_mm = off_mm(&found[*node], wanted, self.bodies[index].mesh);
                    // What is no number is not near, either.
                    let is_near = off_mm <= PLACE_LIMIT_MM;
                    if !is_near {
                        is_told[index] = true;
                        let (name, play) = (self.bodies[index].name, &play.name);
                        faults.push(format!(
                            "{name} is {off_mm:.3} mm off at {time_s} s of `{play}`"
                        ));
                    }
                }
            }
        }
        faults
    }
}

/// Returns the greatest distance of a body's corners of its box in two places, mm; no number if
/// one of them is none.
fn off_mm(found: &Frame, wanted: &Frame, mesh: &TriMesh) -> f64 {
    let bounds = mesh.aabb();
    let corner = |index: usize| {
        let pick = |axis: usize| [bounds.min, bounds.max][index >> axis & 1][axis];
        Point::new(pick(0), pick(1), pick(2))
    };
    let far = (0..8).map(|index| {
        let corner = corner(index);
        (found.to_model(&corner) - wanted.to_model(&corner)).norm()
    });
    // `f64::max` would drop what is no number.
    far.fold(0.0, |worst: f64, far| {
        if worst.is_nan() || far <= worst {
            worst
        } else {
            far
        }
    })
}

#[cfg(test)]
mod tests;
