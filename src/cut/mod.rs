//! Cuts: the planes that open the voids of a hollowed model, the pins that align its parts, and the
//! parts themselves.
//!
//! [`plan()`] searches the fewest planes that open every void of a [`Hollowed`] body wide enough,
//! and places pins in the joints. [`plan_by`] follows a [`CutOrder`] that a user has written.
//! [`parts`] cuts the body by a [`CutPlan`] into solids with pins, sockets and labels, posed for
//! the printer.
//!
//! | file or folder | holds |
//! |---|---|
//! | `hollowed`, `seat` | the input: a solid with voids, and the seats of parts that voids hold |
//! | `request`, `for_printer` | the requirements of a plan, and how a printer sets them |
//! | `order` | the cuts and pins of a user: read, checked and written |
//! | `plan`, `ids`, `side` | the plan as plain data, with the ids and sides that it names |
//! | `remark`, `error` | notes for the user, obstacles and errors |
//! | `geometry` | sections, outlines and the tree of cuts |
//! | `drains` | the holes through which the voids of an uncut piece drain |
//! | `access` | the openings of voids, and the share of their walls in sight |
//! | `pieces` | the pieces between the cuts, their poses, and the finished parts |
//! | `joints` | pins, dowels, bosses and labels |
//! | `seam`, `least_part` | what is seen of a seam, where none may run, and the least part |
//! | `planner` | the search for the fewest cuts, and the way from cuts to a plan |

mod error;
mod for_printer;
mod hollowed;
mod ids;
mod least_part;
mod order;
mod plan;
mod remark;
mod request;
mod seat;
mod side;

mod access;
mod drains;
mod geometry;
mod joints;
mod pieces;
mod planner;
mod seam;

#[cfg(test)]
mod scenes;
#[cfg(test)]
mod tests;

// The input.
pub use hollowed::{Hollowed, Void};
pub use least_part::LeastPart;
pub use order::{CutOrder, Namer, OrderError, PinFault};
pub use request::{GoalAxis, LabelStyle, PinSettings, PlanRequest, PosePreference};
pub use seam::clear::KeepClear;
pub use seam::notes::{SeamNote, dearest_spot, seams};
pub use seam::regions::KeepWhole;
pub use seam::rules::{SeamStyle, Seams};
pub use seam::skin::SeamLie;
pub use seat::Seat;

// The plan.
pub use error::{CutError, Obstacle};
pub use ids::{CutId, DrainId, IdError, JointId, PartId, PinId, VoidId};
pub use plan::{Cut, CutMove, CutPlan, JointNote, SolidEnd, UncutFace};
pub use planner::draft::{Draft, Drafts, SeamWeight, draft, draft_again, finish_draft};
pub use planner::{measure_voids_again, plan, plan_around, plan_by};
pub use remark::{PinLack, Proof, Remark, SightGain, Term, UncleanCause};
pub use side::{CutSide, Side};

// The drain holes of an uncut piece.
pub use drains::hole::DrainHole;
pub use drains::{Drained, drain};

// The parts and their joints.
pub use joints::bench::{PRESSED_MM, WIPING_ROOM_MM};
pub use joints::boss::{Boss, BossRequest, JointName, MaterialPrice};
pub use joints::bosses::bosses;
pub use joints::free_joint::{PinPlacer, Touching};
pub use joints::jig::{Jig, jigs};
pub use joints::label::Label;
pub use joints::pin_shape::PinSite;
pub use joints::rod::{Dowel, Rod, RodSource, rods};
pub use joints::shelf::JigShelf;
pub use joints::socket_wall::{find_thin_sockets, keeps_socket_walls};
pub use pieces::cups::{HollowCup, find_hollow_cups};
pub use pieces::part::{Part, parts, parts_and_faces};
pub use pieces::pose::{Lie, Pose, apply};

// The voids after the cuts, and sections.
pub use access::uncleanable::{
    Unclean, find_closed, find_ends_beyond_unpinned_joints, find_ends_in_small_parts, find_unclean,
};
pub use access::uncut::find_ends_at_uncut_faces;
pub use access::void_access::VoidAccess;
pub use geometry::chart::Point2;
pub use geometry::section::{Ring, Section};
pub use geometry::tree::clip_to_limits;
