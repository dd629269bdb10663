//! The facts about a telescope's parts and motion.

use rayon::prelude::*;

use super::contact::{Body, moved, seen_from};
use super::deviation::{Deviated, deviation};
use super::evidence::TelescopeEvidence;
use super::motion::{TelescopeMotion, frame_of};
use super::shells::{ShellFacts, measure};
use super::standing::{Stands, stands, upright};
use super::stops::{JointFacts, Trial};
use super::surfaces::{LyingPart, Surfaces};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Frame};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::TriMesh;
use crate::verify::Pose;

/// States looked at in each move besides its ends.
pub(super) const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

/// States of each move at which it is looked at how low parts reach.
const GROUND_STATES: usize = 20;

/// Share of the clearance that shells must keep that do not slide in each other.
pub(super) const APART_SHARE: f64 = 0.9;

/// Two placements are the same up to this, mm: rounding.
pub(super) const SAME_MM: f64 = 1e-9;

/// The facts about a telescope.
#[derive(Debug, Clone, PartialEq)]
pub struct TelescopeFacts {
    /// Parts that bound no solid, with the first defect.
    pub broken: Vec<String>,
    /// Pairs of triangles of one part that cross.
    pub crossings: usize,
    /// Parts that are more than one body.
    pub in_pieces: Vec<String>,
    /// The greatest height of a part's lowest point over the plate, mm.
    pub above_plate_mm: f64,
    /// Parts that are larger than the printer.
    pub too_large: Vec<String>,
    /// The tubes.
    pub shells: Vec<ShellFacts>,
    /// The joints.
    pub joints: Vec<JointFacts>,
    /// Pairs of shells that come too near at a state, in words.
    pub too_near: Vec<String>,
    /// States that were looked at.
    pub states: usize,
    /// The greatest difference of a written placement from the judge's own, mm.
    pub placement_error_mm: f64,
    /// The deviation from the curve; `None` without points or keys.
    pub deviation: Option<Deviated>,
    /// Mass of all parts, g.
    pub mass_g: f64,
    /// The balance at every key.
    pub balance: Vec<Stands>,
    /// The depth to which parts reach below the root's lowest point at every key, mm.
    pub depths_mm: Vec<f64>,
    /// The depth to which any part reaches below the root's lowest point at any state, mm.
    pub below_foot_mm: f64,
    /// The boxes of all parts when all in and all out, mm.
    pub boxes_mm: [[f64; 3]; 2],
}

/// Measures a telescope.
///
/// # Errors
/// The watch was stopped.
pub fn judge_telescope(
    evidence: &TelescopeEvidence,
    watch: &Watch,
) -> Result<TelescopeFacts, Cancelled> {
    let bodies = shell_bodies(evidence);
    judge_bodies(evidence, &bodies, watch)
}

