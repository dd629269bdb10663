//! The pins between two parts, and the material about their sockets.

use super::part::{Holding, Part};
use crate::cut::{PinSite, PlanRequest};
use crate::geom::{Point, Vector};
use crate::shell::Keep;

/// Material about a socket beside its wall, mm: what a hollow's surface strays by.
const SPARE_MM: f64 = 0.1;

/// The order for pins between parts.
#[derive(Debug, Clone, Copy)]
pub struct PinRequest<'a> {
    /// The sizes of pins, their clearance, and the walls about their sockets.
    pub plan: &'a PlanRequest,
    /// The height over the floor of a part, mm, in which no socket is: heads of bracket screws lie
    /// there.
    pub floor_mm: f64,
}

/// The pins between two parts.
#[derive(Debug, Clone, PartialEq)]
pub struct PartPins {
    /// The indices of the part on which they stand, and of the one with their sockets.
    pub parts: [usize; 2],
    /// The pins.
    pub sites: Vec<PinSite>,
}

impl PartPins {
    /// Returns the pins that stand on a part (side 0), or those whose sockets it has (side 1).
    pub fn on(all: &[Self], part: usize, side: usize) -> Vec<&PinSite> {
        let own = all.iter().filter(|pins| pins.parts[side] == part);
        own.flat_map(|pins| &pins.sites).collect()
    }

    /// Returns true if they join a part to the one that carries it.
    pub(super) fn holds_limb(&self, parts: &[Part], limb: usize) -> bool {
        matches!(parts[limb].holding, Holding::Pinned { to, .. }
            if self.parts.contains(&limb) && self.parts.contains(&to))
    }
}

/// Returns the material about the socket of a pin that stays solid in a hollow part.
pub(super) fn socket_keep(site: &PinSite, wall_mm: f64) -> Keep {
    let mouth = Point::from(site.center_mm);
    Keep {
        from: mouth,
        to: mouth + Vector::from(site.direction) * site.socket_depth_mm,
        radius_mm: PinSite::socket_corner_mm(site.socket_diameter_mm) + wall_mm + SPARE_MM,
    }
}
