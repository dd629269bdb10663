//! The parts of a telescope: shells and their caps.

use super::balance::DiscFoot;
use super::error::TelescopeError;
use super::nest::{Joint, Telescope};
use super::profile::Profile;
use super::sweep::{Sector, sweep_profile, sweep_sector};
use crate::curve::Helix;
use crate::geom::{Frame, Plane};
use crate::mesh::{ClipError, Csg, MeshError, Solid, TriMesh};

/// By how much tools reach beyond what they cut, mm.
pub(super) const BEYOND_MM: f64 = 1.0;

/// By how much a spigot begins within its disc, as a share of the disc.
const ROOT_SHARE: f64 = 0.5;

/// Share of the clearance that is left on a body where its flange is cut away, so that faces do
/// not coincide.
const SKIN_SHARE: f64 = 0.01;

/// Distance of the way of a child from the spigot's face, as a share of the clearance.
/// The two faces must not coincide.
const SPIGOT_STEP_SHARE: f64 = 0.5;

/// What lies in a shell: the helix and the frame of its cavity, and the radii of its bore and lip.
pub(super) struct Inside {
    /// The helix of the shell itself.
    outer: Helix,
    pub helix: Helix,
    pub pivot: Frame,
    /// The joint of the shell that slides in it; `None` in the innermost.
    joint: Option<Joint>,
    pub bore_mm: f64,
    lip_mm: f64,
    /// The radius to which ribs reach inwards: the press ring passes them with the whole clearance.
    rib_mm: f64,
    rib_rad: f64,
}

impl Telescope {
    /// Returns the solid of a shell without its cap, in the shell's frame. Shells are counted
    /// from 0.
    ///
    /// It is a tube about its helix with flange and press ring outside. Inside is the cavity of the
    /// next shell, with lip and twist rib. The flange has a gap for the rib of the shell before.
    pub fn shell_solid(&self, shell: usize) -> Result<Solid, TelescopeError> {
        let make = || -> Result<Solid, ClipError> {
            let helix = &self.shells[shell].helix;
            let outside = sweep_profile(&Frame::identity(), helix, &self.outer_profile(shell));
            let hollow = body(outside)?.subtract(&self.cavity(shell)?)?;
            let shaped = match self.outer_joint(shell) {
                Some(joint) => hollow.subtract(&self.flange_gap(helix, joint)?)?,
                None => hollow,
            };
            shaped.to_solid()
        };
        make().map_err(|error| self.fault(shell, error))
    }

    /// Returns the solid of a shell's tail cap, in the shell's frame. Shells are counted from 0.
    ///
    /// It is a disc that carries the flange, a spigot with a slot that fits one way, and a vent.
    pub fn cap_solid(&self, shell: usize) -> Result<Solid, TelescopeError> {
        self.cap_on(shell, None)
    }

    /// Returns the solid of the root's tail cap with a foot on its tail, in the root's frame.
    pub fn foot_solid(&self, foot: &DiscFoot) -> Result<Solid, TelescopeError> {
        self.cap_on(0, Some(foot))
    }

    fn cap_on(&self, shell: usize, foot: Option<&DiscFoot>) -> Result<Solid, TelescopeError> {
        let make = || -> Result<Solid, ClipError> {
            let helix = &self.shells[shell].helix;
            let disc = sweep_profile(&Frame::identity(), helix, &self.disc_profile(shell));
            let disc = match self.outer_joint(shell) {
                Some(joint) => body(disc)?.subtract(&self.flange_gap(helix, joint)?)?,
                None => body(disc)?,
            };
            let inside = self.inside(shell);
            let mut whole = self
                .clear_way(disc, &inside)?
                .union(&self.spigot(&inside)?)?;
            if let Some(foot) = foot {
                whole = whole.union(&self.foot(foot)?)?;
            }
            if shell == 0 && self.fastened.root {
                whole = whole.subtract(&self.flat(0.0)?)?;
            }
            whole.subtract(&self.vent(&inside)?)?.to_solid()
        };
        make().map_err(|error| self.fault(shell, error))
    }

