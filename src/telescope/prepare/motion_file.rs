//! The motion of a telescope as it is written.

use super::made::Made;
use crate::geom::Frame;
use crate::telescope::motion::Key;
use crate::telescope::nest::{JointState, Telescope};
use crate::verify::{JointMotion, MotionKey, Pose, ShellMotion, TelescopeMotion};

/// The schema of `motion.json`.
pub const MOTION_SCHEMA: u32 = 1;

impl Made {
    /// Returns the id of a shell, from 0.
    pub fn shell_id(&self, shell: usize) -> String {
        format!("{}S{:02}", self.prefix, shell + 1)
    }

    /// Returns the id of a joint, from 0.
    pub fn joint_id(&self, joint: usize) -> String {
        format!("{}J{:02}", self.prefix, joint + 1)
    }
}

/// Returns the motion as it is written.
pub fn motion(made: &Made) -> TelescopeMotion {
    let telescope = &made.best.design.telescope;
    let opening = &made.best.design.opening;
    let ends_mm = telescope.ends_mm();
    let shells = telescope.shells.iter().enumerate();
    let joints = telescope.joints.iter().enumerate();
    let ids = |group: &Vec<usize>| group.iter().map(|joint| made.joint_id(*joint)).collect();
    TelescopeMotion {
        schema: MOTION_SCHEMA,
        root: pose_of(&telescope.start),
        shells: shells
            .map(|(i, shell)| ShellMotion {
                id: made.shell_id(i),
                curvature: shell.helix.curvature,
                torsion: shell.helix.torsion,
                length_mm: telescope.visible_mm,
                ends_mm,
            })
            .collect(),
        joints: joints
            .map(|(i, joint)| JointMotion {
                id: made.joint_id(i),
                closed_mm: telescope.sizes.closed_mm(),
                open_mm: telescope.visible_mm,
                turn_rad: joint.turn_rad,
            })
            .collect(),
        order: opening.order.groups().iter().map(ids).collect(),
        keys: opening
            .keys
            .iter()
            .map(|key| written_key(telescope, key))
            .collect(),
        poses: Vec::new(),
    }
}

fn written_key(telescope: &Telescope, key: &Key) -> MotionKey {
    let state = |state: &JointState| [state.slide_mm, state.turn_rad];
    MotionKey {
        states: key.iter().map(state).collect(),
        placements: telescope.frames(key).iter().map(pose_of).collect(),
    }
}

/// Returns a frame as the matrix from its coordinates to the model's.
pub fn pose_of(frame: &Frame) -> Pose {
    Pose::new(&frame.axes, &frame.origin.coords)
}
