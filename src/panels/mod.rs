//! Panels of sheet material, as a laser cuts them: outlines, finger joints, and the path of the
//! beam.
//!
//! * [`Outline`] is a closed line that goes round material, or round a hole.
//! * [`beam_path`] offsets an outline by half the kerf, with reliefs in inner corners.
//! * [`FingerJoint`] joins two panels along an edge at any angle.
//! * [`PanelSet`] makes the panels of a polyhedron, with the joints along its edges.
//! * [`Bracket`] holds two panels from inside, where fingers do not.
//! * [`nest`] lays panels on sheets, and [`SheetLines`] are what is cut and engraved there.
//! * [`engraved`] writes text in strokes.

mod beam;
mod bracket;
mod edge;
mod ends;
mod engraving;
mod fingers;
mod lines;
mod nest;
mod outline;
mod panel;
mod rings;
mod set;

pub use beam::{BeamError, beam_path};
pub use bracket::Bracket;
pub use edge::{BracketKind, EdgeJoint, JointStyle, PanelEdge, PanelError, PanelRequest};
pub use engraving::engraved;
pub use fingers::{FingerJoint, FingerSide};
pub use lines::{LineOrder, SheetLines};
pub use nest::{NestError, NestRequest, NestedSheet, Placement, Stock, nest};
pub use outline::Outline;
pub use panel::{Hole, Panel};
pub use set::PanelSet;
