//! The facts about a telescope's parts and motion.

use rayon::prelude::*;

use super::ballast::{faults, weighed};
use super::contact::{Body, moved, seen_from};
use super::course::{APART_SHARE, BETWEEN, Course, mixed};
use super::deviation::{Deviated, deviation};
use super::evidence::TelescopeEvidence;
use super::motion::{TelescopeMotion, frame_of};
use super::pose::{PoseMotion, PosesFacts};
use super::poses::PoseTrial;
use super::shells::{ShellFacts, measure};
use super::standing::{Stands, stands, upright};
use super::stops::{JointFacts, Trial};
use super::surfaces::{LyingPart, Surfaces};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Frame};
use crate::mass::Moments;
use crate::mesh::TriMesh;
use crate::verify::Pose;

/// Parts may reach this far below the foot, mm.
pub(super) const GROUND_LIMIT_MM: f64 = 0.01;

/// States of each move at which it is looked at how low parts reach.
const GROUND_STATES: usize = 20;

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
    /// The faults of the ballast in its foot, in words.
    pub ballast_faults: Vec<String>,
    /// The balance at every key.
    pub balance: Vec<Stands>,
    /// The depth to which parts reach below the root's lowest point at every key, mm.
    pub depths_mm: Vec<f64>,
    /// The depth to which any part reaches below the root's lowest point at any state, mm.
    pub below_foot_mm: f64,
    /// The boxes of all parts when all in and all out, mm.
    pub boxes_mm: [[f64; 3]; 2],
    /// The facts about its poses.
    pub poses: PosesFacts,
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
    let mut facts = judge_bodies(evidence, &bodies, watch)?;
    let trial = PoseTrial {
        promises: &evidence.promise.poses,
        poses: &evidence.motion.poses,
        files: &evidence.pose_files,
        limbs: vec![evidence],
        bodies: vec![&bodies],
    };
    facts.poses = trial.facts(|state| vec![evidence.motion.frames(&state[0])], watch)?;
    let fallen = trial
        .sound()
        .filter_map(|pose| fallen(evidence, &bodies, pose));
    let fallen: Vec<String> = fallen.collect();
    facts.poses.faults.extend(fallen);
    Ok(facts)
}

/// Returns the fault of a pose in which a telescope falls that is to stand, at a state of its way.
fn fallen(evidence: &TelescopeEvidence, bodies: &[Body], pose: &PoseMotion) -> Option<String> {
    let least_deg = evidence.promise.least_angle_deg?;
    let motion = &evidence.motion;
    let moments = weighed(&evidence.promise, bodies);
    let falls = |states: &[[f64; 2]]| {
        let lean_deg = stands(motion, states, &moments, &bodies[0].mesh).toppling_deg;
        lean_deg < least_deg || depth_mm(motion, states, bodies) > GROUND_LIMIT_MM
    };
    let keys = pose.keys.windows(2);
    let mut ways = keys.flat_map(|pair| {
        let shares = BETWEEN.into_iter().chain([1.0]);
        shares.map(|share| mixed(&pair[0][0], &pair[1][0], share))
    });
    ways.any(|states| falls(&states))
        .then(|| format!("pose {}: it does not stand as promised", pose.name))
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
    let course = Course {
        motion,
        bodies,
        limit_mm: APART_SHARE * promise.clearance_mm,
    };
    let keys: Vec<&[[f64; 2]]> = motion.keys.iter().map(|key| &key.states[..]).collect();
    let (too_near, states) = course.far_pairs(&keys, watch)?;
    let tube_facts = promise.parts.iter().filter(|part| part.is_tube);
    let shells = tube_facts.zip(&motion.shells).zip(&tubes);
    let shells = shells.map(|((part, shell), tube)| measure(shell, part, tube));
    let moments = weighed(&evidence.promise, bodies);
    let volume: f64 = moments.iter().map(Moments::volume).sum();
    let balance = motion
        .keys
        .iter()
        .map(|key| stands(motion, &key.states, &moments, &bodies[0].mesh));
    let surfaces = surfaces(evidence, watch)?;
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
        ballast_faults: bodies
            .first()
            .map_or_else(Vec::new, |root| faults(promise, root)),
        balance: balance.collect(),
        depths_mm: depths_mm(motion, bodies),
        below_foot_mm: below_foot_mm(motion, bodies),
        boxes_mm: ends.map(|key| key.map_or([0.0; 3], |key| size_mm(motion, &key.states, bodies))),
        poses: PosesFacts::default(),
    })
}

/// Looks at the parts as they lie on the plate.
fn surfaces(evidence: &TelescopeEvidence, watch: &Watch) -> Result<Surfaces, Cancelled> {
    let promise = &evidence.promise;
    let parts = promise.parts.iter().zip(&evidence.printed);
    let parts = parts.map(|(part, mesh)| LyingPart { id: &part.id, mesh });
    Surfaces::of(parts, promise.printer.build_volume_mm, watch)
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
