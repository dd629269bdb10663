//! A plane that parts bodies, within half-spaces.

use super::{Plane, Point};

/// A plane, and the half-spaces within which alone it parts bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Parting {
    /// The plane.
    pub plane: Plane,
    /// The planes that bound the half-spaces, each with whether the half-space lies above it; none
    /// where the plane parts everything.
    pub within: Vec<(Plane, bool)>,
}

impl Parting {
    /// A plane that parts everything.
    pub fn everywhere(plane: Plane) -> Self {
        Self {
            plane,
            within: Vec::new(),
        }
    }

    /// Whether a point lies in all the half-spaces.
    pub fn acts_at(&self, at: &Point) -> bool {
        self.within
            .iter()
            .all(|(plane, is_above)| (plane.distance(at) > 0.0) == *is_above)
    }
}
