//! A plane that divides bodies within half-spaces.

use super::{Plane, Point};

/// A plane that divides bodies only within some half-spaces.
#[derive(Debug, Clone, PartialEq)]
pub struct Parting {
    /// The plane.
    pub plane: Plane,
    /// The planes that bound the half-spaces, each with true if the half-space lies above it.
    /// Empty if the plane divides everything.
    pub within: Vec<(Plane, bool)>,
}

impl Parting {
    /// Makes a plane that divides everything.
    pub fn everywhere(plane: Plane) -> Self {
        Self {
            plane,
            within: Vec::new(),
        }
    }

    /// Returns true if a point lies in all the half-spaces.
    pub fn acts_at(&self, at: &Point) -> bool {
        self.within
            .iter()
            .all(|(plane, is_above)| (plane.distance(at) > 0.0) == *is_above)
    }
}
