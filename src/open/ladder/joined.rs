//! A plan, and another with fewer parts that may be taken in its place.

use crate::open::way::Way;

/// A plan with its pins in the walls, and another with fewer parts beside it.
pub(super) struct Joined<'a> {
    /// The plan.
    pub(super) walls: Way<'a>,
    /// The other one, which is not taken yet.
    pub(super) fewer: Option<Fewer<'a>>,
}

impl<'a> Joined<'a> {
    /// Returns a plan with nothing beside it.
    pub(super) fn alone(walls: Way<'a>) -> Self {
        Self { walls, fewer: None }
    }
}

/// A plan with fewer parts that costs too much before both have their pins.
pub(super) struct Fewer<'a> {
    /// The cuts.
    pub(super) draft: Way<'a>,
    /// True if its voids are as clean and its seams as well hidden.
    pub(super) is_as_good: bool,
}
