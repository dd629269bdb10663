//! A plan that is tried first: its kit says whether it keeps its promise.

use crate::open::way::Way;

/// A draft with hidden seams, and walls out of sight.
///
/// Filament walls that are steep enough hold no support, and then need no sight. Which ones are
/// steep is known once the parts have their poses. So the kit is made, and its checks decide.
#[derive(Clone)]
pub(super) struct Trial<'a> {
    /// The cuts.
    pub(super) draft: Way<'a>,
    /// The share of the goal's figure that it loses against the usual plan.
    pub(super) loss_ratio: f64,
}
