//! The motion of a telescope as `motion.json` holds it, and the judge's own screws.

use nalgebra::Rotation3;
use serde::{Deserialize, Serialize};

use super::pose::PoseMotion;
use crate::geom::{Frame, Matrix, Point, Vector};
use crate::verify::Pose;

/// The rate of turning below which a screw is a plain slide, 1/mm.
const STRAIGHT: f64 = 1e-12;

/// The motion of a telescope: `motion.json`. Lengths in mm, angles in radians.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TelescopeMotion {
    /// The version of the keys.
    pub schema: u32,
    /// The frame of the first shell in the model frame, by rows.
    pub root: Pose,
    /// The shells, the root first.
    pub shells: Vec<ShellMotion>,
    /// The joint before each shell but the root.
    pub joints: Vec<JointMotion>,
    /// The joints that move in turn, by their ids.
    pub order: Vec<Vec<String>>,
    /// The states between moves, from all in to all out.
    pub keys: Vec<MotionKey>,
    /// The poses; those of several telescopes stand beside their keys.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<PoseMotion>,
}

/// A shell: a tube about a helix from the start of its visible part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ShellMotion {
    /// Its id.
    pub id: String,
    /// Curvature of its centre line, 1/mm.
    pub curvature: f64,
    /// Torsion of its centre line, 1/mm.
    pub torsion: f64,
    /// Its visible length, mm.
    pub length_mm: f64,
    /// The arcs of its tail and mouth from the start of its visible part, mm.
    pub ends_mm: [f64; 2],
}

/// A joint: the inner shell slides along its own helix, then turns about the tangent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointMotion {
    /// Its id.
    pub id: String,
    /// The slide with the shell all in, mm.
    pub closed_mm: f64,
    /// The slide with the shell all out, mm.
    pub open_mm: f64,
    /// The turn when all out, rad.
    pub turn_rad: f64,
}

/// A state of all joints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionKey {
    /// Slide (mm) and turn (rad) of every joint.
    pub states: Vec<[f64; 2]>,
    /// The frame of every shell in the model frame, by rows.
    pub placements: Vec<Pose>,
}

/// Difference of slides (mm) and turns (rad) in keys that is the rounding of files.
const KEY_LIMIT: f64 = 1e-6;

impl TelescopeMotion {
    /// Returns whether states begin with all joints in, and end with all out.
    pub(super) fn opens(&self, first: &[[f64; 2]], last: &[[f64; 2]]) -> bool {
        let is_at = |state: &[[f64; 2]], wanted: fn(&JointMotion) -> [f64; 2]| {
            let wanted = self.joints.iter().map(wanted);
            let mut off = state
                .iter()
                .zip(wanted)
                .flat_map(|([slide, turn], wanted)| [slide - wanted[0], turn - wanted[1]]);
            state.len() == self.joints.len() && off.all(|off| off.abs() <= KEY_LIMIT)
        };
        is_at(first, |joint| [joint.closed_mm, 0.0])
            && is_at(last, |joint| [joint.open_mm, joint.turn_rad])
    }

    /// Returns the frames of all shells in a state, by the judge's own screws.
    pub(super) fn frames(&self, states: &[[f64; 2]]) -> Vec<Frame> {
        let mut frame = frame_of(&self.root);
        let mut frames = vec![frame];
        for (joint, state) in states.iter().enumerate().take(self.joints.len()) {
            frame = frame.frame_to_model(&self.step(joint, *state));
            frames.push(frame);
        }
        frames
    }

    /// Returns the frame of a joint's inner shell in that of its outer shell.
    pub(super) fn step(&self, joint: usize, [slide_mm, turn_rad]: [f64; 2]) -> Frame {
        let (outer, inner) = (&self.shells[joint], &self.shells[joint + 1]);
        let turn = Frame {
            origin: Point::origin(),
            axes: Rotation3::from_scaled_axis(Vector::x() * turn_rad).into_inner(),
        };
        let pivot = outer.along(outer.length_mm).frame_to_model(&turn);
        pivot.frame_to_model(&inner.along(slide_mm - inner.length_mm))
    }

