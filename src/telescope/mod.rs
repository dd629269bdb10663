//! Telescopes: nested shells that slide out of one another along helices. Lengths are in mm, angles
//! in radians.
//!
//! Every shell is a tube about a helix. The cavity of its parent is a tube about the same helix, so
//! the shell slides in it with one gap. For frames along a helix compose ([`crate::curve::Helix`]).
//! (Yu, Crane and Coros, "Computational Design of Telescoping Structures", ACM TOG 36(4), 2017.)
//!
//! # The line
//! [`prepare()`] goes it from a job to a kit: load, measure, design, make, judge, kit. Its middle
//! is [`design()`]. [`Telescope::nest`] finds the radii of a chain of helices.
//! [`Telescope::shell_solid`] and [`Telescope::cap_solid`] make its parts;
//! [`Telescope::nested_solid`] those that are printed in each other.
//! [`Telescope::find_opening`] opens it without a collision.
//!
//! [`Network`] joins telescopes to a tree of junctures. [`Network::reach`] finds states whose tips
//! come near to wanted places.
//!
//! * **Measures:** [`JointSizes`], walls, clearances and lengths of a joint; [`Radii`], what
//!   follows from them for a body.
//! * **Fits:** [`axis_excess_mm`], the wall that unlike shapes cost; [`turning_offset_mm`], how far
//!   a turn parts two tubes; [`lock_slack_mm`], how far it holds them.
//! * **Limits:** [`Limit`], proofs that no telescope of a size follows a curve.
//! * **Mass:** [`TubeMass`], volume and centre of a tube in closed form; [`Balance`], on a foot
//!   along the motion.

mod balance;
mod clearance;
mod design;
mod error;
mod fastened;
mod fits;
mod in_place;
mod limits;
mod motion;
mod mount;
mod nest;
mod network;
mod parts;
mod pose;
mod pose_file;
pub mod prepare;
mod profile;
mod sizes;
mod sweep;
mod tube;

#[cfg(test)]
mod tests;

pub use balance::{Balance, DiscFoot};
pub use clearance::Gap;
pub use design::{
    Design, DesignError, DesignRow, OrderWish, Wish, choose_design, design, design_table,
};
pub use error::TelescopeError;
pub use fastened::Fastened;
pub use fits::{axis_excess_mm, lock_slack_mm, turning_offset_mm};
pub use in_place::Vent;
pub use limits::{Limit, ball_limit, budget_limit, strands_limit};
pub use motion::{Collision, Key, Opening, Order};
pub use nest::{Joint, JointState, Shell, Telescope};
pub use network::{Limb, Network, NetworkFrames};
pub use pose::{Reached, Target, TooFar};
pub use pose_file::{PoseFile, PoseJoint, PoseLine, pose_text};
pub use prepare::{TelescopeRunError, Tried, prepare};
pub use profile::Profile;
pub use sizes::{JointSizes, Radii, Tails};
pub use sweep::{Sector, sweep_profile, sweep_sector};
pub use tube::TubeMass;
