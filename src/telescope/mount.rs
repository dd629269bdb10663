//! Fastenings of a telescope to other bodies: a socket around its root, a peg in its last mouth.

use super::nest::Telescope;
use super::parts::{Inside, body};
use super::profile::Profile;
use super::sweep::{Sector, sweep_profile, sweep_sector};
use crate::curve::Helix;
use crate::geom::{Frame, Point};
use crate::mesh::primitives::cuboid;
use crate::mesh::{ClipError, Csg};

/// By how much tools reach beyond what they cut, mm.
const BEYOND_MM: f64 = 1.0;
/// Depth of the room behind the root's cap, mm: air goes from its vent to the groove.
const RECESS_MM: f64 = 1.0;
/// Length by which two tools of one socket reach into each other, mm.
const JOINED_MM: f64 = 0.5;
/// Length of a peg within the body that it stands on, in its radii.
pub(super) const ROOTED_RADII: f64 = 0.5;

impl Telescope {
    /// Returns what a body is cut by for the root to be glued in, in the root's frame.
    ///
    /// It is the root with its cap, grown by the glue's clearance and lengthened by `clear_mm`
    /// beyond the mouth. Its flat fits that of the cap. A groove lets the air of the vent out.
    pub fn socket(&self, clear_mm: f64) -> Result<Csg, ClipError> {
        let (sizes, helix) = (&self.sizes, &self.shells[0].helix);
        let [tail_mm, mouth_mm] = self.ends_mm();
        let radius = self.shells[0].body_mm + sizes.glue_mm;
        let start = Frame::identity();
        let round = Profile::new([[tail_mm, radius], [mouth_mm, radius]]);
        let tail = helix.frame_at(tail_mm);
        // The bottom is parallel to the cap's, however the root bends.
        let bottom = Profile::new([[-sizes.glue_mm, radius], [JOINED_MM, radius]]);
        let bottom = body(sweep_profile(&tail, &Helix::LINE, &bottom))?;
        let round = body(sweep_profile(&start, helix, &round))?.union(&bottom)?;
        let round = round.subtract(&self.flat(sizes.glue_mm)?)?;
        let depth = sizes.groove_mm();
        let mouth = helix.frame_at(mouth_mm);
        let wide = radius + depth;
        let ahead = Profile::new([[-JOINED_MM, radius], [0.0, wide], [clear_mm, wide]]);
        let ahead = body(sweep_profile(&mouth, &Helix::LINE, &ahead))?;
        let inner = (self.shells[0].body_mm - 2.0 * sizes.wall_mm).max(sizes.vent_mm);
        let recess = Profile::new([[-RECESS_MM, inner], [JOINED_MM, inner]]);
        let recess = body(sweep_profile(&tail, &Helix::LINE, &recess))?;
        let half_rad = 0.5 * sizes.vent_mm / radius;
        let groove = Sector {
            radii_mm: [0.5 * inner, wide],
            angles_rad: [-half_rad, half_rad],
            arcs_mm: [tail_mm - RECESS_MM, mouth_mm + JOINED_MM],
        };
        let groove = body(sweep_sector(&start, helix, &groove))?;
        round.union(&ahead)?.union(&recess)?.union(&groove)
    }

    /// Returns the block by which the root's cap is flat, in the root's frame; `wider_mm` is the
    /// clearance that it leaves.
    ///
    /// The cap covers its spigot still, for the flat is no deeper than the wall.
    pub(super) fn flat(&self, wider_mm: f64) -> Result<Csg, ClipError> {
        let radius = self.shells[0].body_mm;
        let tail = self.shells[0].helix.frame_at(self.ends_mm()[0]);
        let (far, deep) = (radius + BEYOND_MM, radius - self.sizes.wall_mm + wider_mm);
        let low = Point::new(-BEYOND_MM, -far, -far);
        // The cap is cut through, so that no faces coincide; in the socket the root needs room.
        let top = match wider_mm > 0.0 {
            true => self.sizes.flange_mm - wider_mm,
            false => self.sizes.flange_mm + BEYOND_MM,
        };
        let high = Point::new(top, -deep, far);
        let block = cuboid(&low, &high);
        Csg::of_mesh(&block.map_vertices(|p| tail.to_model(p)))
    }

    /// Returns the peg that fills the last mouth, in the last shell's frame. It reaches beyond the
    /// mouth into the body that it stands on, and its slot fits the key of the bore.
    pub fn peg(&self) -> Result<Csg, ClipError> {
        let inside = self.inside(self.shells.len() - 1);
        let (sizes, half) = (&self.sizes, 0.5 * self.sizes.overlap_mm());
        let radius = inside.bore_mm - sizes.glue_mm;
        let to = half + ROOTED_RADII * radius;
        let round = Profile::new([[half - sizes.spigot_mm, radius], [to, radius]]);
        let round = sweep_profile(&inside.pivot, &inside.helix, &round);
        let slot = inside.slot(
            sizes.glue_mm,
            [half - sizes.spigot_mm - BEYOND_MM, half + sizes.glue_mm],
        );
        let slot = sweep_sector(&inside.pivot, &inside.helix, &slot);
        body(round)?.subtract(&body(slot)?)
    }

    /// Returns the arcs of the key in the last mouth, mm from its pivot.
    pub(super) fn mouth_key(&self, inside: &Inside) -> Result<Csg, ClipError> {
        let half = 0.5 * self.sizes.overlap_mm();
        body(inside.rib([half - self.sizes.spigot_mm, half + 2.0 * BEYOND_MM]))
    }
}
