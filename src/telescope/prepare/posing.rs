//! Poses that a job orders: a state for each, and a way there on which nothing touches.

use super::error::TelescopeRunError;
use super::made::Made;
use super::unposed::Unposed;
use crate::base::toml_text::TextFault;
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Point;
use crate::job::telescope::TelescopeJob;
use crate::telescope::motion::{Key, Opening};
use crate::telescope::network::Network;
use crate::telescope::pose::{Reached, Target};
use crate::telescope::pose_file::PoseFile;
use crate::verify::REACH_LIMIT_MM;

/// The name of the pose whose tips reach wanted places.
const REACH: &str = "reach";
/// States near enough to the wanted places whose ways are looked at.
const MOST_WAYS: usize = 8;

/// A pose, and the way there.
#[derive(Debug, Clone, PartialEq)]
pub struct Posed {
    pub name: String,
    /// The states between moves, from all in to the pose.
    pub keys: Vec<Vec<Key>>,
    /// Limb and joint of all that move, in their turn.
    pub moved: Vec<[usize; 2]>,
    /// The least gap between shells of one limb that is measured; `None` if all are of one bend.
    pub least_gap_mm: Option<f64>,
    pub tips: Vec<PosedTip>,
}

/// The end of a limb in a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct PosedTip {
    pub id: String,
    /// Its limb, from 0.
    pub limb: usize,
    pub wanted: Option<Point>,
    pub reached: Point,
}

/// Telescopes that are to take poses.
pub struct Poser<'a> {
    pub job: &'a TelescopeJob,
    pub network: &'a Network,
    /// The ids of the joints of every limb.
    pub joints: Vec<Vec<String>>,
    /// The names of the end of every limb; the first is told.
    pub tips: Vec<Vec<String>>,
    pub watch: &'a Watch,
}

/// The name of the end of a curve.
pub const TIP: &str = "tip";

/// Finds the order in which limbs go their ways, or says what touches.
pub type Sequence<'a> = dyn Fn(&[&[Key]]) -> Result<Result<Vec<usize>, String>, Cancelled> + 'a;

/// Reads the pose file of a job, to refuse it before any work.
pub fn pose_file(job: &TelescopeJob) -> Result<Option<PoseFile>, TextFault> {
    let Some(pose) = &job.pose else {
        return Ok(None);
    };
    let file = PoseFile::from_toml(&pose.source, &pose.text)?;
    if file.name == REACH && !job.reach.is_empty() {
        return Err(file.is_taken());
    }
    Ok(Some(file))
}

/// Refuses tips that a job names twice.
pub fn refuse_twice(job: &TelescopeJob) -> Result<(), TelescopeRunError> {
    let mut reaches = job.reach.iter().enumerate();
    let twice = reaches.find(|(i, reach)| job.reach[..*i].iter().any(|own| own.tip == reach.tip));
    match twice {
        Some((_, reach)) => Err(TelescopeRunError::TipTwice(reach.tip.clone())),
        None => Ok(()),
    }
}

/// The poses of a single telescope.
pub struct ChainPoses {
    pub network: Network,
    pub joints: Vec<Vec<String>>,
    pub posed: Vec<Posed>,
}

/// Takes the poses of a single telescope.
pub fn of_chain(
    job: &TelescopeJob,
    made: &Made,
    watch: &Watch,
) -> Result<Verdict<ChainPoses, Unposed>, TelescopeRunError> {
    let design = &made.best.design;
    let network = Network::alone(design.telescope.clone(), design.opening.clone());
    let ids = 0..design.telescope.joints.len();
    let joints = vec![ids.map(|joint| made.joint_id(joint)).collect()];
    let poser = Poser {
        job,
        network: &network,
        joints,
        tips: vec![vec![TIP.to_owned()]],
        watch,
    };
    let taken = poser.poses(&|_| Ok(Ok(vec![0])))?;
    let joints = poser.joints;
    Ok(taken.map(|posed| ChainPoses {
        network,
        joints,
        posed,
    }))
}

