//! The judge of toolpaths: tells how a print will balance before it is printed.
//!
//! [`verify_printed`] reads G-code of a kit's plates, finds the parts in it, and weighs them with
//! the hardware, ballast and glue of the promise. It holds the figures against the promise, and
//! names the causes of a wrong print with the setting to change.
//!
//! * `images` reads layer images as material.
//! * `locate` tells where toolpaths lay the parts.
//! * `source` reads files; `names`, `shape`, `turns` and `matching` find the parts.
//! * `part` and `density` weigh them; `supports` finds support in voids.
//! * `cause` and `causes` name what is set wrong; `checks` gives the verdict.

mod cause;
mod causes;
mod checks;
mod density;
mod error;
mod images;
mod judge;
mod judgement;
mod limits;
mod locate;
mod matching;
mod names;
mod part;
mod shape;
mod source;
mod supports;
#[cfg(test)]
mod tests;
mod turns;

pub use cause::{Cause, CauseKind};
pub use error::PrintedError;
pub use judge::verify_printed;
pub use judgement::{PrintedFile, PrintedJudgement};
pub use limits::{
    PRINTED_CENTER_LIMIT_MM, PRINTED_MASS_LIMIT_RATIO, PRINTED_SKIN_MM, PRINTED_TILT_LIMIT_DEG,
};
pub use locate::{LocatedPart, LocatedPlate, locate_parts};
pub use matching::MatchedBy;
pub use part::PrintedPart;