    /// Returns the profile of a shell outside, from its cap to its mouth.
    pub fn outer_profile(&self, shell: usize) -> Profile {
        let (sizes, body) = (&self.sizes, self.shells[shell].body_mm);
        let (face, mouth) = (self.face_mm(), self.ends_mm()[1]);
        let half = 0.5 * sizes.overlap_mm();
        let rim = [
            [mouth - sizes.chamfer_mm, body],
            [mouth, body - sizes.chamfer_mm],
        ];
        let Some(joint) = self.outer_joint(shell) else {
            return Profile::new([[face, body]].into_iter().chain(rim));
        };
        let ring = sizes.slide_mm - joint.seat_mm;
        let flange = [
            [face, joint.radii.flange_mm],
            [face + sizes.rise_mm() - ring, body + ring],
            [half, body + ring],
            [half + ring, body],
        ];
        Profile::new(flange.into_iter().chain(rim))
    }

    /// Returns the profile of a shell's cavity about the helix of the next shell.
    ///
    /// Arcs are from the pivot. It reaches from beyond the tail to beyond the mouth.
    pub fn cavity_profile(&self, shell: usize) -> Profile {
        let inside = self.inside(shell);
        let sizes = &self.sizes;
        let half = 0.5 * sizes.overlap_mm();
        let back = inside.back_mm(self.face_mm() - self.visible_mm);
        let Some(joint) = inside.joint else {
            return Profile::new([[back, inside.bore_mm], [half + BEYOND_MM, inside.bore_mm]]);
        };
        let ring = sizes.slide_mm - joint.seat_mm;
        let seat = inside.bore_mm - ring;
        let lip_start = half - sizes.lip_mm + joint.stop_room_mm;
        let rim = inside.lip_mm + sizes.chamfer_mm;
        Profile::new([
            [back, inside.bore_mm],
            [-half - ring, inside.bore_mm],
            [-half, seat],
            [lip_start - (seat - inside.lip_mm), seat],
            [lip_start, inside.lip_mm],
            [half - sizes.chamfer_mm, inside.lip_mm],
            [half, rim],
            [half + BEYOND_MM, rim],
        ])
    }

    /// Returns the arc at which a shell ends and its cap begins, mm.
    pub fn face_mm(&self) -> f64 {
        self.ends_mm()[0] + self.sizes.flange_mm
    }

    fn disc_profile(&self, shell: usize) -> Profile {
        let (tail, face, chamfer) = (self.ends_mm()[0], self.face_mm(), self.sizes.chamfer_mm);
        let body = self.shells[shell].body_mm;
        let joint = self.outer_joint(shell);
        let radius = joint.map_or(body, |joint| joint.radii.flange_mm);
        Profile::new([
            [tail, radius - chamfer],
            [tail + chamfer, radius],
            [face, radius],
        ])
    }

    /// Returns the joint in which a shell slides; `None` for the root.
    pub(super) fn outer_joint(&self, shell: usize) -> Option<&Joint> {
        self.joints.get(shell.checked_sub(1)?)
    }

    pub(super) fn inside(&self, shell: usize) -> Inside {
        let own = &self.shells[shell];
        let pivot = own.helix.frame_at(self.visible_mm);
        match self.joints.get(shell) {
            Some(joint) => Inside {
                outer: own.helix,
                helix: self.shells[shell + 1].helix,
                pivot,
                joint: Some(*joint),
                bore_mm: joint.radii.bore_mm,
                lip_mm: joint.radii.lip_mm,
                rib_mm: joint.radii.lip_mm + self.sizes.slide_mm - joint.seat_mm,
                rib_rad: joint.rib_rad,
            },
            None => {
                let bore_mm = own.body_mm - self.sizes.wall_mm;
                let lip_mm = (bore_mm - self.sizes.rise_mm()).max(0.5 * bore_mm);
                Inside {
                    outer: own.helix,
                    helix: own.helix,
                    pivot,
                    joint: None,
                    bore_mm,
                    lip_mm,
                    rib_mm: lip_mm,
                    rib_rad: self.sizes.feature_mm / lip_mm,
                }
            }
        }
    }

