//! The access that cuts give to voids: the openings, and the wall that is visible through them.

pub(crate) mod chamber;
pub(crate) mod eyes;
pub(crate) mod sight;
pub(crate) mod uncleanable;
pub(crate) mod uncut;
pub(crate) mod void_access;