    /// Returns points of the centre line of what shows, at equal arcs: `steps` for each shell.
    pub(super) fn centre_line(&self, states: &[[f64; 2]], steps: usize) -> Vec<Point> {
        let frames = self.frames(states);
        let shells = self.shells.iter().zip(&frames);
        let points = shells.flat_map(|(shell, frame)| {
            let at = move |i: usize| shell.length_mm * i as f64 / steps as f64;
            (1..=steps).map(move |i| frame.frame_to_model(&shell.along(at(i))).origin)
        });
        let first = frames.first().map(|frame| frame.origin);
        first.into_iter().chain(points).collect()
    }
}

impl ShellMotion {
    /// Returns the frame at an arc of the shell's helix, in the shell's frame: a screw about the
    /// axis of the helix (Chasles).
    pub(super) fn along(&self, arc_mm: f64) -> Frame {
        let rate = Vector::new(self.torsion, 0.0, self.curvature);
        let square = rate.norm_squared();
        if square < STRAIGHT * STRAIGHT {
            return Frame {
                origin: Point::new(arc_mm, 0.0, 0.0),
                axes: Matrix::identity(),
            };
        }
        let axes = Rotation3::from_scaled_axis(rate * arc_mm).into_inner();
        // The point of the axis nearest to the start, and the rise along the axis for each mm.
        let on_axis = rate.cross(&Vector::x()) / square;
        let rise = rate * (rate.x / square);
        Frame {
            origin: Point::from(on_axis - axes * on_axis + rise * arc_mm),
            axes,
        }
    }
}

/// Returns a pose as a frame: the matrix maps the frame's coordinates to the model's.
pub(super) fn frame_of(pose: &Pose) -> Frame {
    Frame {
        origin: Point::from(pose.translation()),
        axes: pose.rotation(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(curvature: f64, torsion: f64) -> ShellMotion {
        ShellMotion {
            id: "S01".to_owned(),
            curvature,
            torsion,
            length_mm: 40.0,
            ends_mm: [-3.0, 43.0],
        }
    }

    #[test]
    fn a_screw_along_a_helix_is_that_of_the_reference() {
        let frame = shell(0.02, 0.01).along(150.0);
        let point = Vector::new(22.454132, 79.100190, 63.772934);
        let tangent = Vector::new(-0.582004, -0.188647, 0.791002);
        assert!((frame.origin.coords - point).norm() < 1e-6);
        assert!((frame.axes.column(0) - tangent).norm() < 1e-6);
        let line = shell(0.0, 0.0).along(-7.0);
        assert_eq!(line.origin, Point::new(-7.0, 0.0, 0.0));
        // A torsion without curvature turns about a straight line.
        let twisted = shell(0.0, 0.01).along(50.0);
        assert!((twisted.origin - Point::new(50.0, 0.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn a_joint_that_is_all_out_goes_on_from_the_mouth_of_the_shell_before_it() {
        let motion = TelescopeMotion {
            schema: 1,
            root: Pose::identity(),
            shells: vec![shell(0.02, 0.0), shell(0.01, 0.005)],
            joints: vec![JointMotion {
                id: "J01".to_owned(),
                closed_mm: 6.0,
                open_mm: 40.0,
                turn_rad: 0.5,
            }],
            order: Vec::new(),
            poses: Vec::new(),
            keys: Vec::new(),
        };
        let end = motion.shells[0].along(40.0);
        let open = motion.step(0, [40.0, 0.5]);
        assert!((open.origin - end.origin).norm() < 1e-12);
        assert!((open.axes.column(0) - end.axes.column(0)).norm() < 1e-12);
        assert!((open.axes.column(2).dot(&end.axes.column(2)) - 0.5f64.cos()).abs() < 1e-12);
        assert_eq!(motion.centre_line(&[[40.0, 0.5]], 10).len(), 21);
    }
}