/// Measures a telescope of which every shell with its cap is prepared, in the shell's frame.
pub(super) fn judge_bodies(
    evidence: &TelescopeEvidence,
    bodies: &[Body],
    watch: &Watch,
) -> Result<TelescopeFacts, Cancelled> {
    let motion = &evidence.motion;
    let promise = &evidence.promise;
    let tubes: Vec<Body> = evidence
        .tubes()
        .map(|mesh| Body::new(mesh.clone()))
        .collect();
    watch.check()?;
    let joints = promise.joints.par_iter().enumerate().map(|(joint, own)| {
        watch.check()?;
        let trial = Trial {
            motion,
            joint,
            outer: &bodies[joint],
            inner: &bodies[joint + 1],
        };
        Ok(trial.facts(own))
    });
    let joints = joints.collect::<Result<Vec<_>, Cancelled>>()?;
    let limit_mm = APART_SHARE * promise.clearance_mm;
    let (too_near, states) = far_pairs(motion, bodies, limit_mm, watch)?;
    let tube_facts = promise.parts.iter().filter(|part| part.is_tube);
    let shells = tube_facts.zip(&motion.shells).zip(&tubes);
    let shells = shells.map(|((part, shell), tube)| measure(shell, part.body_mm, tube));
    let moments: Vec<Moments> = bodies
        .iter()
        .map(|body| moments_of_mesh(&body.mesh))
        .collect();
    let volume: f64 = moments.iter().map(Moments::volume).sum();
    let balance = motion
        .keys
        .iter()
        .map(|key| stands(motion, &key.states, &moments, &bodies[0].mesh));
    let parts = promise.parts.iter().zip(&evidence.parts);
    let parts = parts.map(|(part, mesh)| LyingPart {
        id: &part.id,
        pose: &part.print_from_shell,
        mesh,
    });
    let surfaces = Surfaces::of(parts, promise.printer.build_volume_mm, watch)?;
    let ends = [motion.keys.first(), motion.keys.last()];
    Ok(TelescopeFacts {
        broken: surfaces.broken,
        crossings: surfaces.crossings,
        in_pieces: surfaces.in_pieces,
        above_plate_mm: surfaces.above_plate_mm,
        too_large: surfaces.too_large,
        shells: shells.collect(),
        joints,
        too_near,
        states,
        placement_error_mm: placement_error_mm(motion),
        deviation: deviation(motion, &evidence.asked),
        mass_g: volume * promise.material.density_g_cm3 / crate::base::units::MM3_PER_CM3,
        balance: balance.collect(),
        depths_mm: depths_mm(motion, bodies),
        below_foot_mm: below_foot_mm(motion, bodies),
        boxes_mm: ends.map(|key| key.map_or([0.0; 3], |key| size_mm(motion, &key.states, bodies))),
    })
}

/// Returns every shell with its cap, in the shell's frame.
pub(super) fn shell_bodies(evidence: &TelescopeEvidence) -> Vec<Body> {
    let shells = 0..evidence.motion.shells.len();
    let body = |shell: usize| {
        let parts = evidence.promise.parts.iter().zip(&evidence.parts);
        let own = parts.filter(|(part, _)| part.shell == shell + 1);
        Body::new(own.fold(TriMesh::default(), |all, (_, mesh)| all.joined(mesh)))
    };
    shells.map(body).collect()
}

/// Returns the pairs of shells, not neighbours, that come nearer than a limit, and the number of
/// states that were looked at.
fn far_pairs(
    motion: &TelescopeMotion,
    bodies: &[Body],
    limit_mm: f64,
    watch: &Watch,
) -> Result<(Vec<String>, usize), Cancelled> {
    let mut looked = Looked::default();
    let mut states = 0;
    for (number, pair) in motion.keys.windows(2).enumerate() {
        let first = (number == 0).then_some(0.0);
        for share in first.into_iter().chain(BETWEEN).chain([1.0]) {
            watch.check()?;
            states += 1;
            let state = mixed(&pair[0].states, &pair[1].states, share);
            let frames = motion.frames(&state);
            looked.look(bodies, &frames, limit_mm, &format!("move {}", number + 1));
        }
    }
    Ok((looked.too_near, states))
}

/// Two shells, from 0, and the frame of the second in that of the first.
struct Pair {
    shells: [usize; 2],
    placed: Frame,
}

/// The pairs that were looked at, each where it was last.
#[derive(Default)]
struct Looked {
    last: Vec<Pair>,
    too_near: Vec<String>,
}

impl Looked {
    fn look(&mut self, bodies: &[Body], frames: &[Frame], limit_mm: f64, state: &str) {
        let count = bodies.len();
        let pairs = (0..count).flat_map(|i| (i + 2..count).map(move |j| [i, j]));
        let placed = pairs.map(|[i, j]| Pair {
            shells: [i, j],
            placed: seen_from(&frames[i], &frames[j]),
        });
        let placed: Vec<Pair> = placed.filter(|pair| !self.is_known(pair)).collect();
        let near = placed.par_iter().filter(|pair| {
            let [i, j] = pair.shells;
            bodies[i].is_nearer(&bodies[j], &pair.placed, limit_mm)
        });
        let words = |pair: &Pair| {
            let [i, j] = pair.shells;
            format!("S{:02} and S{:02} in {state}", i + 1, j + 1)
        };
        let near: Vec<String> = near.map(words).collect();
        self.too_near.extend(near);
        for pair in placed {
            self.last.retain(|last| last.shells != pair.shells);
            self.last.push(pair);
        }
    }

