//! The wall that stays: the region nearer to the surface than the wall, and what else must stay solid.

mod keep;

pub use keep::Keep;
