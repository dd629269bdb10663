//! Plane sections, outlines and the tree of cuts.

pub(crate) mod chart;
pub(crate) mod opening;
pub(crate) mod outline;
pub(crate) mod overlap;
pub(crate) mod section;
pub(crate) mod sides;
pub(crate) mod tree;