    /// Returns the cavity: the bore without the twist rib and the key of the cap, which stay.
    fn cavity(&self, shell: usize) -> Result<Csg, ClipError> {
        let inside = self.inside(shell);
        let sizes = &self.sizes;
        let bore = sweep_profile(&inside.pivot, &inside.helix, &self.cavity_profile(shell));
        let tail = self.face_mm() - self.visible_mm;
        let key = inside.rib([inside.back_mm(tail) - BEYOND_MM, tail + sizes.spigot_mm]);
        let cavity = body(bore)?.subtract(&body(key)?)?;
        if inside.joint.is_none() {
            return match self.fastened.tip {
                true => cavity.subtract(&self.mouth_key(&inside)?),
                false => Ok(cavity),
            };
        }
        cavity.subtract(&self.stop_rib(&inside)?)
    }

    /// Returns the twist rib: from the lip's cone back over the length of the flange.
    pub(super) fn stop_rib(&self, inside: &Inside) -> Result<Csg, ClipError> {
        let sizes = &self.sizes;
        let room_mm = inside.joint.map_or(0.0, |joint| joint.stop_room_mm);
        let lip_start = 0.5 * sizes.overlap_mm() - sizes.lip_mm + room_mm;
        let cone = lip_start - sizes.rise_mm();
        body(inside.rib([cone - sizes.flange_mm, lip_start]))
    }

    /// Returns the gap in a flange, through which the twist rib passes and in which it turns.
    pub(super) fn flange_gap(&self, helix: &Helix, joint: &Joint) -> Result<Csg, ClipError> {
        let [tail, _] = self.ends_mm();
        let skin = SKIN_SHARE * self.sizes.slide_mm;
        let sector = Sector {
            radii_mm: [
                joint.radii.body_mm + skin,
                joint.radii.flange_mm + BEYOND_MM,
            ],
            angles_rad: gap_rad(joint),
            arcs_mm: [
                tail - BEYOND_MM,
                self.face_mm() + self.sizes.rise_mm() + skin,
            ],
        };
        body(sweep_sector(&Frame::identity(), helix, &sector))
    }

    /// Returns the spigot of a cap, with the slot for its key.
    fn spigot(&self, inside: &Inside) -> Result<Csg, ClipError> {
        let (sizes, tail) = (&self.sizes, self.face_mm() - self.visible_mm);
        let from = inside.back_mm(tail);
        let radius = inside.bore_mm - sizes.glue_mm;
        let to = tail + sizes.spigot_mm;
        let round = Profile::new([[from, radius], [to, radius]]);
        let round = sweep_profile(&inside.pivot, &inside.helix, &round);
        let slot = inside.slot(sizes.glue_mm, [from - BEYOND_MM, to + BEYOND_MM]);
        let slot = sweep_sector(&inside.pivot, &inside.helix, &slot);
        let slotted = body(round)?.subtract(&body(slot)?)?;
        // It begins within the disc, whose faces lean against its own.
        let root_mm = self.face_mm() - ROOT_SHARE * sizes.flange_mm;
        let root = inside.outer.frame_at(root_mm);
        let plane = Plane::through(&root.origin, &root.axes.column(0).into());
        Ok(slotted.split_by_plane(&plane)?.0)
    }

    /// Returns a disc less the way of the child that slides towards it.
    ///
    /// A child that bends otherwise than its parent lies at an angle to the disc's face. So an
    /// edge of the disc can reach beyond the spigot, into the child's tail.
    fn clear_way(&self, disc: Csg, inside: &Inside) -> Result<Csg, ClipError> {
        if inside.joint.is_none() || inside.outer == inside.helix {
            return Ok(disc);
        }
        let tail = self.face_mm() - self.visible_mm;
        let from = tail + self.sizes.spigot_mm + SPIGOT_STEP_SHARE * self.sizes.slide_mm;
        let to = from + 2.0 * inside.bore_mm + BEYOND_MM;
        let way = Profile::new([[from, inside.bore_mm], [to, inside.bore_mm]]);
        disc.subtract(&body(sweep_profile(&inside.pivot, &inside.helix, &way))?)
    }

