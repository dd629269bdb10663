//! The judgement of poses: tips in their places, and no two shells touch on the way there.

use super::contact::{Body, seen_from};
use super::course::{APART_SHARE, Course};
use super::evidence::TelescopeEvidence;
use super::motion::{TelescopeMotion, frame_of};
use super::pose::{PoseMotion, PosePromise, PoseState, PoseText, PosesFacts};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Frame, Matrix, Point};

/// Difference of slides (mm) and turns (rad) that is the rounding of files.
const STATE_LIMIT: f64 = 1e-6;
/// By how much a tip may be off the place that is stated, mm.
const STATED_LIMIT_MM: f64 = 0.01;
/// By how much a file may differ from the motion, mm and degrees: its digits.
const TEXT_LIMIT: f64 = 1e-3;
/// The word that tells a pose from other files.
const POSE_KIND: &str = "pose";
/// By how much a gap may be below the clearance, mm: as over the stroke.
const GAP_LIMIT_MM: f64 = 0.01;
/// By how much a frame may differ from the one that is stated, mm: the digits of a file.
const FRAME_LIMIT_MM: f64 = 1e-6;

/// The telescopes of a kit, and what is promised of their poses.
pub(super) struct PoseTrial<'a> {
    /// The promises.
    pub promises: &'a [PosePromise],
    /// The poses as they are written.
    pub poses: &'a [PoseMotion],
    /// Their files, in the order of the promises.
    pub files: &'a [String],
    /// The telescopes.
    pub limbs: Vec<&'a TelescopeEvidence>,
    /// The shells of each, every shell with its cap.
    pub bodies: Vec<&'a [Body]>,
}

impl PoseTrial<'_> {
    fn motions(&self) -> Vec<&TelescopeMotion> {
        self.limbs.iter().map(|limb| &limb.motion).collect()
    }

    /// Returns the poses whose states are those of the joints.
    pub fn sound(&self) -> impl Iterator<Item = &PoseMotion> {
        let motions = self.motions();
        let poses = self.poses.iter();
        poses.filter(move |pose| fault(pose, &motions).is_none())
    }

    /// Measures all poses. `frames` places the shells of every telescope in a state.
    ///
    /// # Errors
    /// The watch was stopped.
    pub fn facts(
        &self,
        frames: impl Fn(&PoseState) -> Vec<Vec<Frame>>,
        watch: &Watch,
    ) -> Result<PosesFacts, Cancelled> {
        let mut facts = PosesFacts::default();
        let names = self.promises.iter().map(|promise| &promise.name);
        if !names.eq(self.poses.iter().map(|pose| &pose.name)) {
            let why = "the motion has other poses than the checklist";
            facts.faults.push(why.to_owned());
            return Ok(facts);
        }
        let motions = self.motions();
        for (promise, pose) in self.promises.iter().zip(self.poses) {
            if let Some(why) = fault(pose, &motions) {
                facts.faults.push(format!("pose {}: {why}", pose.name));
                continue;
            }
            let Some(last) = pose.keys.last() else {
                continue;
            };
            let placed = frames(last);
            self.measure_tips(promise, &placed, &mut facts);
            facts.faults.extend(self.file_fault(promise, last));
            if placement_error_mm(pose, &placed) > FRAME_LIMIT_MM {
                let why = format!(
                    "pose {}: a shell is not where its joints place it",
                    pose.name
                );
                facts.faults.push(why);
            }
            for limb in 0..self.limbs.len() {
                facts.faults.extend(self.far_pairs(limb, pose, watch)?);
                facts.faults.extend(self.neighbours(limb, pose));
            }
        }
        Ok(facts)
    }

    fn measure_tips(&self, promise: &PosePromise, placed: &[Vec<Frame>], facts: &mut PosesFacts) {
        for tip in &promise.tips {
            let limb = tip.limb.checked_sub(1);
            let own = limb.and_then(|limb| Some((self.limbs.get(limb)?, placed.get(limb)?)));
            let end = own.and_then(|(limb, frames)| {
                let last = limb.motion.shells.last()?;
                let along = last.along(last.length_mm);
                Some(frames.last()?.frame_to_model(&along).origin)
            });
            let name = format!("pose {}, {}", promise.name, tip.id);
            let Some(end) = end else {
                facts.faults.push(format!("{name}: there is no such tip"));
                continue;
            };
            let stated_mm = (end - Point::from(tip.reached_mm)).norm();
            if stated_mm.is_nan() || stated_mm > STATED_LIMIT_MM {
                facts
                    .faults
                    .push(format!("{name} is {stated_mm:.3} mm off what is stated"));
            }
            let off_mm = tip
                .wanted_mm
                .map(|wanted| (end - Point::from(wanted)).norm());
            if let Some(off_mm) = off_mm.filter(|off| facts.off_mm.is_none_or(|most| *off > most)) {
                facts.off_mm = Some(off_mm);
                facts.farthest = Some(name);
            }
        }
    }

    /// Returns the reason why the file of a pose says something else than the motion does.
    fn file_fault(&self, promise: &PosePromise, state: &PoseState) -> Option<String> {
        let named = self.promises.iter().zip(self.files);
        let mut own = named.filter(|(own, _)| own.name == promise.name);
        let text = own
            .next()
            .map(|(_, text)| text.as_str())
            .unwrap_or_default();
        let fault = |why: &str| Some(format!("{}: {why}", promise.file));
        let Ok(read) = toml::from_str::<PoseText>(text) else {
            return fault("it is no pose");
        };
        if read.kind != POSE_KIND || read.name != promise.name {
            return fault("it is another pose");
        }
        let mut told = read.joint.iter();
        let limbs = self.limbs.iter().zip(state);
        let mut joints = limbs.flat_map(|(limb, own)| limb.motion.joints.iter().zip(own));
        let is_same = joints.all(|(joint, [slide, turn])| {
            told.next().is_some_and(|told| {
                let stroke_mm = slide - joint.closed_mm;
                told.id == joint.id
                    && (told.stroke_mm - stroke_mm).abs() <= TEXT_LIMIT
                    && (told.turn_deg - turn.to_degrees()).abs() <= TEXT_LIMIT
            })
        });
        if is_same && told.next().is_none() {
            return None;
        }
        fault("its strokes are not those of the motion")
    }

    /// Returns the shells of a telescope, not neighbours, that touch on the way.
    fn far_pairs(
        &self,
        limb: usize,
        pose: &PoseMotion,
        watch: &Watch,
    ) -> Result<Vec<String>, Cancelled> {
        let own = self.limbs[limb];
        let course = Course {
            motion: &own.motion,
            bodies: self.bodies[limb],
            limit_mm: APART_SHARE * own.promise.clearance_mm,
        };
        let keys: Vec<&[[f64; 2]]> = pose.keys.iter().map(|key| &key[limb][..]).collect();
        let (near, _) = course.far_pairs(&keys, watch)?;
        let near = near.into_iter();
        Ok(near
            .map(|why| format!("pose {}: {why}", pose.name))
            .collect())
    }

    /// Returns the joints that have less than their clearance in the pose. Over the last of their
    /// way seats close; there the trial of stops holds.
    fn neighbours(&self, limb: usize, pose: &PoseMotion) -> Vec<String> {
        let own = self.limbs[limb];
        let limit_mm = own.promise.clearance_mm - GAP_LIMIT_MM;
        let Some(last) = pose.keys.last() else {
            return Vec::new();
        };
        let joints = last[limb].iter().zip(&own.promise.joints).enumerate();
        let tight = joints.filter(|(joint, ([slide, turn], promise))| {
            let bodies = &self.bodies[limb][*joint..];
            let placed = own.motion.step(*joint, [*slide, *turn]);
            *slide <= promise.free_to_mm && bodies[0].is_nearer(&bodies[1], &placed, limit_mm)
        });
        let words = |promise: &str| format!("pose {}: {promise} has no clearance", pose.name);
        tight.map(|(_, (_, promise))| words(&promise.id)).collect()
    }
}

