//! `motion.glb`: whether it holds the parts as they are judged, and moves them as the keys do.

use super::checks::none;
use super::evidence::TelescopeEvidence;
use super::facts::{BETWEEN, mixed};
use super::network::NetworkEvidence;
use crate::geom::{Frame, Point};
use crate::io::glb::{GlbError, ReadScene, decode_glb};
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

/// A body in its own frame.
struct Wanted<'a> {
    name: &'a str,
    mesh: &'a TriMesh,
}

/// The bodies, and where they are at a time.
struct Script<'a> {
    bodies: Vec<Wanted<'a>>,
    moves: usize,
    places: Box<dyn Fn(usize, f64) -> Vec<Frame> + 'a>,
}

/// Checks the moving scene of a telescope.
pub fn scene_check(folder: &KitFolder, evidence: &TelescopeEvidence) -> Check {
    let (motion, parts) = (&evidence.motion, &evidence.promise.parts);
    let bodies = parts.iter().zip(&evidence.parts);
    let script = Script {
        bodies: bodies
            .map(|(part, mesh)| Wanted {
                name: &part.id,
                mesh,
            })
            .collect(),
        moves: motion.keys.len() - 1,
        places: Box::new(|start, share| {
            let end = &motion.keys[(start + 1).min(motion.keys.len() - 1)];
            let frames = motion.frames(&mixed(&motion.keys[start].states, &end.states, share));
            parts.iter().map(|part| frames[part.shell - 1]).collect()
        }),
    };
    script.check(folder)
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
    let junctures = evidence.promise.junctures.iter().zip(&evidence.junctures);
    let junctures = junctures.map(|(own, mesh)| Wanted {
        name: &own.id,
        mesh,
    });
    let script = Script {
        bodies: limbs.chain(junctures).collect(),
        moves: motion.keys.len() - 1,
        places: Box::new(|start, share| {
            let end = &motion.keys[(start + 1).min(motion.keys.len() - 1)];
            let limbs = motion.keys[start].states.iter().zip(&end.states);
            let states: Vec<_> = limbs.map(|(a, b)| mixed(a, b, share)).collect();
            let places = evidence.places(&states);
            let limbs = evidence.limbs.iter().zip(&places.shells);
            let shells = limbs.flat_map(|(limb, frames)| {
                let parts = limb.promise.parts.iter();
                parts.map(|part| frames[part.shell - 1])
            });
            shells.chain(places.junctures.iter().copied()).collect()
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
        let mut faults = Vec::new();
        if (scene.scale - SCALE).abs() > SCALE_LIMIT {
            faults.push(format!("{MOTION_SCENE_FILE} is not in metres"));
        }
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
        faults.extend(self.misplaced(&scene, &nodes));
        faults
    }

    /// Returns for each body that is off the first time at which it is.
    fn misplaced(&self, scene: &ReadScene, nodes: &[Result<usize, String>]) -> Vec<String> {
        let mut animations = scene.animations.iter();
        let Some(opening) = animations.find(|animation| animation.name == OPENING) else {
            let is_needed = self.moves > 0;
            let missing = format!("{MOTION_SCENE_FILE} has no animation `{OPENING}`");
            return is_needed.then_some(missing).into_iter().collect();
        };
        let mut is_told = vec![false; self.bodies.len()];
        let mut faults = Vec::new();
        for (start, share) in self.times() {
            let time_s = start as f64 + share;
            let found = scene.places(opening, time_s);
            let wanted = (self.places)(start, share);
            for (index, (node, wanted)) in nodes.iter().zip(&wanted).enumerate() {
                let (Ok(node), false) = (node, is_told[index]) else {
                    continue;
                };
                let off_mm = off_mm(&found[*node], wanted, self.bodies[index].mesh);
                if off_mm > PLACE_LIMIT_MM {
                    is_told[index] = true;
                    let name = self.bodies[index].name;
                    faults.push(format!("{name} is {off_mm:.3} mm off at {time_s} s"));
                }
            }
        }
        faults
    }

    /// Returns the times at which the scene is held against the keys: a move, and a share of it.
    fn times(&self) -> impl Iterator<Item = (usize, f64)> {
        let moves = (0..self.moves).flat_map(|start| {
            let shares = [0.0].into_iter().chain(BETWEEN);
            shares.map(move |share| (start, share))
        });
        moves.chain([(self.moves, 0.0)])
    }
}

/// Returns the greatest distance of a body's corners of its box in two places, mm.
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
    far.fold(0.0, f64::max)
}
