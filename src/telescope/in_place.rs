//! Shells that are printed in each other, in one go: rings hold them where others have caps.

use super::balance::DiscFoot;
use super::error::TelescopeError;
use super::nest::Telescope;
use super::parts::{BEYOND_MM, body};
use super::profile::Profile;
use super::sizes::{JointSizes, Tails};
use super::sweep::sweep_profile;
use crate::curve::Helix;
use crate::geom::{Frame, Matrix};
use crate::mesh::{ClipError, Csg, Solid};

/// Share of a body's radius that the radius of a hole for powder may have: the tube stays stiff.
const MOST_VENT_RATIO: f64 = 0.5;

/// The hole through both sides of a shell, through which powder leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vent {
    /// The arc of its axis along the shell, mm from the start of its visible part. The axis is the
    /// binormal there.
    pub arc_mm: f64,
    /// Its radius, mm.
    pub radius_mm: f64,
}

impl JointSizes {
    /// Returns the height of the cone at the tail of a shell that is printed in place, mm.
    ///
    /// It is of 45° and stands with a clearance square to it on the ring of the shell before. The
    /// ring leaves the lip's radius open, so it holds by the engagement. `bend_ratio` is curvature
    /// times the bore's radius. On the inside of a bend lengths shrink by it, so that a cone is
    /// steeper there and must be moved by more.
    pub fn tail_cone_mm(&self, bend_ratio: f64) -> f64 {
        let shrunk = 1.0 - bend_ratio;
        let apart_mm = self.slide_mm * shrunk.hypot(1.0) / shrunk;
        self.engagement_mm + self.chamfer_mm + apart_mm
    }
}

impl Telescope {
    /// Returns the solid of a shell that is printed in the one before it, in the shell's frame.
    /// Shells are counted from 0.
    ///
    /// It is closed behind by a ring, the last by a disc. All tails lie in one plane, and all gaps
    /// between shells that are all in are as wide as the clearance. The root has the foot, if any.
    pub fn nested_solid(
        &self,
        shell: usize,
        foot: Option<&DiscFoot>,
    ) -> Result<Solid, TelescopeError> {
        let make = || -> Result<Solid, ClipError> {
            let helix = &self.shells[shell].helix;
            let profile = self.nested_profile(shell);
            let mut whole = body(sweep_profile(&Frame::identity(), helix, &profile))?;
            if let Some(foot) = foot.filter(|_| shell == 0) {
                whole = whole.union(&self.foot_around(foot)?)?;
            }
            whole = whole.subtract(&self.nested_cavity(shell)?)?;
            if let Some(joint) = self.outer_joint(shell) {
                whole = whole.subtract(&self.flange_gap(helix, joint)?)?;
            }
            if let Some(vent) = self.vent_of(shell) {
                whole = whole.subtract(&self.vent_through(shell, &vent)?)?;
            }
            whole.to_solid()
        };
        make().map_err(|error| self.fault(shell, error))
    }

    /// Returns the hole through which powder leaves a shell, if it has one. Shells are counted from
    /// 0.
    pub fn vent_of(&self, shell: usize) -> Option<Vent> {
        let Tails::InPlace { vent_mm } = self.sizes.tails else {
            return None;
        };
        self.joints.get(shell)?;
        let most_mm = MOST_VENT_RATIO * self.shells[shell].body_mm;
        Some(Vent {
            arc_mm: 0.5 * self.visible_mm,
            radius_mm: (0.5 * vent_mm?).min(most_mm),
        })
    }

    /// Returns the profile of a shell outside, from its tail to its mouth.
    fn nested_profile(&self, shell: usize) -> Profile {
        let [tail, _] = self.ends_mm();
        let ahead = self.outer_profile(shell);
        let behind = match self.outer_joint(shell) {
            Some(joint) => {
                let bend_ratio = self.shells[shell].helix.curvature * joint.radii.bore_mm;
                let cone_mm = self.sizes.tail_cone_mm(bend_ratio);
                let flange_mm = joint.radii.flange_mm;
                [[tail, flange_mm - cone_mm], [tail + cone_mm, flange_mm]]
            }
            None => {
                let (body_mm, chamfer_mm) = (self.shells[shell].body_mm, self.sizes.chamfer_mm);
                [[tail, body_mm - chamfer_mm], [tail + chamfer_mm, body_mm]]
            }
        };
        Profile::new(behind.into_iter().chain(ahead.corners().iter().copied()))
    }

    /// Returns the cavity: that of a capped shell, but for its end at the tail.
    fn nested_cavity(&self, shell: usize) -> Result<Csg, ClipError> {
        let inside = self.inside(shell);
        let tail = self.ends_mm()[0] - self.visible_mm;
        let ahead = self.cavity_profile(shell);
        let ahead = ahead.corners().iter().copied().skip(1);
        let chamfer = self.sizes.chamfer_mm;
        let behind = match self.joints.get(shell) {
            Some(joint) => {
                let (lip, bore) = (joint.radii.lip_mm, joint.radii.bore_mm);
                vec![
                    [tail - BEYOND_MM, lip + chamfer + BEYOND_MM],
                    [tail + chamfer, lip],
                    [tail + chamfer + bore - lip, bore],
                ]
            }
            // The last shell holds nothing: a disc closes it.
            None => vec![[self.face_mm() - self.visible_mm, inside.bore_mm]],
        };
        let profile = Profile::new(behind.into_iter().chain(ahead));
        let bore = body(sweep_profile(&inside.pivot, &inside.helix, &profile))?;
        match self.joints.get(shell) {
            Some(_) => bore.subtract(&self.stop_rib(&inside)?),
            None => Ok(bore),
        }
    }

    /// Returns a foot around the root's tail. Its lower face lies in the plane of all tails.
    fn foot_around(&self, foot: &DiscFoot) -> Result<Csg, ClipError> {
        let tail = self.shells[0].helix.frame_at(self.ends_mm()[0]);
        let disc = Profile::disc([0.0, foot.height_mm], foot.radius_mm, self.sizes.chamfer_mm);
        body(sweep_profile(&tail, &Helix::LINE, &disc))
    }

    fn vent_through(&self, shell: usize, vent: &Vent) -> Result<Csg, ClipError> {
        let own = &self.shells[shell];
        let middle = own.helix.frame_at(vent.arc_mm);
        let [tangent, normal, binormal] = [0, 1, 2].map(|i| middle.axes.column(i).into_owned());
        // A sweep along a line follows the first axis.
        let across = Frame {
            origin: middle.origin,
            axes: Matrix::from_columns(&[binormal, tangent, normal]),
        };
        let reach = own.body_mm + BEYOND_MM;
        let hole = Profile::new([[-reach, vent.radius_mm], [reach, vent.radius_mm]]);
        body(sweep_profile(&across, &Helix::LINE, &hole))
    }
}