impl Poser<'_> {
    /// Takes all poses of the job, or says which one cannot be.
    pub fn poses(
        &self,
        sequence: &Sequence,
    ) -> Result<Verdict<Vec<Posed>, Unposed>, TelescopeRunError> {
        let mut poses = Vec::new();
        if self.job.reach.is_empty() && self.job.pose.is_none() {
            return Ok(Verdict::Found(poses));
        }
        if !self.job.reach.is_empty() {
            match self.reach(sequence)? {
                Verdict::Found(posed) => poses.push(posed),
                Verdict::No(unposed) => return Ok(Verdict::No(unposed)),
            }
        }
        if let Some(file) = pose_file(self.job)? {
            let state = file.state(self.network, &self.joints)?;
            match self.way(&file.name, &state, sequence)? {
                Ok(posed) => poses.push(posed),
                Err(why) => return Ok(Verdict::No(Unposed::barred(&file.name, &why))),
            }
        }
        Ok(Verdict::Found(poses))
    }

    /// Returns the places that the job wants.
    pub fn targets(&self) -> Result<Vec<Target>, TelescopeRunError> {
        let known = || self.tips.iter().filter_map(|names| names.first()).cloned();
        let mut targets: Vec<Target> = Vec::new();
        for reach in &self.job.reach {
            let is_named = |names: &Vec<String>| names.contains(&reach.tip);
            let Some(limb) = self.tips.iter().position(is_named) else {
                return Err(TelescopeRunError::NoTip {
                    tip: reach.tip.clone(),
                    known: known().collect(),
                });
            };
            if targets.iter().any(|target| target.limb == limb) {
                return Err(TelescopeRunError::TipTwice(reach.tip.clone()));
            }
            targets.push(Target {
                limb,
                place: Point::from(reach.place),
            });
        }
        Ok(targets)
    }

    fn reach(&self, sequence: &Sequence) -> Result<Verdict<Posed, Unposed>, TelescopeRunError> {
        let targets = self.targets()?;
        let found = self.network.reach(&targets);
        let near = |reached: &&Reached| reached.off_mm <= REACH_LIMIT_MM;
        let mut barred = None;
        for reached in found.iter().filter(near).take(MOST_WAYS) {
            match self.way(REACH, &reached.state, sequence)? {
                Ok(posed) => return Ok(Verdict::Found(self.wanting(posed, &targets))),
                Err(why) => barred = barred.or(Some(why)),
            }
        }
        if let Some(why) = barred {
            return Ok(Verdict::No(Unposed::barred(REACH, &why)));
        }
        Ok(Verdict::No(self.unreached(&targets, &found, sequence)?))
    }

    /// Returns a pose with the places that its tips were to reach.
    fn wanting(&self, posed: Posed, targets: &[Target]) -> Posed {
        let tips = posed.tips.into_iter().map(|tip| {
            let target = targets.iter().find(|target| target.limb == tip.limb);
            PosedTip {
                wanted: target.map(|target| target.place),
                ..tip
            }
        });
        Posed {
            tips: tips.collect(),
            ..posed
        }
    }

    /// Returns the way to a state, or says what is hit.
    pub fn way(
        &self,
        name: &str,
        state: &[Key],
        sequence: &Sequence,
    ) -> Result<Result<Posed, String>, TelescopeRunError> {
        self.watch.check()?;
        let mut ways: Vec<Opening> = Vec::new();
        for (limb, to) in self.network.limbs.iter().zip(state) {
            let way = match *to == limb.telescope.open() {
                true => limb.opening.clone(),
                false => match limb.telescope.find_way(to) {
                    Ok(way) => way,
                    Err(hit) => {
                        let [a, b] = hit.shells.map(|shell| shell + 1);
                        let place = match limb.id.as_str() {
                            "" => String::new(),
                            id => format!(" of limb {id}"),
                        };
                        return Ok(Err(format!(
                            "shells {a} and {b}{place} run into each other, by {:.1} mm at the \
                             deepest",
                            hit.depth_mm
                        )));
                    }
                },
            };
            ways.push(way);
        }
        let keys: Vec<&[Key]> = ways.iter().map(|way| &way.keys[..]).collect();
        let limbs = match sequence(&keys)? {
            Ok(limbs) => limbs,
            Err(why) => return Ok(Err(why)),
        };
        Ok(Ok(self.posed(name, &ways, &limbs)))
    }

    fn posed(&self, name: &str, ways: &[Opening], limbs: &[usize]) -> Posed {
        let mut state = self.network.closed();
        let closed = state.clone();
        let mut keys = vec![state.clone()];
        for limb in limbs {
            for key in ways[*limb].keys.iter().skip(1) {
                state[*limb].clone_from(key);
                keys.push(state.clone());
            }
        }
        let turns = limbs.iter().flat_map(|limb| {
            let groups = ways[*limb].order.groups().iter().flatten();
            groups.map(move |joint| [*limb, *joint])
        });
        let moved = turns.filter(|[limb, joint]| state[*limb][*joint] != closed[*limb][*joint]);
        let gaps = ways.iter().map(|way| way.least.gap_mm);
        let least = gaps.fold(f64::INFINITY, f64::min);
        let ends = self.network.ends(&state);
        let tips = ends
            .into_iter()
            .enumerate()
            .map(|(limb, reached)| PosedTip {
                id: self.tips[limb].first().cloned().unwrap_or_default(),
                limb,
                wanted: None,
                reached,
            });
        Posed {
            name: name.to_owned(),
            moved: moved.collect(),
            least_gap_mm: least.is_finite().then_some(least),
            tips: tips.collect(),
            keys,
        }
    }
}
