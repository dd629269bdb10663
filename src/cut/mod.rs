//! Cuts: the fewest planes that open every void, the pins that align the parts, and the parts
//! themselves.

mod access;
mod boss_places;
mod boss_view;
mod bosses;
mod chamber;
mod cover;
mod describe;
mod error;
mod face;
mod family;
mod further;
#[cfg(test)]
mod joinery_tests;
mod keep;
mod label;
mod layers;
mod lumps;
mod mirror;
mod opening;
mod order;
mod outline;
mod overlap;
mod part;
mod pattern;
mod pin_shape;
mod pin_size;
mod pins;
mod plan;
mod planner;
mod pose;
mod rejoin;
mod request;
mod rod;
mod score;
mod search;
mod seat;
mod section;
mod sides;
mod sight;
mod solid;
mod split;
mod tree;

#[cfg(test)]
mod scenes;
#[cfg(test)]
mod tests;

pub use access::VoidAccess;
pub use bosses::{Boss, BossOrder, JointName, bosses};
pub use error::CutError;
pub use label::{Label, LabelStyle};
pub use layers::CutMove;
pub use lumps::{Unclean, beyond, closed, unclean};
pub use order::{CutOrder, OrderError};
pub use part::{Part, parts, parts_and_faces};
pub use pin_shape::PinSite;
pub use plan::{Cut, CutPlan, CutSide, JointNote, Side, UncutFace};
pub use planner::{plan, plan_around, plan_by, plan_of};
pub use pose::{Pose, apply};
pub use request::{GoalAxis, PinSettings, PlanRequest, PosePreference};
pub use rod::{Dowel, Rod, RodSource, rods};
pub use seat::Seat;
pub use section::{Point2, Ring, Section};
pub use solid::SolidEnd;
pub use tree::reached;
