//! The evidence of several telescopes on junctures, as the judge sees it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::evidence::TelescopeEvidence;
use super::juncture::{JunctureJointPromise, JuncturePromise, Piece, in_model};
use super::motion::{TelescopeMotion, frame_of};
use super::pose::{PoseMotion, PosePromise};
use super::promise::TelescopePromise;
use crate::geom::Frame;
use crate::mesh::TriMesh;
use crate::verify::{Density, PartEvidence, Pose, PrinterLimits};

/// The version of the keys of its checklist. Since 2 a juncture lists its parts.
pub const NETWORK_SCHEMA: u32 = 2;

/// The promises of a kit of several telescopes.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct NetworkPromise {
    /// The version of the keys.
    pub schema: u32,
    /// The limits of the printer.
    pub printer: PrinterLimits,
    /// The material of the parts.
    pub material: Density,
    /// The clearance of glued joints, mm.
    pub glue_mm: f64,
    /// The depth of the groove beside a root, mm.
    #[serde(default)]
    pub groove_mm: f64,
    /// The file of the model whose pieces the junctures are, relative to the kit; `None` if they
    /// are none.
    #[serde(default)]
    pub model: Option<String>,
    /// The telescopes, each after the one that carries it.
    pub limbs: Vec<LimbPromise>,
    /// The junctures. The first stands still.
    pub junctures: Vec<JuncturePromise>,
    /// The joints between parts of one juncture.
    #[serde(default)]
    pub juncture_joints: Vec<JunctureJointPromise>,
    /// The names of the telescopes in the order in which they open.
    pub order: Vec<String>,
    /// The mass of all parts, g.
    pub mass_g: f64,
    /// The lean at which it topples at every key of the motion, degrees; none if it need not stand.
    #[serde(default)]
    pub toppling_deg: Vec<f64>,
    /// The toppling angle that is promised, degrees; `None` if it need not stand.
    #[serde(default)]
    pub least_angle_deg: Option<f64>,
    /// The centre of mass at every key of the motion, mm.
    pub centres_mm: Vec<[f64; 3]>,
    /// The box of all parts when all in, along the model's axes, mm.
    pub collapsed_mm: [f64; 3],
    /// The same when all out, mm.
    pub extended_mm: [f64; 3],
    /// The poses.
    #[serde(default)]
    pub poses: Vec<PosePromise>,
    /// The SHA-256 of every other file of the kit.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
}

/// A telescope between two junctures.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct LimbPromise {
    /// Its name on the sheet, such as `A`.
    pub id: String,
    /// The juncture that holds its root, from 1.
    pub from: usize,
    /// The juncture that its last shell carries, from 1.
    pub to: usize,
    /// Its own promises.
    pub sheet: TelescopePromise,
}

/// The motion of several telescopes: their `motion.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NetworkMotion {
    /// The version of the keys.
    pub schema: u32,
    /// The direction in which the model stands, of length 1.
    pub up: [f64; 3],
    /// The motion of each telescope alone, in the model's frame with all out.
    pub limbs: Vec<TelescopeMotion>,
    /// The ids of the telescopes in the order in which they open.
    pub order: Vec<String>,
    /// The states between moves, from all in to all out.
    pub keys: Vec<NetworkKey>,
    /// The poses.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<PoseMotion>,
}

/// A state of all joints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NetworkKey {
    /// Slide (mm) and turn (rad) of the joints of every telescope.
    pub states: Vec<Vec<[f64; 2]>>,
    /// The motion of every juncture from where it is when all is out, by rows.
    pub junctures: Vec<Pose>,
}

/// Everything that the judge sees.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkEvidence {
    /// The promises.
    pub promise: NetworkPromise,
    /// The motion.
    pub motion: NetworkMotion,
    /// The evidence of every telescope.
    pub limbs: Vec<TelescopeEvidence>,
    /// The parts of every juncture as they were read back, in their order on the list.
    pub junctures: Vec<Vec<PartEvidence>>,
    /// The model whose pieces they are; `None` if they are none.
    pub model: Option<TriMesh>,
    /// The texts of the pose files, in the order of the promises.
    pub pose_files: Vec<String>,
}

/// The places of all bodies in a state.
pub(super) struct Places {
    pub junctures: Vec<Frame>,
    pub shells: Vec<Vec<Frame>>,
}

impl NetworkMotion {
    /// Returns whether the keys go from all in to all out, one telescope after the other in their
    /// order. `names` are those of the telescopes.
    pub(super) fn opens_in_order(&self, names: &[&String]) -> bool {
        let ends = self.keys.first().zip(self.keys.last());
        let opens = ends.is_some_and(|(first, last)| {
            let ends = first.states.iter().zip(&last.states);
            let mut limbs = self.limbs.iter().zip(ends);
            limbs.all(|(limb, (first, last))| limb.opens(first, last))
        });
        opens && self.found_order(names) == Some(self.order.iter().collect())
    }

    /// Returns the telescopes in the order in which the keys move them; `None` if two move at
    /// once, or one moves in two stretches.
    fn found_order<'a>(&self, names: &[&'a String]) -> Option<Vec<&'a String>> {
        let mut found: Vec<&String> = Vec::new();
        for pair in self.keys.windows(2) {
            let states = pair[0].states.iter().zip(&pair[1].states).zip(names);
            let mut moved = states.filter(|((a, b), _)| a != b).map(|(_, name)| *name);
            match (moved.next(), moved.next()) {
                (Some(one), None) if found.last() == Some(&one) => {}
                (Some(one), None) if !found.contains(&one) => found.push(one),
                _ => return None,
            }
        }
        Some(found)
    }
}

impl NetworkEvidence {
    /// Returns the parts of all junctures where they are when all is out.
    pub(super) fn pieces(&self) -> impl Iterator<Item = Piece<'_>> {
        let junctures = self.promise.junctures.iter().zip(&self.junctures);
        junctures.enumerate().flat_map(|(juncture, (own, read))| {
            let parts = own.parts.iter().zip(read);
            parts.map(move |(promise, part)| Piece {
                juncture,
                promise,
                mesh: in_model(part),
            })
        })
    }

    /// Returns every juncture as one mesh, where it is when all is out.
    pub(super) fn whole_junctures(&self) -> Vec<TriMesh> {
        let whole = |parts: &Vec<PartEvidence>| {
            let parts = parts.iter().map(in_model);
            parts.fold(TriMesh::default(), |all, part| all.joined(&part))
        };
        self.junctures.iter().map(whole).collect()
    }

    /// Returns the places of all bodies in a state, by the judge's own screws.
    pub(super) fn places(&self, states: &[Vec<[f64; 2]>]) -> Places {
        let count = self.promise.junctures.len();
        let mut places = Places {
            junctures: vec![Frame::identity(); count],
            shells: Vec::new(),
        };
        let limbs = self.promise.limbs.iter().zip(&self.motion.limbs);
        for ((limb, motion), state) in limbs.zip(states) {
            let base = places.junctures[limb.from - 1];
            let own = motion.frames(state);
            let open: Vec<[f64; 2]> = motion
                .joints
                .iter()
                .map(|joint| [joint.open_mm, joint.turn_rad])
                .collect();
            let root = frame_of(&motion.root);
            let [now, out] = [own.clone(), motion.frames(&open)]
                .map(|frames| frames.last().copied().unwrap_or(root));
            let carried = now.frame_to_model(&out.inverse());
            places.junctures[limb.to - 1] = base.frame_to_model(&carried);
            let placed = own.iter().map(|frame| base.frame_to_model(frame));
            places.shells.push(placed.collect());
        }
        places
    }
}
