//! Poses as they are written: in the motion, on the sheet, as files.

use super::motion_file::pose_of;
use super::moving::written;
use super::posing::{ChainPoses, Posed, PosedTip};
use crate::sheet::pose::{PoseJointRow, PoseRow};
use crate::telescope::network::Network;
use crate::telescope::pose_file::{PoseLine, pose_text};
use crate::verify::{PoseMotion, PoseTipPromise};

/// Poses that are written.
pub struct Poses<'a> {
    pub network: &'a Network,
    /// The ids of the joints of every limb.
    pub joints: &'a [Vec<String>],
    pub posed: &'a [Posed],
}

impl Poses<'_> {
    /// Returns the poses as `motion.json` holds them.
    pub fn motions(&self) -> Vec<PoseMotion> {
        self.posed.iter().map(|posed| self.motion(posed)).collect()
    }

    /// Returns the poses as the sheet shows them.
    pub fn rows(&self) -> Vec<PoseRow> {
        self.posed.iter().map(|posed| self.row(posed)).collect()
    }

    /// Returns the file of every pose and its text.
    pub fn files(&self) -> Vec<(String, String)> {
        self.posed.iter().map(|posed| self.file(posed)).collect()
    }

    fn motion(&self, posed: &Posed) -> PoseMotion {
        let last = posed.keys.last().map(|key| self.network.frames(key));
        let shells = last.map_or_else(Vec::new, |frames| frames.shells);
        PoseMotion {
            name: posed.name.clone(),
            keys: posed.keys.iter().map(|key| written(key)).collect(),
            shells: shells
                .iter()
                .map(|frames| frames.iter().map(pose_of).collect())
                .collect(),
        }
    }

    fn row(&self, posed: &Posed) -> PoseRow {
        let off = posed.tips.iter().filter_map(PosedTip::off_mm);
        let joint = |[limb, joint]: &[usize; 2]| {
            let line = self.line(posed, [*limb, *joint]);
            PoseJointRow {
                id: line.id,
                stroke_mm: line.stroke_mm,
                whole_mm: line.whole_mm,
                turn_deg: line.turn_deg,
            }
        };
        PoseRow {
            name: posed.name.clone(),
            file: file_of(&posed.name),
            tips: posed.tips.iter().map(PosedTip::promise).collect(),
            off_mm: off.reduce(f64::max),
            joints: posed.moved.iter().map(joint).collect(),
            least_gap_mm: posed.least_gap_mm,
        }
    }

    fn file(&self, posed: &Posed) -> (String, String) {
        let limbs = self.joints.iter().enumerate();
        let joints = limbs.flat_map(|(limb, ids)| (0..ids.len()).map(move |joint| [limb, joint]));
        let lines: Vec<PoseLine> = joints.map(|place| self.line(posed, place)).collect();
        (file_of(&posed.name), pose_text(&posed.name, &lines))
    }

    fn line(&self, posed: &Posed, [limb, joint]: [usize; 2]) -> PoseLine {
        let telescope = &self.network.limbs[limb].telescope;
        let closed_mm = telescope.sizes.closed_mm();
        let last = posed.keys.last();
        let own = last.map_or(telescope.closed()[joint], |key| key[limb][joint]);
        PoseLine {
            id: self.joints[limb][joint].clone(),
            stroke_mm: own.slide_mm - closed_mm,
            whole_mm: telescope.visible_mm - closed_mm,
            turn_deg: own.turn_rad.to_degrees(),
            whole_deg: telescope.joints[joint].turn_rad.to_degrees(),
        }
    }
}

/// Returns the file of a pose in a kit.
fn file_of(name: &str) -> String {
    format!("poses/{name}.toml")
}

impl ChainPoses {
    /// Returns the poses as they are written.
    pub fn written(&self) -> Poses<'_> {
        Poses {
            network: &self.network,
            joints: &self.joints,
            posed: &self.posed,
        }
    }
}

impl PosedTip {
    /// Returns the distance from the wanted place, mm; `None` if none was wanted.
    pub fn off_mm(&self) -> Option<f64> {
        self.wanted.map(|wanted| (self.reached - wanted).norm())
    }

    fn promise(&self) -> PoseTipPromise {
        PoseTipPromise {
            id: self.id.clone(),
            limb: self.limb + 1,
            wanted_mm: self.wanted.map(Into::into),
            reached_mm: self.reached.into(),
        }
    }
}
