//! A plan, and another with fewer parts that may be taken in its place.

use crate::error::Error;
use crate::open::plan::are_clean;
use crate::open::way::Way;
use crate::run::{FewerFault, Policy};

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

/// Returns the first fault of a plan with fewer parts, besides its figure; `None` if it has none.
pub(super) fn fault_of(
    few: &Way,
    usual: &Way,
    policy: &Policy,
) -> Result<Option<FewerFault>, Error> {
    let loose = few.count_unaligned()?;
    if loose > usual.count_unaligned()? {
        return Ok(Some(FewerFault::Loose(loose)));
    }
    fault_of_draft(few, usual, policy)
}

/// Returns the first fault of such a plan before it has its pins: voids that are less clean, or
/// seams that are less hidden. `None` if it has none.
pub(super) fn fault_of_draft(
    few: &Way,
    usual: &Way,
    policy: &Policy,
) -> Result<Option<FewerFault>, Error> {
    let is_clean = |way: &Way| are_clean(&way.bossed.plan, &way.request);
    if is_clean(usual) && !is_clean(few) {
        return Ok(Some(FewerFault::Unclean));
    }
    let is_seen = few.seam_price()? > usual.seam_price()?.max(policy.dear_seam_ratio);
    Ok(is_seen.then_some(FewerFault::Seen))
}