    /// Returns a foot, which reaches into the disc of the root's cap so that no faces coincide.
    fn foot(&self, foot: &DiscFoot) -> Result<Csg, ClipError> {
        let tail = self.shells[0].helix.frame_at(self.ends_mm()[0]);
        let [low, high] = [-foot.height_mm, ROOT_SHARE * self.sizes.flange_mm];
        let disc = Profile::disc([low, high], foot.radius_mm, self.sizes.chamfer_mm);
        let disc = body(sweep_profile(&tail, &Helix::LINE, &disc))?;
        let Some([radius, depth]) = foot.pocket_mm else {
            return Ok(disc);
        };
        let pocket = Profile::new([[low - BEYOND_MM, radius], [low + depth, radius]]);
        disc.subtract(&body(sweep_profile(&tail, &Helix::LINE, &pocket))?)
    }

    fn vent(&self, inside: &Inside) -> Result<Csg, ClipError> {
        let tail = self.face_mm() - self.visible_mm;
        let radius = (0.5 * self.sizes.vent_mm).min(0.5 * inside.lip_mm);
        let [from, to] = [
            inside.back_mm(tail) - self.sizes.flange_mm,
            tail + self.sizes.spigot_mm + BEYOND_MM,
        ];
        let hole = Profile::new([[from, radius], [to, radius]]);
        body(sweep_profile(&inside.pivot, &inside.helix, &hole))
    }

    pub(super) fn fault(&self, shell: usize, error: ClipError) -> TelescopeError {
        TelescopeError::Solid {
            shell: shell + 1,
            error,
        }
    }
}

impl Inside {
    /// Returns an arc so far behind the tail that a section there is all behind it, however it
    /// leans: up to 45°.
    fn back_mm(&self, tail_mm: f64) -> f64 {
        tail_mm - self.bore_mm - BEYOND_MM
    }

    /// Returns the angles of the rib: beside zero, on the side to which the shell turns.
    fn rib_angles(&self) -> [f64; 2] {
        let is_left = self.joint.is_some_and(|joint| joint.turn_rad < 0.0);
        if is_left {
            [-self.rib_rad, 0.0]
        } else {
            [0.0, self.rib_rad]
        }
    }

    /// Returns the slot in which a rib of the bore fits, over arcs from the pivot, mm.
    pub fn slot(&self, glue_mm: f64, arcs_mm: [f64; 2]) -> Sector {
        let play = glue_mm / self.lip_mm;
        let [low, high] = self.rib_angles();
        Sector {
            radii_mm: [self.lip_mm - glue_mm, self.bore_mm + BEYOND_MM],
            angles_rad: [low - play, high + play],
            arcs_mm,
        }
    }

    /// Returns a rib on the bore over arcs from the pivot, mm.
    pub fn rib(&self, arcs_mm: [f64; 2]) -> Result<TriMesh, MeshError> {
        let sector = Sector {
            radii_mm: [self.rib_mm, self.bore_mm + BEYOND_MM],
            angles_rad: self.rib_angles(),
            arcs_mm,
        };
        sweep_sector(&self.pivot, &self.helix, &sector)
    }
}

/// Returns the angles of the gap in a flange: [−θ − c, β + c], mirrored for a negative turn.
fn gap_rad(joint: &Joint) -> [f64; 2] {
    let (back, ahead) = (
        joint.turn_rad.abs() + joint.play_rad,
        joint.rib_rad + joint.play_rad,
    );
    if joint.turn_rad < 0.0 {
        [-ahead, back]
    } else {
        [-back, ahead]
    }
}

/// Returns a swept mesh as a body for booleans.
pub(super) fn body(mesh: Result<TriMesh, MeshError>) -> Result<Csg, ClipError> {
    Csg::of_mesh(&mesh?)
}