    fn is_known(&self, pair: &Pair) -> bool {
        self.last.iter().any(|last| {
            last.shells == pair.shells
                && (last.placed.origin - pair.placed.origin).norm() < SAME_MM
                && (last.placed.axes - pair.placed.axes).amax() < SAME_MM
        })
    }
}

pub(super) fn mixed(from: &[[f64; 2]], to: &[[f64; 2]], share: f64) -> Vec<[f64; 2]> {
    let ends = from.iter().zip(to);
    ends.map(|(a, b)| [0, 1].map(|i| a[i] + (b[i] - a[i]) * share))
        .collect()
}

/// Returns the greatest difference of the placements of keys from those of the judge's screws.
fn placement_error_mm(motion: &TelescopeMotion) -> f64 {
    let errors = motion.keys.iter().flat_map(|key| {
        let own = motion.frames(&key.states);
        let written: Vec<Pose> = key.placements.clone();
        let missing = own.len().abs_diff(written.len());
        let pairs = own.into_iter().zip(written).map(|(own, written)| {
            let written = frame_of(&written);
            let far = (own.origin - written.origin).norm();
            far.max((own.axes - written.axes).amax())
        });
        let pairs: Vec<f64> = pairs.collect();
        pairs
            .into_iter()
            .chain((missing > 0).then_some(f64::INFINITY))
    });
    errors.fold(0.0, f64::max)
}

/// Returns the box of all parts in a state, along the root's axes.
fn size_mm(motion: &TelescopeMotion, states: &[[f64; 2]], bodies: &[Body]) -> [f64; 3] {
    let frames = motion.frames(states);
    let root = &frames[0];
    let boxes = bodies
        .iter()
        .zip(&frames)
        .map(|(body, frame)| moved(&body.mesh, &seen_from(root, frame)).aabb());
    let whole = boxes.fold(Aabb::EMPTY, |whole, part| whole.union(&part));
    whole.size().into()
}

/// Returns how far parts reach below the root's lowest point, over the keys and the states between,
/// mm: 0 if nothing does.
fn below_foot_mm(motion: &TelescopeMotion, bodies: &[Body]) -> f64 {
    let first = motion.keys.first().map(|key| key.states.clone());
    let moves = motion.keys.windows(2);
    let between = moves.flat_map(|pair| {
        let shares = (1..=GROUND_STATES).map(|i| i as f64 / GROUND_STATES as f64);
        shares.map(|share| mixed(&pair[0].states, &pair[1].states, share))
    });
    let states = first.into_iter().chain(between);
    let depths = states.map(|states| depth_mm(motion, &states, bodies));
    depths.fold(0.0, f64::max)
}

/// Returns how far parts reach below the root's lowest point at every key, mm.
fn depths_mm(motion: &TelescopeMotion, bodies: &[Body]) -> Vec<f64> {
    let keys = motion.keys.iter();
    keys.map(|key| depth_mm(motion, &key.states, bodies))
        .collect()
}

/// Returns how far parts reach below the root's lowest point in a state, mm: 0 if nothing does.
fn depth_mm(motion: &TelescopeMotion, states: &[[f64; 2]], bodies: &[Body]) -> f64 {
    let up = upright(motion);
    let lowest = |body: &Body, frame: &Frame| {
        let heights = body.mesh.vertices().par_iter();
        let heights = heights.map(|p| up.to_local(&frame.to_model(p)).z);
        heights.reduce(|| f64::INFINITY, f64::min)
    };
    let frames = motion.frames(states);
    let heights = bodies.iter().zip(&frames);
    let mut heights = heights.map(|(body, frame)| lowest(body, frame));
    let ground = heights.next().unwrap_or(0.0);
    heights.map(|z| ground - z).fold(0.0, f64::max)
}
