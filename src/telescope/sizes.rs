//! The measures of a joint, and the radii that follow from them.

use super::error::TelescopeError;
use crate::curve::TurnBound;

/// Room that a seat has beyond what a turn takes, mm.
pub(super) const SEAT_ROOM_MM: f64 = 0.02;

/// Depth of the groove that lets the air out of a socket, in diameters of the vent.
const GROOVE_VENTS: f64 = 0.5;

/// Clearances, walls and lengths of every joint, mm. Clearances are radial, on each side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointSizes {
    /// Wall w of a shell outside its bore.
    pub wall_mm: f64,
    /// Clearance g with which a shell slides.
    pub slide_mm: f64,
    /// Engagement h of flange and lip: what holds a shell in its parent.
    pub engagement_mm: f64,
    /// Length f of the flange, and thickness of the cap that carries it.
    pub flange_mm: f64,
    /// Length t of the lip.
    pub lip_mm: f64,
    /// Clearance of the press ring; at the sliding clearance there is no ring.
    pub seat_mm: f64,
    /// Length of the spigot of a cap.
    pub spigot_mm: f64,
    /// Clearance of the spigot, which is glued.
    pub glue_mm: f64,
    /// Diameter of the vent in a cap: a closed tube would be a piston.
    pub vent_mm: f64,
    /// Chamfer of the edges that slide, at least the first layer's squeeze.
    pub chamfer_mm: f64,
    /// Least width of a feature: the twist rib has this width or more.
    pub feature_mm: f64,
    /// What closes the shells behind.
    pub tails: Tails,
}

/// What holds shells in each other from behind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tails {
    /// Caps, which are glued in when all that lies in a shell is in it.
    Capped,
    /// Rings: all shells are printed in each other.
    InPlace {
        /// Diameter of the holes through which powder leaves, mm; `None` without powder.
        vent_mm: Option<f64>,
    },
}

/// The radii of a shell in its parent, mm, all about the shell's own helix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Radii {
    /// The body b.
    pub body_mm: f64,
    /// The flange, F = b + g + h.
    pub flange_mm: f64,
    /// The lip in the parent's mouth, λ = b + g.
    pub lip_mm: f64,
    /// The parent's bore, B = b + 2g + h.
    pub bore_mm: f64,
}

impl JointSizes {
    /// Returns what stays inside of a shell that is all out, mm: o = f + t + h.
    ///
    /// Flange and lip end in cones of 45°. They meet when the shell has slid by its visible length.
    pub fn overlap_mm(&self) -> f64 {
        self.flange_mm + self.lip_mm + self.engagement_mm
    }

    /// Returns the rise of flange and lip over the tube they stand on, mm: g + h.
    pub fn rise_mm(&self) -> f64 {
        self.slide_mm + self.engagement_mm
    }

    /// Returns the depth of the groove beside a root in its socket, mm.
    pub fn groove_mm(&self) -> f64 {
        GROOVE_VENTS * self.vent_mm
    }

    /// Returns the step of the body radius between shells of one shape, mm: p = w + h + 2g.
    pub fn pitch_mm(&self) -> f64 {
        self.wall_mm + self.engagement_mm + 2.0 * self.slide_mm
    }

    /// Returns by how much a shell still stands out when it is all in, mm.
    ///
    /// It is the cap of its parent with its spigot, and a gap on the inside of a bend too. What is
    /// printed in place has no caps.
    pub fn closed_mm(&self) -> f64 {
        match self.tails {
            Tails::Capped => self.flange_mm + self.spigot_mm + 2.0 * self.slide_mm,
            Tails::InPlace { .. } => 0.0,
        }
    }

    /// Returns true if all shells are printed in each other.
    pub fn is_in_place(&self) -> bool {
        self.tails != Tails::Capped
    }

    /// Returns the bound of turns: what the seat leaves of the sliding clearance.
    pub fn turn_bound(&self) -> TurnBound {
        TurnBound {
            overlap_mm: self.overlap_mm(),
            offset_mm: (self.slide_mm - SEAT_ROOM_MM).max(0.0),
        }
    }

    /// Returns the radii of a body in its parent.
    pub fn radii(&self, body_mm: f64) -> Radii {
        Radii {
            body_mm,
            flange_mm: body_mm + self.rise_mm(),
            lip_mm: body_mm + self.slide_mm,
            bore_mm: body_mm + self.slide_mm + self.rise_mm(),
        }
    }

    /// Returns the fault that a flange is too short for the cone at its tail, if it is: the
    /// measure, its value and its range. `bend_ratio` is curvature times the bore's radius.
    pub(super) fn short_flange(
        &self,
        bend_ratio: f64,
    ) -> Option<(&'static str, f64, &'static str)> {
        let cone_mm = self.tail_cone_mm(bend_ratio);
        let is_short = self.is_in_place() && cone_mm > self.flange_mm;
        let range = "at most the length of the flange; remedy: a longer overlap";
        is_short.then_some(("cone at the tail", cone_mm, range))
    }

    /// Refuses measures with which no joint can be made.
    pub fn check(&self) -> Result<(), TelescopeError> {
        let above_zero = "a number above zero";
        let positive = [
            ("wall", self.wall_mm),
            ("sliding clearance", self.slide_mm),
            ("engagement", self.engagement_mm),
            ("flange", self.flange_mm),
            ("lip", self.lip_mm),
            ("seat clearance", self.seat_mm),
            ("spigot", self.spigot_mm),
            ("glue clearance", self.glue_mm),
            ("vent", self.vent_mm),
            ("chamfer", self.chamfer_mm),
            ("least feature", self.feature_mm),
        ];
        let is_bad = |value: f64| !(value.is_finite() && value > 0.0);
        let bad = positive.into_iter().find(|(_, value)| is_bad(*value));
        let bad = bad.map(|(measure, value)| (measure, value, above_zero));
        let bounded = [
            (
                "seat clearance",
                self.seat_mm,
                self.slide_mm,
                "at most the sliding clearance",
            ),
            (
                "sliding clearance",
                self.slide_mm,
                self.wall_mm,
                "at most the wall",
            ),
            (
                "chamfer",
                self.chamfer_mm,
                0.5 * self.wall_mm,
                "at most half of the wall",
            ),
        ];
        let above = bounded.into_iter().find(|(_, value, most, _)| value > most);
        let above = above.map(|(measure, value, _, range)| (measure, value, range));
        match bad.or(above).or(self.short_flange(0.0)) {
            Some((measure, value_mm, range)) => Err(TelescopeError::Size {
                measure,
                value_mm,
                range,
            }),
            None => Ok(()),
        }
    }
}