/// Returns the greatest difference of written frames from the judge's own, mm.
fn placement_error_mm(pose: &PoseMotion, placed: &[Vec<Frame>]) -> f64 {
    let pairs = pose.shells.iter().flatten().zip(placed.iter().flatten());
    let errors = pairs.map(|(written, own)| {
        let seen = seen_from(&frame_of(written), own);
        let axes = (seen.axes - Matrix::identity()).amax();
        seen.origin.coords.norm().max(axes)
    });
    errors.fold(0.0, f64::max)
}

/// Returns the reason why the states are not those of a way from all in.
fn fault(pose: &PoseMotion, motions: &[&TelescopeMotion]) -> Option<&'static str> {
    let joints = || motions.iter().map(|motion| motion.joints.len());
    let fits = |state: &PoseState| state.iter().map(Vec::len).eq(joints());
    let placed = pose.shells.iter().map(Vec::len);
    if pose.keys.is_empty() || !pose.keys.iter().all(fits) {
        return Some("its states do not fit the joints");
    }
    if !placed.eq(motions.iter().map(|motion| motion.shells.len())) {
        return Some("it does not place every shell");
    }
    if !pose.keys.iter().all(|state| is_possible(state, motions)) {
        return Some("a joint is beyond its range, or turns before it is out");
    }
    let is_in = |(own, motion): (&Vec<[f64; 2]>, &&TelescopeMotion)| {
        let joints = own.iter().zip(&motion.joints);
        joints
            .clone()
            .all(|(own, joint)| (own[0] - joint.closed_mm).abs() <= STATE_LIMIT)
            && own.iter().all(|own| own[1].abs() <= STATE_LIMIT)
    };
    let begins = pose.keys[0].iter().zip(motions).all(is_in);
    (!begins).then_some("its way does not begin with all shells in")
}

/// Returns true if every joint is within its range, and turned only if it is all out.
fn is_possible(state: &PoseState, motions: &[&TelescopeMotion]) -> bool {
    let limbs = state.iter().zip(motions);
    let mut joints = limbs.flat_map(|(own, motion)| own.iter().zip(&motion.joints));
    joints.all(|([slide, turn], joint)| {
        let slides = joint.closed_mm - STATE_LIMIT..=joint.open_mm + STATE_LIMIT;
        let whole = joint.turn_rad;
        let turns = whole.min(0.0) - STATE_LIMIT..=whole.max(0.0) + STATE_LIMIT;
        let is_out = (slide - joint.open_mm).abs() <= STATE_LIMIT;
        slides.contains(slide) && turns.contains(turn) && (is_out || turn.abs() <= STATE_LIMIT)
    })
}
