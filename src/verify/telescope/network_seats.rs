//! The seats of telescopes in junctures: roots in sockets, pegs in mouths, each one way only.

use nalgebra::Rotation3;

use super::contact::{Body, seen_from};
use super::motion::{TelescopeMotion, frame_of};
use crate::geom::{Frame, Point, Vector};

/// By how much a gap may be below that of the glue, mm: facets of both sides.
const GAP_LIMIT_MM: f64 = 0.02;
/// Angle by which a root or a peg is turned to see that it fits one way only, rad.
const TURNED_RAD: f64 = 0.35;
/// By how much a peg is drawn out, so that its body leaves the rim of the mouth, mm.
const DRAWN_MM: f64 = 0.1;
/// By how much a body that rests on a rim must be pushed to reach into it, mm.
const PUSHED_MM: f64 = 0.05;

/// A telescope with the junctures at both of its ends, all where they are when all is out.
pub(super) struct Seats<'a> {
    pub id: &'a str,
    pub motion: &'a TelescopeMotion,
    /// Every shell with its cap, in the shell's frame.
    pub shells: &'a [Body],
    pub from: &'a Body,
    pub to: &'a Body,
    /// Clearance of the glue, mm.
    pub glue_mm: f64,
}

impl Seats<'_> {
    /// Returns the faults, in words.
    pub fn faults(&self) -> Vec<String> {
        let root = frame_of(&self.motion.root);
        let id = self.id;
        let least_mm = self.glue_mm - GAP_LIMIT_MM;
        let mut faults = Vec::new();
        let first = &self.shells[0];
        if self.from.is_nearer(first, &root, least_mm) {
            faults.push(format!("the root of {id} has too little room for glue"));
        }
        let tail = self.motion.shells[0].along(self.motion.shells[0].ends_mm[0]);
        let turned = [-TURNED_RAD, TURNED_RAD].map(|turn| {
            let turned = about(&tail, turn);
            self.from.touches(first, &root.frame_to_model(&turned))
        });
        if turned != [true; 2] {
            faults.push(format!("the root of {id} can be turned in its socket"));
        }
        faults.extend(self.peg_faults());
        faults
    }

    fn peg_faults(&self) -> Vec<String> {
        let open = self.motion.joints.iter();
        let open: Vec<[f64; 2]> = open.map(|joint| [joint.open_mm, joint.turn_rad]).collect();
        let frames = self.motion.frames(&open);
        let (Some(last), Some(shell), Some(own)) =
            (frames.last(), self.shells.last(), self.motion.shells.last())
        else {
            return Vec::new();
        };
        let mouth = own.along(own.ends_mm[1]);
        // The shell is moved, and the juncture is at rest.
        let is_met = |motion: &Frame, limit_mm: f64| {
            let placed = last.frame_to_model(motion);
            let placed = seen_from(&Frame::identity(), &placed);
            self.to.is_nearer(shell, &placed, limit_mm)
        };
        let least_mm = (self.glue_mm - GAP_LIMIT_MM).min(DRAWN_MM - GAP_LIMIT_MM);
        let id = self.id;
        let mut faults = Vec::new();
        if is_met(&along(&mouth, -DRAWN_MM), least_mm) {
            faults.push(format!(
                "the peg in the mouth of {id} has too little room for glue"
            ));
        }
        if !is_met(&along(&mouth, PUSHED_MM), PUSHED_MM * 0.1) {
            faults.push(format!("the juncture on {id} does not rest on its mouth"));
        }
        let turned = [-TURNED_RAD, TURNED_RAD].map(|turn| {
            let back = along(&mouth, -DRAWN_MM);
            is_met(&back.frame_to_model(&about(&mouth, turn)), DRAWN_MM * 0.1)
        });
        if turned != [true; 2] {
            faults.push(format!("the juncture on {id} can be turned in its mouth"));
        }
        faults
    }
}

/// Returns the motion of a shell along the tangent at a frame of its own.
fn along(frame: &Frame, way_mm: f64) -> Frame {
    let ahead: Vector = frame.axes.column(0).into();
    Frame {
        origin: Point::from(ahead * way_mm),
        ..Frame::identity()
    }
}

/// Returns the motion that turns a shell about the tangent at a frame of its own.
fn about(frame: &Frame, turn_rad: f64) -> Frame {
    let turn = Frame {
        origin: Point::origin(),
        axes: Rotation3::from_scaled_axis(Vector::x() * turn_rad).into_inner(),
    };
    frame.frame_to_model(&turn).frame_to_model(&frame.inverse())
}
