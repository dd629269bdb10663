//! The openings that cuts make into voids, and what of the walls is seen through them.

pub(crate) mod chamber;
pub(crate) mod sight;
pub(crate) mod uncleanable;
pub(crate) mod void_access;
