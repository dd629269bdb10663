//! Shells that nest: from a chain of helices to bodies and joints.

use std::f64::consts::{PI, TAU};

use super::error::TelescopeError;
use super::fastened::Fastened;
use super::fits::{axis_excess_mm, turning_offset_mm};
use super::sizes::{JointSizes, Radii, SEAT_ROOM_MM};
use crate::curve::{Chain, Helix, roll};
use crate::geom::Frame;

/// The greatest product of curvature and radius of a tube. At one its inner side has no length.
const MAX_BEND_RATIO: f64 = 0.8;

/// The offset of a turn up to which it parts nothing, mm: rounding.
const NO_OFFSET_MM: f64 = 1e-9;

/// Least angle of flange that is left beside a twist stop, rad: a third of the circle.
const LEAST_FLANGE_RAD: f64 = TAU / 3.0;

/// A shell: a tube about a helix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shell {
    /// The helix of its centre line, from the start of its visible part.
    pub helix: Helix,
    /// The radius of its body, mm.
    pub body_mm: f64,
}

/// The joint in which a shell slides in the one before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// The turn when all out, rad.
    pub turn_rad: f64,
    /// The radii about the inner shell's helix.
    pub radii: Radii,
    /// Clearance of the seat when all out, mm.
    pub seat_mm: f64,
    /// How far the stop is beyond the visible length, mm. A turned flange is out of the middle,
    /// so its cone meets the lip's earlier.
    pub stop_room_mm: f64,
    /// By how much the cavity is out of the outer shell's axis, mm: its wall is thicker by this.
    pub excess_mm: f64,
    /// Angle β of the twist rib, rad.
    pub rib_rad: f64,
    /// Angular play c of the twist stop, rad: the clearance at the edge of the rib.
    pub play_rad: f64,
}

/// The state of a joint: how far its shell is out, and how far it is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointState {
    /// The slide, mm: the visible length if all out.
    pub slide_mm: f64,
    /// The turn, rad: zero unless all out.
    pub turn_rad: f64,
}

/// Nested shells, the root first.
#[derive(Debug, Clone, PartialEq)]
pub struct Telescope {
    /// The frame at the start of the root.
    pub start: Frame,
    /// The visible length of every shell, mm.
    pub visible_mm: f64,
    /// The shells.
    pub shells: Vec<Shell>,
    /// The joint before each shell but the root.
    pub joints: Vec<Joint>,
    /// The measures of the joints.
    pub sizes: JointSizes,
    /// The ends that are fastened to other bodies.
    pub fastened: Fastened,
}

impl Telescope {
    /// Nests the pieces of a chain, the first of which is the root. `tip_mm` is the body radius of
    /// the last.
    ///
    /// Each body is the least that leaves the wall around the cavity of the next.
    pub fn nest(chain: &Chain, tip_mm: f64, sizes: &JointSizes) -> Result<Self, TelescopeError> {
        sizes.check()?;
        check_chain(chain, tip_mm, sizes)?;
        let last = chain.pieces.len() - 1;
        let mut body_mm = tip_mm;
        let mut shells = vec![shell(last, chain, body_mm)?];
        let mut joints = Vec::new();
        for inner in (1..=last).rev() {
            let joint = joint(chain, inner, body_mm, sizes)?;
            body_mm = joint.radii.bore_mm + joint.excess_mm + sizes.wall_mm;
            shells.push(shell(inner - 1, chain, body_mm)?);
            joints.push(joint);
        }
        shells.reverse();
        joints.reverse();
        Ok(Self {
            start: chain.start,
            visible_mm: chain.piece_mm,
            shells,
            joints,
            sizes: *sizes,
            fastened: Fastened::default(),
        })
    }

    /// Returns the arcs of a shell's tail and mouth, mm from the start of its visible part. Half of
    /// the overlap lies beyond it on either side, so the pivot of a joint is in the middle.
    pub fn ends_mm(&self) -> [f64; 2] {
        let half = 0.5 * self.sizes.overlap_mm();
        [-half, self.visible_mm + half]
    }

    /// Returns the frame of a shell in that of the shell before it. Shells are counted from 0.
    ///
    /// It is H(l) of the outer helix, then the turn, then H(u − l) of the inner one.
    pub fn step(&self, joint: usize, state: &JointState) -> Frame {
        let (outer, inner) = (&self.shells[joint].helix, &self.shells[joint + 1].helix);
        let pivot = outer.frame_at(self.visible_mm);
        let turned = pivot.frame_to_model(&roll(state.turn_rad));
        turned.frame_to_model(&inner.frame_at(state.slide_mm - self.visible_mm))
    }

    /// Returns the frames of all shells in a state of their joints.
    pub fn frames(&self, states: &[JointState]) -> Vec<Frame> {
        let steps = states.iter().take(self.joints.len()).enumerate();
        let mut frames = vec![self.start];
        let mut frame = self.start;
        for (joint, state) in steps {
            frame = frame.frame_to_model(&self.step(joint, state));
            frames.push(frame);
        }
        frames
    }

