//! The pieces between the cuts, and the parts made of them.

pub(crate) mod part;
pub(crate) mod pose;
pub(crate) mod rejoin;
pub(crate) mod split;
