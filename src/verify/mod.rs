//! The independent judge: it sees the written files, the goal and the printer, and nothing of how
//! they were made.

mod ballast;
mod changes;
mod check;
mod checks;
mod cleaning;
#[cfg(test)]
mod cleaning_tests;
mod figures;
mod fingerprint;
mod hardware;
mod joints;
mod judge;
#[cfg(test)]
pub(crate) mod judge_tests;
mod kind;
mod kit;
#[cfg(test)]
mod kit_tests;
mod measure;
mod mouths;
mod packages;
mod pegs;
#[cfg(test)]
mod pegs_tests;
mod pose;
mod promise;
mod rotor;
mod seal;
mod sheet;
mod shells;
mod support;
#[cfg(test)]
pub(crate) mod test_meshes;
mod wall;
mod water;

pub use crate::printer::{Cleaning, CleaningRule};
pub use ballast::{BallastOrder, FillOrder};
pub use changes::{Change, FileChange, files_check};
pub use check::{Check, Comparison, Limit};
pub use checks::{
    AXIS_OFFSET_LIMIT_MM, AXIS_TILT_LIMIT_DEG, DOMINANCE_LIMIT_RATIO, FIGURE_SLACK_RATIO,
    GAP_TOLERANCE_MM, METACENTRIC_LIMIT_MM, PIN_LIMIT_MM, POSE_LIMIT_RATIO, RESTING_LIMIT_MM,
    RIGHTING_LIMIT_DEG, STANDING_LIMIT_DEG, STRING_GAP_TOLERANCE_MM, VOLUME_SUM_LIMIT_RATIO,
    WALL_TOLERANCE_MM, WATERLINE_LIMIT_MM, checks,
};
pub use cleaning::{PromisedCut, PromisedVoid, SIGHT_TOLERANCE_RATIO, VoidFacts};
pub use figures::{Figures, Setting};
pub use fingerprint::{Fingerprint, Likeness};
pub use hardware::{Fit, Hardware, mass_moments};
pub use joints::{FILM_LIMIT_RATIO, GlueFilm};
pub use judge::{Evidence, Judgement, judge, setting};
pub use kind::CheckKind;
pub use kit::{
    CHECKLIST_FILE, HOLLOWED_FILE, SHEET_FILE, SUMS_FILE, VerifyError, read_promise, verify_kit,
};
pub use measure::{PartEvidence, PartFacts, SurfaceFacts, assembly_moments};
pub use pegs::PegFacts;
pub use pose::Pose;
pub use promise::{
    Aim, Density, FigureName, Mark, Peg, PrinterLimits, Promise, PromisedFigure, PromisedJoint,
    PromisedPart, SCHEMA, WallOrder,
};
pub use rotor::{RotorOrder, Unbalance};
pub use seal::sums;
pub use sheet::{SHEET_LIMIT_RATIO, misstatements};
pub use shells::Shells;
pub use support::{SUPPORT_BAND_RATIO, Support};
pub use wall::smallest_wall_mm;
pub use water::{Afloat, Hull, WaterOrder};
