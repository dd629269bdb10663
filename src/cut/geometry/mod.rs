//! Geometry of cuts: plane sections and what can be read from them before anything is cut.
//!
//! * `chart`: coordinates in a plane.
//! * `section`: the closed rings in which a plane meets a mesh.
//! * `outline`: the boundary of a flat region and its largest disc.
//! * `overlap`: a cut face clipped by other planes.
//! * `sides`: the pieces on both sides of a plane, and their volumes.
//! * `opening`: the width to which a plane opens a void.
//! * `tree`: all cuts as a binary space partition.

pub(crate) mod chart;
pub(crate) mod opening;
pub(crate) mod outline;
pub(crate) mod overlap;
pub(crate) mod section;
pub(crate) mod sides;
pub(crate) mod tree;