    /// Returns the state with all shells in.
    pub fn closed(&self) -> Vec<JointState> {
        let closed = JointState {
            slide_mm: self.sizes.closed_mm(),
            turn_rad: 0.0,
        };
        vec![closed; self.joints.len()]
    }

    /// Returns the state with all shells out and turned.
    pub fn open(&self) -> Vec<JointState> {
        let open = |joint: &Joint| JointState {
            slide_mm: self.visible_mm,
            turn_rad: joint.turn_rad,
        };
        self.joints.iter().map(open).collect()
    }
}

fn check_chain(chain: &Chain, tip_mm: f64, sizes: &JointSizes) -> Result<(), TelescopeError> {
    let (pieces, turns) = (chain.pieces.len(), chain.turns_rad.len());
    if pieces == 0 || turns + 1 != pieces {
        return Err(TelescopeError::Chain { pieces, turns });
    }
    let least_mm = 2.0 * sizes.wall_mm;
    if !(tip_mm.is_finite() && tip_mm >= least_mm) {
        return Err(TelescopeError::Size {
            measure: "radius of the tip",
            value_mm: tip_mm,
            range: "at least two walls",
        });
    }
    let (stroke_mm, closed_mm) = (chain.piece_mm, sizes.closed_mm());
    if stroke_mm.is_finite() && stroke_mm > closed_mm + sizes.overlap_mm() {
        return Ok(());
    }
    Err(TelescopeError::NoStroke {
        stroke_mm,
        closed_mm,
    })
}

/// Returns a shell of a body radius, unless it cannot bend so.
fn shell(index: usize, chain: &Chain, body_mm: f64) -> Result<Shell, TelescopeError> {
    let helix = chain.pieces[index];
    check_bend(index + 1, &helix, body_mm)?;
    let bend_rad = helix.curvature * chain.piece_mm;
    if bend_rad > PI {
        return Err(TelescopeError::TurnsTooFar {
            shell: index + 1,
            bend_deg: bend_rad.to_degrees(),
        });
    }
    Ok(Shell { helix, body_mm })
}

fn check_bend(shell: usize, helix: &Helix, radius_mm: f64) -> Result<(), TelescopeError> {
    if helix.curvature * radius_mm <= MAX_BEND_RATIO {
        return Ok(());
    }
    Err(TelescopeError::TooThick {
        shell,
        radius_mm,
        bend_mm: 1.0 / helix.curvature,
    })
}

/// Returns the joint in which a shell of this body slides.
fn joint(
    chain: &Chain,
    inner: usize,
    body_mm: f64,
    sizes: &JointSizes,
) -> Result<Joint, TelescopeError> {
    let radii = sizes.radii(body_mm);
    let (parent, child) = (&chain.pieces[inner - 1], &chain.pieces[inner]);
    check_bend(inner + 1, child, radii.bore_mm)?;
    let short = sizes.short_flange(child.curvature * radii.bore_mm);
    if let Some((measure, value_mm, range)) = short {
        return Err(TelescopeError::Size {
            measure,
            value_mm,
            range,
        });
    }
    let half = 0.5 * sizes.overlap_mm();
    let arcs_mm = [-chain.piece_mm - half, half];
    let turn_rad = chain.turns_rad[inner - 1];
    let offset_mm = turning_offset_mm(child, sizes.overlap_mm(), turn_rad);
    let is_parted = offset_mm > NO_OFFSET_MM;
    let joint = Joint {
        turn_rad,
        radii,
        seat_mm: seat_mm(inner, turn_rad, offset_mm, sizes)?,
        stop_room_mm: if is_parted {
            offset_mm + SEAT_ROOM_MM
        } else {
            0.0
        },
        excess_mm: axis_excess_mm(parent, child, radii.bore_mm, arcs_mm),
        rib_rad: sizes.feature_mm / radii.lip_mm,
        play_rad: sizes.slide_mm / radii.lip_mm,
    };
    let left = TAU - joint.turn_rad.abs() - joint.rib_rad - 2.0 * joint.play_rad;
    if left >= LEAST_FLANGE_RAD {
        return Ok(joint);
    }
    Err(TelescopeError::FlangeTooShort {
        shell: inner + 1,
        flange_deg: left.to_degrees(),
    })
}

/// Returns the clearance of the seat: that of the press ring, or more if the turn takes more.
fn seat_mm(
    inner: usize,
    turn_rad: f64,
    offset_mm: f64,
    sizes: &JointSizes,
) -> Result<f64, TelescopeError> {
    let needed_mm = offset_mm + SEAT_ROOM_MM;
    if offset_mm <= NO_OFFSET_MM || needed_mm <= sizes.slide_mm {
        let taken_mm = if offset_mm <= NO_OFFSET_MM {
            0.0
        } else {
            needed_mm
        };
        return Ok(sizes.seat_mm.max(taken_mm));
    }
    Err(TelescopeError::TurnTooGreat {
        shell: inner + 1,
        turn_deg: turn_rad.to_degrees(),
        offset_mm,
        clearance_mm: sizes.slide_mm,
    })
}
