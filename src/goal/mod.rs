//! Goals: a request in words becomes a goal with a frame, a support and figures of merit.
//!
//! [`place`] turns a [`Request`] and a solid into a [`Goal`]. The goal's frame is the one in which
//! every later formula holds. Its origin is the contact, the spin point or the middle of the
//! support; its z axis is the spin axis or up.
//!
//! [`compute_figures`] evaluates a body of given moments in that frame: the solid, the hollowed result or
//! the assembled parts.

mod balance;
mod drill;
mod error;
mod figures;
mod float;
mod hardware;
mod kind;
mod lean;
mod matching;
mod place;
mod placement;
mod request;
mod resting;
mod rotor;
mod shafts;
mod site;
mod sites;
mod stand;
mod support;
mod target;
#[cfg(test)]
pub(crate) mod testing;
mod tip_choice;
mod tips;
mod top;
mod upright;
mod water;
mod yoyo;

pub use error::GoalError;
pub(crate) use figures::to_rpm;
pub use figures::{Figures, compute_figures};
pub use hardware::{Hardware, HardwareError, Rod, STEEL_G_CM3};
pub use kind::{GoalKind, Objective};
pub use lean::Lean;
pub use place::{
    PrintStock, keeps_its_lean, place, place_in_material, place_measured, spins_on_lowest,
};
pub use placement::{Footing, Goal, Placement, Warning};
pub use request::{LEAST_ANGLE_DEG, LEAST_LEAN_DEG, Request, RequestError};
pub use resting::{FootStability, find_foot_stability};
pub use rotor::{Rotor, Spindle};
pub use shafts::{RoundKind, RoundSurface, ShaftAxis, ShaftList, find_shafts};
pub use site::MeasuredSolid;
pub use sites::{Contact, SpinPoint, Up};
pub(crate) use support::edges as support_edges;
pub use target::{Target, Wanted};
pub use tip_choice::TipChoice;
pub(crate) use top::height_over_origin;
pub use upright::{UprightPose, UprightReason, find_upright};
pub use water::{FloatConditions, Hydrostatics, Liquid, Water, Waterline};
