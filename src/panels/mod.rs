//! Panels of sheet material, as a laser cuts them: outlines, finger joints, and the path of the
//! beam.
//!
//! * [`Outline`] is a closed line that goes round material, or round a hole.
//! * [`beam_path`] offsets an outline by half the kerf, with reliefs in inner corners.
//! * [`FingerJoint`] joins two panels along an edge at any angle.
//! * [`engraved`] writes text in strokes.

mod beam;
mod engraving;
mod fingers;
mod outline;

pub use beam::{BeamError, beam_path};
pub use engraving::engraved;
pub use fingers::{FingerJoint, FingerSide};
pub use outline::Outline;
