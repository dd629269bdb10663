//! Cuts: the fewest planes that open every void, the pins that align the parts, and the parts
//! themselves.

mod access;
mod error;
mod for_printer;
mod geometry;
mod hollowed;
mod ids;
mod joints;
mod order;
mod pieces;
mod plan;
mod planner;
mod remark;
mod request;
#[cfg(test)]
mod scenes;
mod seat;
mod side;
#[cfg(test)]
mod tests;

pub use access::uncleanable::{Unclean, beyond, closed, unclean};
pub use access::void_access::VoidAccess;
pub use error::{CutError, Obstacle};
pub use geometry::chart::Point2;
pub use geometry::section::{Ring, Section};
pub use geometry::tree::reached;
pub use hollowed::{Hollowed, Void};
pub use ids::{CutId, IdError, JointId, PartId, PinId, VoidId};
pub use joints::boss::{Boss, BossOrder, JointName, MaterialPrice};
pub use joints::bosses::bosses;
pub use joints::label::Label;
pub use joints::pin_shape::PinSite;
pub use joints::rod::{Dowel, Rod, RodSource, rods};
pub use order::{CutOrder, Namer, OrderError, PinFault};
pub use pieces::part::{Part, parts, parts_and_faces};
pub use pieces::pose::{Lie, Pose, apply};
pub use plan::{Cut, CutMove, CutPlan, JointNote, SolidEnd, UncutFace};
pub use planner::{plan, plan_around, plan_by, plan_of};
pub use remark::{PinLack, Proof, Remark, SightGain, Term, UncleanCause};
pub use request::{GoalAxis, LabelStyle, PinSettings, PlanRequest, PosePreference};
pub use seat::Seat;
pub use side::{CutSide, Side};
