//! The model, its goal and the allowances with which every socket is made.

use crate::goal::{Goal, Rod};
use crate::mesh::Solid;

/// The clearance in a socket and the wall around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowances {
    /// The gap between a rod and its socket on each side, mm.
    pub clearance_mm: f64,
    /// The minimum wall around a socket, mm.
    pub wall_mm: f64,
}

/// The context in which every socket is made.
pub(super) struct Workshop<'a> {
    pub solid: &'a Solid,
    pub goal: &'a Goal,
    pub allowances: &'a Allowances,
}

impl Workshop<'_> {
    /// Returns the radius of the socket for a rod, mm.
    pub fn bore_radius_mm(&self, rod: &Rod) -> f64 {
        rod.radius_mm() + self.allowances.clearance_mm
    }
}
