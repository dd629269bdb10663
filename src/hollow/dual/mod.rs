//! The reachable set and the ascent of its dual: the part of the solver that every goal shares.

pub(crate) mod answer;
pub(crate) mod ascent;
pub(crate) mod mend;
pub(crate) mod programme;
pub(crate) mod prudence;
pub(crate) mod reach;
pub(crate) mod scout;
pub(crate) mod set;
pub(crate) mod step;
pub(crate) mod table;
pub(crate) mod units;
pub(crate) mod visit;
pub(crate) mod work;
